#pragma once

#include "app/control/LiveRun.h"
#include "app/document/Document.h"

#include <QTimer>
#include <QWidget>

class QLabel;
class QToolButton;

namespace faintline {

/// Above the pictures while something is listened to: what it is, the time in UTC, what was lost, what the disk still
/// takes, how far the picture and the sound are behind; and buttons to hear it, to hold the picture and to stop.
class LiveBar : public QWidget
{
    Q_OBJECT

public:
    LiveBar(Document &document, LiveRun &run, QWidget *parent = nullptr);

    /// A frame was painted so long after its last sample was heard.
    void setDelay(double seconds);
    /// Whether what comes in is played, and how far the sound is behind it.
    void setHearing(bool isHearing);
    void setSoundDelay(double seconds) { m_soundDelay = seconds; }
    double longestDelay() const { return m_longestDelay; } ///< of the last seconds
    QString text() const;

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
    double m_longestDelay = 0.0;
    double m_soundDelay = 0.0;
    double m_delayBefore = 0.0; ///< of the second before
    int m_ticks = 0;
};

} // namespace faintline
