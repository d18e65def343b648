#include "app/window/currentView.h"

#include "app/features/opening/WelcomePage.h"
#include "app/features/pictures/Workbench.h"
#include "app/views/WindowParts.h"
#include "app/views/WindowViews.h"
#include "widgets/plot/StripPlot.h"

#include <QApplication>
#include <QCursor>

namespace faintline {

namespace {

    QString nameOf(const QWidget &window, const WindowParts &parts, const QWidget *widget)
    {
        for (const QWidget *each = widget; each && each != &window; each = each->parentWidget()) {
            if (each == parts.workbench().statisticPlot())
                return QStringLiteral("profile");
            if (each == parts.workbench().regulationPlot())
                return QStringLiteral("regulation");
            for (const QString &name : WindowViews::names())
                if (name != QLatin1String("polar") && parts.views().named(name) == each)
                    return name;
        }
        return {};
    }

} // namespace

QString currentView(const QWidget &window, const WindowParts &parts)
{
    if (const QString focused = nameOf(window, parts, window.focusWidget()); !focused.isEmpty())
        return focused;
    if (const QString pointed = nameOf(window, parts, window.childAt(window.mapFromGlobal(QCursor::pos())));
        !pointed.isEmpty())
        return pointed;
    if (parts.welcome().isVisible())
        return {};
    return parts.bench().isVisible() ? parts.bench().firstViewName() : QStringLiteral("walk");
}

} // namespace faintline
