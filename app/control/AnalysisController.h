#pragma once

#include "analysis/previewStatistic.h"
#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "app/document/Session.h"

#include <QObject>

#include <functional>
#include <optional>

namespace faintline {

/// Keeps the document's analysis up with its settings: opens, runs the chain, and previews thresholds.
///
/// Whatever computes runs in the job runner, and the newest wish wins. A dragged threshold is shown at once on the
/// results there are (`previewThreshold`); let go (`commitThreshold`), it becomes a setting and the chain runs again. A
/// changed detector or model is seen at once as well: its statistic of the visible frames comes first, provisionally,
/// beside the threshold there was; calibration, decisions and the rest of the recording follow. Settings that a
/// recording was never calibrated for get a first estimate of their threshold, and the analysis again once it is
/// refined.
class AnalysisController : public QObject
{
    Q_OBJECT

public:
    explicit AnalysisController(Document &document, QObject *parent = nullptr);

    using Adjust = std::function<void(AnalysisSettings &)>;

    /// Opens a recording, a scenario or a session, by its name. `adjust` changes the settings it begins with: the
    /// defaults, or the session's. May be called on another thread.
    void open(const QString &path, const OpenOptions &options = {}, const Adjust &adjust = {});
    /// Opens a session that a program left behind when it died: unsaved work, of no file of its own.
    void recover(const QString &path);
    /// What is open, read in another way.
    void reopen(const OpenOptions &options);
    /// Shows what was opened and analysed elsewhere.
    void adopt(const OpenedSource &opened, std::shared_ptr<const Analysis> analysis);

    bool isBusy() const { return m_runner.isRunning(); }

    /// Changes one setting as one undoable step.
    void edit(const QString &field, const FieldValue &value, const QString &text);
    /// The same of a setting that is a number, whole or not.
    void editNumber(const QString &field, double value);
    void setSettings(const AnalysisSettings &settings, const QString &text);
    /// Adds a line of a known SNR in the noise at its place to what is open, as one undoable step.
    void inject(const LineSettings &line);
    /// By what the threshold is set from now on; its place stays.
    void setThresholdUnit(DecideSettings::By by);

public slots:
    void run();
    void stop();
    void previewThreshold(double nats);
    void commitThreshold(double nats);
    void stepThreshold(int quarterNats);

    /// Off: nobody waits for a first estimate of the threshold; the refined one is the first to be shown.
    void setShowsFirstEstimates(bool shows) { m_showsFirstEstimates = shows; }

signals:
    void busyChanged(bool isBusy);
    void progressed(double fraction, const QString &what);
    void viewRestored(const faintline::ViewState &view); ///< of a session, once there is something to see
    void warned(const QString &where, const QString &why);
    void failed(const faintline::Error &error);
    /// The analysis now has its refined threshold; it had a first estimate of it.
    void refined(double firstEstimate);
    /// Nothing is left to do: the analysis belongs to the settings, or there was a failure.
    void settled();

private:
    struct Opening {
        OpenedSource opened;
        AnalysisSettings settings;
        std::optional<ViewState> view;
        QString sessionPath;
        QString warning;
        Annotations annotations{};
    };
    static Opening openNow(const QString &path, const OpenOptions &options);
    void open(const QString &path, const OpenOptions &options, const Adjust &adjust, const Annotations &annotations);
    void deliver(const Opening &opening);
    void startAnalysis();
    void showFirstEstimate(std::shared_ptr<const Analysis> analysis, std::vector<Event> found);
    void restoreView();
    void showPreview(const AnalysisSettings &settings, const StatisticPreview &preview,
                     std::shared_ptr<const KeptFrames> kept);
    void dropPartialPreview();
    void end();

    Document &m_document;
    std::optional<ViewState> m_pendingView;
    std::optional<double> m_firstEstimate;    ///< threshold of the analysis that is being refined
    std::shared_ptr<const KeptFrames> m_kept; ///< of the last preview
    bool m_isOpening = false;
    bool m_showsFirstEstimates = true;
    JobRunner m_runner; ///< last, so that its jobs end first
};

} // namespace faintline
