#pragma once

#include <QPoint>
#include <QString>
#include <QStringList>

namespace faintline::test {

/// Mouse and keyboard of a user: events take the way through the X server and its window manager (xdotool). Positions
/// are pixels of the screen, `holding` is a modifier key, "shift" or "ctrl".
class Hand
{
public:
    void click(QPoint at, const QString &holding = {});
    void clickRight(QPoint at);
    void drag(QPoint from, QPoint to, const QString &holding = {});
    void turnWheel(QPoint at, int notches, const QString &holding = {}); ///< positive: away from the user
    void press(const QString &keys); ///< as xdotool names them: "ctrl+s", "Return", "period"
    void type(const QString &text);

private:
    void act(const QStringList &words, const QString &holding = {});
};

} // namespace faintline::test
