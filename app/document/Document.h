#pragma once

#include "analysis/Review.h"
#include "analysis/analyse.h"
#include "app/document/Source.h"
#include "live/LiveHistory.h"
#include "widgets/base/Viewport.h"

#include <QObject>
#include <QUndoStack>

#include <memory>
#include <optional>
#include <vector>

namespace faintline {

/// What is open: the one mutable object of the program, everything else is values and views.
///
/// It holds the recording or the frames, where they came from, the settings with their undo stack, what is looked at,
/// and the latest analysis, which may lag behind the settings while a new one is computed. The *shown threshold* is the
/// analysis's, or the one under the user's finger while it is dragged.
class Document : public QObject
{
    Q_OBJECT

public:
    explicit Document(QObject *parent = nullptr);

    /// Something else is open from now on; forgets undo history, session and analysis.
    void setOpened(OpenedSource opened, const AnalysisSettings &settings, const QString &sessionPath = {},
                   Annotations annotations = {});

    bool isEmpty() const { return !m_opened.recording && !m_opened.frames; }
    const Source &source() const { return m_opened.source; }
    const RecordingPointer &recording() const { return m_opened.recording; }  ///< null where ready-made frames are open
    const NormalisedFramesPointer &frames() const { return m_opened.frames; } ///< null where a recording is open
    const FrameKind &frameKind() const { return m_opened.kind(); }
    const PingTruth &pingTruth() const { return m_opened.pingTruth; }
    const Truth &truth() const { return m_opened.truth; }
    const OpenedSource &openedSource() const { return m_opened; }

    // ---- settings ------------------------------------------------------------------------------------------------

    const AnalysisSettings &settings() const { return m_settings; }
    /// As an analysis takes them: slopes in bins a frame of what is open.
    AnalysisSettings analysedSettings() const;
    /// The same with the window and law that the analysis chose, where it is of these settings.
    AnalysisSettings usedSettings() const;
    QUndoStack &undoStack() { return m_undoStack; }

    /// One undoable step to what is open with a line added, its settings as they are.
    void replaceOpened(OpenedSource opened, const QString &text);

    /// What the user does in one go, as holding a key or dragging a value, begins and ends.
    void beginGesture();
    void endGesture();

    /// One undoable step. Steps of one gesture that name the same field become one.
    void edit(const AnalysisSettings &after, const QString &text, const QString &field = {});

    // ---- annotations ---------------------------------------------------------------------------------------------

    const Annotations &annotations() const { return m_annotations; }
    /// One undoable step; detection has nothing to do with it.
    void annotate(Annotations after, const QString &text);

    // ---- session -------------------------------------------------------------------------------------------------

    /// The session file this is saved in; empty where there is none.
    const QString &sessionPath() const { return m_sessionPath; }
    void setSaved(const QString &sessionPath);
    bool isModified() const { return !m_undoStack.isClean(); }

    // ---- view and results ----------------------------------------------------------------------------------------

    Viewport &viewport() { return m_viewport; }
    /// The time that is looked at: what is visible; where frames are seen singly, that of the cursor.
    Span lookedAt() const;
    /// The measured box, where boxes of time × frequency say something of what is open.
    std::optional<Viewport::Box> box() const;

    /// `events`: those of the analysis.
    void setAnalysis(std::shared_ptr<const Analysis> analysis, std::vector<Event> events);
    const std::shared_ptr<const Analysis> &analysis() const { return m_analysis; }
    /// The same, where it is one picture of time × frequency, of which parts can be measured and analysed; else null.
    std::shared_ptr<const Analysis> lineAnalysis() const { return frameKind().takesBoxes ? m_analysis : nullptr; }
    bool isCurrent() const;

    /// What a live run of what is open has so far, instead of an analysis. Its recording is being written.
    void setLive(LiveView view);
    /// It is over; what it had stays until something is opened.
    void endLive();
    bool isLive() const { return m_isLive; }
    const LiveView &live() const { return m_live; }
    /// The analysis of what is open, or, of a live run, all of it up to a time at least, from what has been recorded so
    /// far: to read frames and to go through the chain again. Null where there is neither, where the live run's
    /// settings were others then, or frames are no lines.
    std::shared_ptr<const Analysis> inspectedUntil(double seconds);
    /// The analysis's, or the live run's; null: there is neither.
    const AnalysisPlan *plan() const;

    /// What the changed settings make of the visible frames, until their analysis is there; null where there is no such
    /// thing.
    void setProvisional(std::shared_ptr<const PeakPyramid> statistic);
    const std::shared_ptr<const PeakPyramid> &provisional() const { return m_provisional; }

    void setShownThreshold(double nats);
    double shownThreshold() const { return m_shownThreshold; }
    /// Events and tracks that exceed the shown threshold.
    std::vector<Event> shownEvents() const;
    std::vector<Track> shownTracks() const;
    const Track *track(int id) const;

signals:
    void opened();
    void settingsChanged();
    /// Of a long recording, while its first analysis is still under way.
    void picturesGrew(const faintline::PicturesSoFar &pictures);
    void annotationsChanged();
    void analysisChanged();
    void provisionalChanged();
    void liveChanged();
    void livePlanChanged(); ///< other settings are in force
    void shownThresholdChanged();
    void shownEventsChanged(); ///< the threshold passed one, or they are new
    void sessionChanged();     ///< its path, or whether there is something to save

private:
    /// What undo goes back to.
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
    AnalysisSettings m_settings;
    Annotations m_annotations;
    QString m_sessionPath;
    Viewport m_viewport;
    std::shared_ptr<const Analysis> m_analysis;
    std::shared_ptr<const PeakPyramid> m_provisional;
    LiveView m_live;
    bool m_isLive = false;
    std::shared_ptr<const Analysis> m_liveSoFar; ///< as it was last inspected
    std::shared_ptr<const AnalysisPlan> m_planSoFar;
    std::vector<Event> m_events;
    double m_shownThreshold = 0.0;
    QUndoStack m_undoStack;
    int m_gesture = 0; ///< number of the last one
    bool m_isInGesture = false;
};

} // namespace faintline
