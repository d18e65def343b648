#pragma once

#include "app/document/Document.h"
#include "app/document/ViewState.h"
#include "app/features/pictures/FramePlayer.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QWidget>

#include <optional>
#include <utility>
#include <vector>

class QSplitter;

namespace faintline {

class OutputLayers;
class TimeStack;

/// Central part of the window while a document is open: the pictures and the navigation in them. There is one bench for
/// frames that form one picture and one for frames that are seen singly; it follows the document only while the
/// document's frames are of its sort.
///
/// A bench consists of *planes* (two axes of one frame), *histories* (one axis over time, with the events, tracks and
/// truth along it) and *strips* (curves over time). Bench links them, shows what they have in common and steps through
/// the frames; the class of a kind adds the parts for its axes and lays them out.
class Bench : public QWidget
{
    Q_OBJECT

public:
    /// Position of the cursor in the units of the axes; a coordinate that this kind of frames lacks is empty.
    struct Place {
        std::optional<double> seconds;
        std::optional<double> hz;
        std::optional<double> range;
        std::optional<double> bearing;
        /// Of pings and scans, one per axis of the grid, in its unit; empty: as range and bearing say, the first two.
        std::vector<double> position{};
    };

    /// `stepInterval`: between two steps while frames are played.
    Bench(Document &document, const FrameKind &kind, std::chrono::milliseconds stepInterval, QWidget *parent = nullptr);

    bool isInUse() const; ///< the document's frames are of this kind

    virtual Place place() const = 0;
    /// Moves the cursor and scrolls it into view. Empty coordinates are left unchanged.
    virtual void setPlace(const Place &place) = 0;

    virtual QWidget *inputView() const = 0; ///< with its colour bar
    virtual QWidget *outputView() const = 0;
    virtual WaterfallView *firstView() const = 0; ///< shows the statistic; has the initial focus
    virtual QString firstViewName() const = 0;    ///< as in `windowViews`
    virtual bool hasReadOut() const = 0;          ///< has a read-out and a history of its own
    virtual QString hint() const = 0;             ///< suggests the next step if there are events
    virtual OutputLayers &layers() const = 0;     ///< shown with the statistic
    TimeStack &timeStack() { return *m_stack; }   ///< the pictures and curves above each other

    /// Text shown in the empty panes.
    virtual void setEmptySentence(const QString &sentence);

    virtual ViewState viewState() const = 0;
    virtual void restore(const ViewState &view) = 0;

    void setAutomaticRange();

    /// Sizes of the panes.
    QByteArray saveSplitters() const;
    void restoreSplitters(const QByteArray &state);

public slots:
    /// Marks the event, moves the cursor to it and scrolls it into view. If the event is below the shown threshold, its
    /// track is only scrolled into view.
    void selectEvent(int id);
    void showSelected(int id); ///< an event in all pictures; 0: none
    virtual void stepFrames(int frames) = 0;
    virtual void setPlaying(bool isPlaying);

signals:
    void eventActivated(int id);
    void thresholdStepRequested(int quarterNats);
    void playingChanged(bool isPlaying);

protected:
    /// Adds a picture of two axes of one frame.
    void addPlane(WaterfallView &view);
    /// Adds a picture of one axis of the frames over time, or of the largest values along it. `pane`: the view, or the
    /// widget that contains it.
    void addHistory(WaterfallView &view, QWidget &pane, std::size_t axis);
    /// Makes it the history of another axis; `showEvents` and `showTruth` then draw its marks.
    void setHistoryAxis(const WaterfallView &view, std::size_t axis);
    /// Stacks the parts with these initial heights; the first takes what the window has left.
    void addRows(const std::vector<std::pair<QWidget *, int>> &rows);
    static QSplitter *newSplitter(Qt::Orientation orientation);
    QSplitter *historyPanes() const { return m_historyPanes; }
    QSplitter *rows() const { return m_rows; }
    virtual std::vector<QSplitter *> splitters() const = 0;

    /// Places the histories for their direction of time, now and when it changes.
    void arrangeBy(const TimeDirection &direction);
    /// Hides parts that would leave too little room for the pictures, which have priority.
    virtual void showWhatFits() = 0;
    void resizeEvent(QResizeEvent *event) override;

    // Called only while the document's frames are of this kind.
    virtual void showAnalysis() = 0;
    void showHeading();
    virtual void showStatistic() = 0; ///< of the analysis, or the provisional one
    virtual void showThreshold() = 0;
    void showEvents();
    virtual void readCursor() = 0;

    void showTruth();
    virtual void showMarks() {}                        ///< of planes, after the events have changed
    virtual void markSelected(int) {}                  ///< a track, in planes
    virtual void reveal(const Track &) {}              ///< scrolls it into view, shown or not
    virtual void goTo(const Event &event) = 0;         ///< moves the cursor to it and scrolls the cursor into view
    virtual void setColourBarShown(bool isShown) = 0;  ///< that of the statistic
    virtual void showStatisticUnit(const QString &) {} ///< beside the statistic's picture
    /// What is shown instead of the analysis's statistic: computed with changed settings; null if there is none.
    virtual const PeakPyramid *provisional() const { return m_document.provisional().get(); }
    /// Frames to step while playing in a direction, 1 or -1; 0 at the end.
    virtual int framesToPlay(int direction) const = 0;

    bool isPlaying() const { return m_player.isPlaying(); }
    FramePlayer &player() { return m_player; }
    /// Whether no analysis of the open source has been shown; from then on false.
    bool takeFirstAnalysis() { return std::exchange(m_isFirstAnalysis, false); }
    void forgetAnalysis() { m_isFirstAnalysis = true; }

    /// Connects a signal to a member function that is called only while this bench is in use.
    template <class Sender, class Signal, class B>
    void whenInUse(Sender *sender, Signal signal, void (B::*slot)())
    {
        connect(sender, signal, this, [this, slot] {
            if (isInUse())
                (static_cast<B *>(this)->*slot)();
        });
    }

    Document &m_document;

private:
    struct Picture {
        WaterfallView *view;
        std::optional<std::size_t> axis; ///< of a history
    };

    void add(const Picture &picture);
    void arrange(bool isStacked);
    void play(int direction);

    const FrameKind &m_kind;
    std::vector<Picture> m_pictures;
    QSplitter *m_historyPanes;
    QSplitter *m_rows;
    TimeStack *m_stack;
    FramePlayer m_player;
    bool m_isFirstAnalysis = true; ///< of the open document
};

} // namespace faintline
