#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "evaluate/comparison/compareAnalyses.h"
#include "evaluate/comparison/settingDifferences.h"
#include "frames/PeakPyramid.h"

#include <QObject>

#include <memory>
#include <optional>
#include <vector>

namespace faintline {

/// Compares an analysis A with the document's own, B: A is kept once and compared again whenever B changes.
///
/// A keeps its settings and results. If another source has been opened since, A's results refer to the previous one;
/// they are recomputed only on request. Compares only while active (`setActive`), that is, while visible.
class Comparer : public QObject
{
    Q_OBJECT

public:
    struct Result {
        std::shared_ptr<const Analysis> a;
        std::shared_ptr<const Analysis> b;
        Comparison comparison;
        std::shared_ptr<const PeakPyramid> difference; ///< null for pings
        std::vector<SettingDifference> settings;
    };
    /// Processor seconds per hour of recording.
    struct Cost {
        double a = 0.0;
        double b = 0.0;
    };

    explicit Comparer(Document &document, QObject *parent = nullptr);

    /// Makes the document's analysis A.
    void keep();
    const std::shared_ptr<const Analysis> &kept() const { return m_kept; }
    /// Whether A's results are for the open source.
    bool isOfWhatIsOpen() const;
    /// Computes A's settings on the open source.
    void computeHere();
    /// Makes B the new A; returns the settings of the previous A, for the caller to make B.
    AnalysisSettings exchange();

    const std::optional<Result> &result() const { return m_result; }
    const std::optional<Cost> &cost() const { return m_cost; }

    void setActive(bool isActive);
    /// Costs vary between runs; turn off where a picture must be reproducible.
    void setMeasuringCost(bool isOn) { m_isMeasuringCost = isOn; }

signals:
    void keptChanged();
    void changed(); ///< the result, or its absence
    void costChanged();
    void progressed(double fraction, const QString &what);
    void failed(const faintline::Error &error);

private:
    void compare();
    void measure();

    Document &m_document;
    std::shared_ptr<const Analysis> m_kept;
    /// What A was computed from; nothing after another opening. Frames from a file are no identity: settings may
    /// normalise them anew.
    std::optional<Source> m_keptSource;
    std::optional<Result> m_result;
    std::optional<Cost> m_cost;
    bool m_isActive = false;
    bool m_isMeasuringCost = true;
    JobRunner m_meter;
    JobRunner m_runner{this}; ///< last, so that its jobs end first
};

} // namespace faintline
