#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "evaluate/comparison/compareAnalyses.h"
#include "evaluate/comparison/settingDifferences.h"
#include "spectrum/PeakPyramid.h"

#include <QObject>

#include <memory>
#include <optional>
#include <vector>

namespace faintline {

/// Holds an analysis A against the document's own, B: kept once, compared again whenever B changes.
///
/// A stays what it was, settings and results. Where something else has been opened since, A's results are of what was
/// open before; they are computed again only when asked for. It compares while it is told to (`setActive`): while
/// somebody looks.
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
    /// Processor seconds for an hour of recording.
    struct Cost {
        double a = 0.0;
        double b = 0.0;
    };

    explicit Comparer(Document &document, QObject *parent = nullptr);

    /// The document's analysis becomes A.
    void keep();
    const std::shared_ptr<const Analysis> &kept() const { return m_kept; }
    /// Whether A's results are of what is open.
    bool isOfWhatIsOpen() const;
    /// A's settings on what is open.
    void computeHere();
    /// B becomes A; the answer is what was A, for whoever makes it B.
    AnalysisSettings exchange();

    const std::optional<Result> &result() const { return m_result; }
    const std::optional<Cost> &cost() const { return m_cost; }
    bool isBusy() const { return m_runner.isRunning(); }

    void setActive(bool isActive);
    /// Seconds of a machine are not the same twice; off where a picture has to be.
    void setMeasuringCost(bool isOn) { m_isMeasuringCost = isOn; }

signals:
    void keptChanged();
    void changed(); ///< the result, or that there is none
    void costChanged();
    void progressed(double fraction, const QString &what);
    void failed(const faintline::Error &error);
    void settled();

private:
    void compare();
    void measure();

    Document &m_document;
    std::shared_ptr<const Analysis> m_kept;
    std::optional<Result> m_result;
    std::optional<Cost> m_cost;
    bool m_isActive = false;
    bool m_isMeasuringCost = true;
    JobRunner m_meter;
    JobRunner m_runner; ///< last, so that its jobs end first
};

} // namespace faintline
