#pragma once

#include "base/Axis.h"

#include <QWidget>

class QCheckBox;
class QLabel;
class QSlider;
class QToolButton;

namespace faintline {

/// Below the maps of a ping: its number, the legend of the marks and the read-out.
class PingBar : public QWidget
{
    Q_OBJECT

public:
    explicit PingBar(QWidget *parent = nullptr);

    void setPingCount(Index count);
    void setPing(Index ping);
    void setPolar(bool isPolar);
    void setPolarPossible(bool isPossible);
    /// "ping", "scan": what is stepped through.
    void setFrameName(const QString &name);
    void setReading(const QString &words);

signals:
    void pingRequested(faintline::Index ping);
    void stepRequested(int pings);
    void playClicked();
    void backwardClicked();
    void inhibitionToggled(bool isShown);
    void conventionalToggled(bool isShown);
    void polarToggled(bool isPolar);

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    QLayout *buildRow();
    void fitReading();

    QSlider *m_slider;
    QToolButton *m_previous;
    QToolButton *m_next;
    QCheckBox *m_polar;
    QLabel *m_reading;
    QString m_words; ///< whole; in a narrow window the label ends with an ellipsis
};

} // namespace faintline
