#include "app/currentView.h"

#include "app/MainWindow.h"
#include "app/WelcomePage.h"
#include "app/WindowViews.h"
#include "app/Workbench.h"
#include "widgets/StripPlot.h"

#include <QApplication>
#include <QCursor>

namespace faintline {

namespace {

    QString nameOf(MainWindow &window, const QWidget *widget)
    {
        for (const QWidget *each = widget; each && each != &window; each = each->parentWidget()) {
            if (each == window.workbench().statisticPlot())
                return QStringLiteral("profile");
            if (each == window.workbench().regulationPlot())
                return QStringLiteral("regulation");
            for (const QString &name : WindowViews::names())
                if (name != QLatin1String("polar") && window.views().named(name) == each)
                    return name;
        }
        return {};
    }

} // namespace

QString currentView(MainWindow &window)
{
    if (const QString focused = nameOf(window, window.focusWidget()); !focused.isEmpty())
        return focused;
    if (const QString pointed = nameOf(window, window.childAt(window.mapFromGlobal(QCursor::pos())));
        !pointed.isEmpty())
        return pointed;
    if (window.welcome().isVisible())
        return {};
    if (!window.workbench().isVisible() && !window.document().hasPings())
        return QStringLiteral("walk");
    return window.document().hasPings() ? QStringLiteral("map") : QStringLiteral("output");
}

} // namespace faintline
