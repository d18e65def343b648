#pragma once

#include "app/document/Document.h"
#include "app/document/ViewState.h"

#include <QWidget>

#include <optional>
#include <vector>

class QSplitter;

namespace faintline {

class TimeStack;

/// Central part of the window while a document is open: the pictures and the navigation in them. There is one bench for
/// each kind of frames; it follows the document only while the document's frames are of its kind.
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
    };

    Bench(Document &document, const FrameKind &kind, QWidget *parent = nullptr);

    bool isInUse() const; ///< the document's frames are of this kind

    virtual Place place() const = 0;
    /// Moves the cursor and scrolls it into view. Empty coordinates are left unchanged.
    virtual void setPlace(const Place &place) = 0;

    virtual QWidget *inputView() const = 0; ///< with its colour bar
    virtual QWidget *outputView() const = 0;
    virtual QWidget *firstView() const = 0;    ///< has the initial focus
    virtual QString firstViewName() const = 0; ///< as in `windowViews`
    virtual bool hasReadOut() const = 0;       ///< has a read-out and a history of its own
    virtual QString hint() const = 0;          ///< suggests the next step if there are events
    virtual TimeStack &timeStack() = 0;        ///< the pictures and curves above each other

    /// Text shown in the empty panes.
    virtual void setEmptySentence(const QString &sentence) = 0;

    virtual ViewState viewState() const = 0;
    virtual void restore(const ViewState &view) = 0;

    virtual void cycleOrientation() = 0;
    virtual void cycleColourMap() = 0;
    virtual void setAutomaticRange() = 0;

    /// Sizes of the panes.
    QByteArray saveSplitters() const;
    void restoreSplitters(const QByteArray &state);

public slots:
    virtual void selectEvent(int id) = 0; ///< marks the event, moves the cursor to it and scrolls it into view
    virtual void stepFrames(int frames) = 0;
    virtual void setPlaying(bool isPlaying) = 0;

signals:
    void eventActivated(int id);
    void thresholdStepRequested(int quarterNats);
    void playingChanged(bool isPlaying);

protected:
    virtual std::vector<QSplitter *> splitters() const = 0;

    // Called only while the document's frames are of this kind.
    virtual void showAnalysis() = 0;
    virtual void showHeading() = 0;
    virtual void showStatistic() = 0; ///< of the analysis, or the provisional one
    virtual void showThreshold() = 0;
    virtual void showEvents() = 0;
    virtual void readCursor() = 0;

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
    const FrameKind &m_kind;
};

} // namespace faintline
