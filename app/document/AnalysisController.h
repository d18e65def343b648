#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "app/document/ViewState.h"
#include "inspect/previewStatistic.h"

#include <QObject>

#include <functional>
#include <optional>

namespace faintline {

/// Keeps the document's analysis up to date with its settings: opens sources, runs the chain, and previews thresholds.
///
/// Computations run in the job runner, where the newest request wins. A dragged threshold is applied immediately to the
/// existing results (`previewThreshold`); on release (`commitThreshold`) it becomes a setting and the chain runs again.
/// A changed detector or model also has an immediate effect: first its provisional statistic of the visible frames,
/// with the old threshold; calibration, decisions and the rest of the recording follow. Settings without a calibration
/// get a first estimate of their threshold, and a second analysis once it is refined.
class AnalysisController : public QObject
{
    Q_OBJECT

public:
    explicit AnalysisController(Document &document, QObject *parent = nullptr);

    using Adjust = std::function<void(AnalysisSettings &)>;

    /// Opens a recording, a scenario or a session by name. `adjust` changes the initial settings: the defaults, or the
    /// session's. It may be called on another thread.
    void open(const QString &path, const OpenOptions &options = {}, const Adjust &adjust = {});
    /// Opens a session left behind by a crashed program: unsaved work that belongs to no file.
    void recover(const QString &path);
    /// Reopens the open source with other options.
    void reopen(const OpenOptions &options);

    bool isBusy() const { return m_runner.isRunning(); }
    JobRunner &runner() { return m_runner; }

    /// Changes one setting as one undoable step.
    void edit(const QString &field, const FieldValue &value, const QString &text);
    /// The same for a numeric setting, integer or not.
    void editNumber(const QString &field, double value);
    void setSettings(const AnalysisSettings &settings, const QString &text);
    /// Adds a line with a known SNR over the local noise to the open source, as one undoable step.
    void inject(const LineSettings &line);
    /// Selects the quantity that sets the threshold; its value stays.
    void setThresholdUnit(DecideSettings::By by);

public slots:
    void run();
    void stop();
    void previewThreshold(double nats);
    void commitThreshold(double nats);
    void stepThreshold(int quarterNats);

    /// If off, the first displayed threshold is the refined one.
    void setShowsFirstEstimates(bool shows) { m_showsFirstEstimates = shows; }

signals:
    void busyChanged(bool isBusy);
    void viewRestored(const faintline::ViewState &view); ///< of a session, once there is something to display
    void warned(const QString &where, const QString &why);
    void failed(const faintline::Error &error);
    /// The analysis now has its refined threshold instead of a first estimate.
    void refined(double firstEstimate);
    /// Nothing is left to do: the analysis matches the settings, or it failed.
    void settled();

private:
    struct Opening {
        OpenedSource opened;
        AnalysisSettings settings;
        std::optional<ViewState> view;
        QString sessionPath;
        QString warning;
        Annotations annotations{};
        SignalNumbers numbers{};
    };
    static Opening openNow(const QString &path, const OpenOptions &options, const RunContext &context);
    void open(const QString &path, const OpenOptions &options, const Adjust &adjust, const Annotations &annotations);
    void deliver(const Opening &opening);
    void startAnalysis();
    void restoreView();
    void showPreview(const AnalysisSettings &settings, const StatisticPreview &preview,
                     std::shared_ptr<const KeptFrames> kept);
    void dropPartialPreview();
    void end();

    Document &m_document;
    std::optional<ViewState> m_pendingView;
    std::optional<double> m_firstEstimate;    ///< threshold of the analysis being refined
    std::shared_ptr<const KeptFrames> m_kept; ///< of the last preview
    bool m_isOpening = false;
    bool m_showsFirstEstimates = true;
    JobRunner m_runner{this}; ///< last, so that its jobs end first
};

} // namespace faintline
