#pragma once

#include "app/document/Document.h"
#include "app/document/Session.h"

#include <QWidget>

#include <optional>
#include <vector>

class QSplitter;

namespace faintline {

/// What fills the middle of the window while something is open: the pictures, and what moves about in them. There is
/// one for each kind of frames. Each hears of the document only while the document's
/// frames are of its kind.
class Bench : public QWidget
{
    Q_OBJECT

public:
    /// Where the cursor is, in the units of the axes; what a kind of frames does not have is not given.
    struct Place {
        std::optional<double> seconds;
        std::optional<double> hz;
        std::optional<double> range;
        std::optional<double> bearing;
    };

    Bench(Document &document, const FrameKind &kind, QWidget *parent = nullptr);

    bool isInUse() const; ///< the document's frames are of this kind

    virtual Place place() const = 0;
    /// Moves the cursor; what is not given stays. Brings it into view.
    virtual void setPlace(const Place &place) = 0;

    virtual QWidget *inputView() const = 0; ///< with its colour bar
    virtual QWidget *outputView() const = 0;
    virtual QWidget *firstView() const = 0;    ///< that has the focus at first
    virtual QString firstViewName() const = 0; ///< as in `windowViews`
    virtual bool hasReadOut() const = 0;       ///< of its own, and a history
    virtual QString hint() const = 0;          ///< what can be done next, where there are events

    /// What the panes say while there is nothing to see.
    virtual void setEmptySentence(const QString &sentence) = 0;

    virtual ViewState viewState() const = 0;
    virtual void restore(const ViewState &view) = 0;

    virtual void cycleOrientation() = 0;
    virtual void cycleColourMap() = 0;
    virtual void setAutomaticRange() = 0;

    /// How its pictures share the room.
    QByteArray saveSplitters() const;
    void restoreSplitters(const QByteArray &state);

public slots:
    virtual void selectEvent(int id) = 0; ///< marks it, puts the cursor on it and brings it into view
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
    virtual void showStatistic() = 0; ///< the analysis's, or the provisional one
    virtual void showThreshold() = 0;
    virtual void showEvents() = 0;
    virtual void readCursor() = 0;

    /// Calls a member function when a signal is emitted, if this is in use.
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
