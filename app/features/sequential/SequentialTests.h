#pragma once

#include "app/base/JobRunner.h"
#include "detect/inspectStages.h"
#include "evaluate/sequential/ScanTest.h"
#include "frames/NormalisedFrames.h"
#include "plan/AnalysisSettings.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace faintline {

/// The sequential tests of this window: a radar's on simulated scans, or one on a recording's frames.
///
/// Results arrive in parts while the tests run, always in the same order and with the same values: walks of both
/// hypotheses, the rounds over the sectors, curves against SNR and prior, the test of fixed size. One run is selected;
/// its posterior, and the scan at the selected stage, are computed on request.
class SequentialTests : public QObject
{
    Q_OBJECT

public:
    /// A run and its result.
    using Walk = std::pair<ScanRun, SprtResult>;

    /// Frames of a line recording to be tested.
    struct Selection {
        QString name; ///< of the recording
        NormalisedFramesPointer frames;
        ModelSettings model;
        Index firstFrame = 0;
        Index frameCount = 0;
        Index firstCell = 0;
        Index cellCount = 0;
    };

    /// The posterior of a run, and the truth.
    struct Inspection {
        InspectedTest test;
        std::vector<ScanCell> truth; ///< empty: no target, or unknown
    };

    /// The scan of a stage: range × Doppler, dB.
    struct Scan {
        ScanRun run;
        Index stage = 0;
        std::vector<float> db;
    };

    explicit SequentialTests(QObject *parent = nullptr);

    /// Both throw Error for invalid input, and discard previous results otherwise.
    void start(const ScanTest &test);
    void start(const Selection &selection, const SprtSettings &sprt);
    void cancel();
    bool isBusy() const { return m_runner.isRunning() || m_inspector.isRunning() || m_scanner.isRunning(); }
    bool isRunning() const { return m_runner.isRunning(); }

    bool isEmpty() const { return m_walks.empty(); }
    bool isOfScans() const { return !m_selection.frames; }
    const ScanTest &test() const { return m_test; } ///< its `sprt` also applies to a recording
    const Selection &selection() const { return m_selection; }

    const std::vector<Walk> &walks() const { return m_walks; }
    const std::optional<SectorRounds> &sectorRounds() const { return m_sectorRounds; }
    const std::vector<ScanPoint> &points() const { return m_points; }
    const std::optional<PriorCurve> &prior() const { return m_prior; }
    std::optional<Index> fixedSize() const { return m_fixedSize; }
    bool isFixedSizeKnown() const { return m_isFixedSizeKnown; } ///< also if none suffices

    int selected() const { return m_selected; } ///< index of a walk; -1: none
    Index stage() const { return m_stage; }     ///< 1 … stages of the selected run
    const std::shared_ptr<const Inspection> &inspection() const
    {
        return m_inspection;
    } ///< for the selected run; null until computed
    const std::optional<Scan> &scan() const { return m_scan; }

public slots:
    void select(int walk);
    void setStage(faintline::Index stage); ///< clamped

signals:
    void restarted();
    void walksChanged();
    void sectorRoundsChanged();
    void curvesChanged();
    void fixedSizeChanged();
    void selectionChanged();
    void stageChanged();
    void inspectionChanged();
    void scanChanged();
    void progressed(double fraction, const QString &what);
    void busyChanged(bool isBusy);
    void failed(const faintline::Error &error);
    void settled(); ///< no work is left

private:
    void forget();
    void runScans(const ScanTest &test, const RunContext &context);
    void measureCurves(const ScanTest &test, const RunContext &context);
    /// Applies `change` to the results in this object's thread, unless another run was started since.
    template <class Change>
    void deliver(Change change);
    void addWalks(std::vector<Walk> walks);
    void inspect();
    void readScan();
    void settle();

    ScanTest m_test;
    Selection m_selection;
    std::vector<Walk> m_walks;
    std::optional<SectorRounds> m_sectorRounds;
    std::vector<ScanPoint> m_points;
    std::optional<PriorCurve> m_prior;
    std::optional<Index> m_fixedSize;
    bool m_isFixedSizeKnown = false;
    int m_selected = -1;
    Index m_stage = 1;
    std::shared_ptr<const Inspection> m_inspection;
    std::optional<Scan> m_scan;
    int m_generation = 0;    ///< of this object's thread; increases with every start
    int m_jobGeneration = 0; ///< of the worker: the one for which it computes

    JobRunner m_runner; ///< last, so that their jobs end first
    JobRunner m_inspector;
    JobRunner m_scanner;
};

} // namespace faintline
