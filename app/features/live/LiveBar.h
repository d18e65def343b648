#pragma once

#include "app/document/Document.h"
#include "app/features/live/LiveRun.h"

#include <QTimer>
#include <QWidget>

class QLabel;
class QToolButton;

namespace faintline {

/// Bar above the pictures during a live run: the source, UTC, lost samples, disk time left, and the delay of picture
/// and sound; with buttons to hear it, to hold the picture and to stop.
class LiveBar : public QWidget
{
    Q_OBJECT

public:
    LiveBar(Document &document, LiveRun &run, QWidget *parent = nullptr);

    /// Notes the delay from a frame's last sample to its painting.
    void setDelay(double seconds);
    /// Whether the live input is played, and the delay of the sound.
    void setHearing(bool isHearing);
    void setSoundDelay(double seconds) { m_soundDelay = seconds; }

signals:
    void hearingRequested(bool isWanted);

private:
    void refresh();
    QString pictureWords() const;
    QString lostWords() const;
    QString diskWords() const;

    Document &m_document;
    LiveRun &m_run;
    QLabel *m_label;
    QToolButton *m_hear;
    QToolButton *m_hold;
    QToolButton *m_stop;
    QTimer m_refresh;
    double m_longestDelay = 0.0; ///< maximum over the last seconds
    double m_soundDelay = 0.0;
    double m_delayBefore = 0.0; ///< of the previous second
    int m_ticks = 0;
};

} // namespace faintline
