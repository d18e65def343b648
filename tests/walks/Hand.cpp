#include "walks/Hand.h"

#include <QProcess>

#include <cstdlib>
#include <stdexcept>

namespace faintline::test {

namespace {

    QStringList moveTo(QPoint at)
    {
        return {QStringLiteral("mousemove"), QString::number(at.x()), QString::number(at.y())};
    }

} // namespace

void Hand::act(const QStringList &words, const QString &holding)
{
    QStringList all = words;
    if (!holding.isEmpty())
        all = QStringList{QStringLiteral("keydown"), holding} + words + QStringList{QStringLiteral("keyup"), holding};
    QProcess xdotool;
    xdotool.start(QStringLiteral("xdotool"), all);
    if (!xdotool.waitForFinished(-1) || xdotool.exitCode() != 0)
        throw std::runtime_error("xdotool " + all.join(u' ').toStdString()
                                 + " fails: " + xdotool.readAllStandardError().simplified().toStdString());
}

void Hand::click(QPoint at, const QString &holding)
{
    act(moveTo(at) + QStringList{"click", "1"}, holding);
}

void Hand::clickRight(QPoint at)
{
    act(moveTo(at) + QStringList{"click", "3"});
}

void Hand::drag(QPoint from, QPoint to, const QString &holding)
{
    constexpr int steps = 8;
    QStringList words = moveTo(from) + QStringList{"mousedown", "1"};
    for (int step = 1; step <= steps; ++step)
        words += moveTo(from + (to - from) * step / steps) + QStringList{"sleep", "0.02"}; // a hand takes its time
    act(words + QStringList{"mouseup", "1"}, holding);
}

void Hand::turnWheel(QPoint at, int notches, const QString &holding)
{
    act(moveTo(at) + QStringList{"click", "--repeat", QString::number(std::abs(notches)), notches > 0 ? "4" : "5"},
        holding);
}

void Hand::press(const QString &keys)
{
    act({QStringLiteral("key"), keys});
}

void Hand::type(const QString &text)
{
    act({QStringLiteral("type"), QStringLiteral("--"), text});
}

} // namespace faintline::test
