#pragma once

#include "analyse/analyse.h"
#include "app/base/filePath.h"
#include "app/document/sourceAt.h"
#include "base/files/InputFiles.h"
#include "exchange/Session.h"
#include "live/LiveHistory.h"
#include "widgets/base/TimeDirection.h"
#include "widgets/base/Viewport.h"
#include "widgets/waterfall/PictureDisplay.h"

#include <QObject>
#include <QUndoStack>

#include <memory>
#include <optional>
#include <vector>

namespace faintline {

/// The open document: the only mutable object of the program; everything else is a value or a view.
///
/// Holds the recording or the frames, their source, the settings with their undo stack, the view, and the latest
/// analysis, which may lag behind the settings while a new one is computed. The *shown threshold* is the analysis's, or
/// the current one while the user drags it.
class Document : public QObject
{
    Q_OBJECT

public:
    explicit Document(QObject *parent = nullptr);

    /// Replaces the contents; discards undo history, session and analysis.
    void setOpened(OpenedSource opened, const AnalysisSettings &settings, const QString &sessionPath = {},
                   Annotations annotations = {}, SignalNumbers numbers = {});

    bool isEmpty() const { return !m_opened.recording && !m_opened.frames; }
    const Source &source() const { return m_opened.source; }
    QString sourcePath() const { return pathText(m_opened.source.path); }
    QString sourceName() const { return nameOf(m_opened.source); }            ///< for titles
    const RecordingPointer &recording() const { return m_opened.recording; }  ///< null if ready-made frames are open
    const NormalisedFramesPointer &frames() const { return m_opened.frames; } ///< null if a recording is open
    const FrameKind &frameKind() const { return kindOf(m_opened); }
    const PingTruth &pingTruth() const { return m_opened.pingTruth; }
    const Truth &truth() const { return m_opened.truth; }
    const OpenedSource &openedSource() const { return m_opened; }

    // ---- settings ------------------------------------------------------------------------------------------------

    const AnalysisSettings &settings() const { return m_settings; }
    /// As an analysis takes them: slopes in bins per frame of the open source.
    AnalysisSettings analysedSettings() const;
    /// The same with the window and law chosen by the analysis, if it used these settings.
    AnalysisSettings usedSettings() const;
    QUndoStack &undoStack() { return m_undoStack; }

    /// One undoable step that adds a line to the open source and keeps the settings.
    void replaceOpened(OpenedSource opened, const QString &text);

    /// Begins and ends a gesture, such as holding a key or dragging a value.
    void beginGesture();
    void endGesture();

    /// Settings from which the user starts, as those of a lesson's step: there is nothing to undo or to save, unless
    /// there was before.
    void startFrom(const AnalysisSettings &settings);

    /// One undoable step. Steps of one gesture on the same field are merged.
    void edit(const AnalysisSettings &after, const QString &text, const QString &field = {});

    // ---- annotations ---------------------------------------------------------------------------------------------

    const Annotations &annotations() const { return m_annotations; }
    /// The annotated boxes, if boxes of time × frequency apply to the open source.
    std::vector<Annotation> shownBoxes() const;
    /// One undoable step; does not affect detection.
    void annotate(Annotations after, const QString &text);

    // ---- session -------------------------------------------------------------------------------------------------

    /// The session file; empty if there is none.
    const QString &sessionPath() const { return m_sessionPath; }
    /// What a session file holds. `hash`: the recording's, if it is known.
    Session session(const Json &view = Json::object(), const std::string &hash = {}) const;
    void setSaved(const QString &sessionPath);
    bool isModified() const { return !m_undoStack.isClean(); }

    // ---- view and results ----------------------------------------------------------------------------------------

    Viewport &viewport() { return m_viewport; }
    PictureDisplay &display() { return m_display; }    ///< of all pictures
    TimeDirection &direction() { return m_direction; } ///< of pictures of lines
    /// The time of interest: the visible span, or the cursor's if frames are shown singly.
    Span lookedAt() const;
    /// The measured box, if boxes of time × frequency apply to the open source.
    std::optional<Viewport::Box> box() const;

    /// `events`: those of the analysis, whose tracks have these numbers.
    void setAnalysis(std::shared_ptr<const Analysis> analysis, std::vector<Event> events, SignalNumbers numbers = {});
    /// The numbers of the signals found since the source was opened; an analysis that is not a first estimate keeps them.
    const SignalNumbers &numbers() const { return m_numbers; }
    const std::shared_ptr<const Analysis> &analysis() const { return m_analysis; }
    /// Whether the frames form one picture of time × frequency, in which boxes apply.
    bool isOnePicture() const { return frameKind().takesBoxes; }
    /// The same if it is one picture of time × frequency, parts of which can be measured and analysed; otherwise null.
    std::shared_ptr<const Analysis> lineAnalysis() const { return isOnePicture() ? m_analysis : nullptr; }
    bool isCurrent() const;

    /// For a long recording, while its first analysis is in progress.
    void showPictures(const PicturesSoFar &pictures) { emit picturesGrew(pictures); }
    /// State of the live run so far, in place of an analysis. Its recording is in progress.
    void setLive(LiveView view);
    /// Ends the live run; its state stays until something is opened.
    void endLive();
    bool isLive() const { return m_isLive; }
    /// Whether what is open is analysed on request; a live run analyses what it receives by itself.
    bool takesAnalyses() const { return !isEmpty() && !m_isLive; }
    /// Goes to the newest frames of a live run, and moves with them.
    void followNewest();
    const LiveView &live() const { return m_live; }
    /// The analysis, or, for a live run, one up to at least the given time, from what has been recorded so far, to read
    /// frames and rerun the chain. Null if there is neither, if the live run's settings were different then, or if
    /// frames are not lines.
    std::shared_ptr<const Analysis> inspectedUntil(double seconds);
    /// The analysis's or the live run's; null: neither.
    const AnalysisPlan *plan() const;

    /// A preview of the visible frames with the changed settings until their analysis exists; null if not available.
    void setProvisional(std::shared_ptr<const PeakPyramid> statistic);
    const std::shared_ptr<const PeakPyramid> &provisional() const { return m_provisional; }

    void setShownThreshold(double nats);
    double shownThreshold() const { return m_shownThreshold; }
    /// Whether the shown events are not those of an analysis with the settings and the shown threshold: while it is
    /// dragged, and until the analysis that follows.
    bool isPreview() const;
    /// Events and tracks that exceed the shown threshold.
    std::vector<Event> shownEvents() const;
    std::vector<Track> shownTracks() const;
    const Track *track(int id) const;

signals:
    void opened();
    void settingsChanged();
    void picturesGrew(const faintline::PicturesSoFar &pictures);
    void annotationsChanged();
    void analysisChanged();
    void provisionalChanged();
    void liveChanged();
    void livePlanChanged(); ///< other settings took effect
    void shownThresholdChanged();
    void shownEventsChanged(); ///< the threshold passed one, or they are new
    void sessionChanged();     ///< its path, or whether there are unsaved changes

private:
    /// State restored by undo.
    struct State {
        OpenedSource opened;
        AnalysisSettings settings;
        Annotations annotations;
    };
    class Edit;

    State state() const { return {m_opened, m_settings, m_annotations}; }
    void apply(const State &state);
    bool isShown(const Event &event) const { return event.statistic >= m_shownThreshold; }
    std::ptrdiff_t shownCount() const;

    OpenedSource m_opened;
    std::optional<InputFiles> m_inputFiles; ///< of the source, which no export replaces
    AnalysisSettings m_settings;
    Annotations m_annotations;
    SignalNumbers m_numbers;
    QString m_sessionPath;
    Viewport m_viewport;
    PictureDisplay m_display;
    TimeDirection m_direction;
    std::shared_ptr<const Analysis> m_analysis;
    std::shared_ptr<const PeakPyramid> m_provisional;
    LiveView m_live;
    bool m_isLive = false;
    std::shared_ptr<const Analysis> m_liveSoFar; ///< as last requested
    std::shared_ptr<const AnalysisPlan> m_planSoFar;
    std::vector<Event> m_events;
    double m_shownThreshold = 0.0;
    QUndoStack m_undoStack;
    int m_gesture = 0; ///< number of the last gesture
    bool m_isInGesture = false;
};

} // namespace faintline
