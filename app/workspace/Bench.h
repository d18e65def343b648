#pragma once

#include "app/document/Session.h"

#include <QWidget>

#include <vector>

class QSplitter;

namespace faintline {

/// What fills the middle of the window while something is open: the pictures, and what moves about in them. There is one for lines over
/// time and frequency, one for a sonar's pings.
class Bench : public QWidget
{
    Q_OBJECT

public:
    using QWidget::QWidget;

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

protected:
    virtual std::vector<QSplitter *> splitters() const = 0;

public slots:
    virtual void selectEvent(int id) = 0; ///< marks it, puts the cursor on it and brings it into view
    virtual void stepFrames(int frames) = 0;
    virtual void setPlaying(bool isPlaying) = 0;

signals:
    void eventActivated(int id);
    void thresholdStepRequested(int quarterNats);
    void playingChanged(bool isPlaying);
};

} // namespace faintline
