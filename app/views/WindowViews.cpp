#include "app/views/WindowViews.h"

#include "app/base/tr.h"
#include "app/base/writeAndReport.h"
#include "app/document/OutputLayers.h"
#include "app/document/saveView.h"
#include "app/features/events/EventFiles.h"
#include "app/features/events/EventReviews.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/features/sequential/TrajectoryPage.h"
#include "app/views/WindowParts.h"
#include "widgets/base/Theme.h"
#include "widgets/base/TimeStack.h"
#include "widgets/pings/PingMap.h"
#include "widgets/plot/BarPlot.h"
#include "widgets/plot/CellPicture.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/WalkPlot.h"

#include <QApplication>
#include <QFileDialog>

#include <algorithm>

namespace faintline {

namespace {

    using Parts = const WindowParts &;
    using Of = WindowView::Of;

} // namespace

const std::vector<WindowView> &windowViews()
{
    static const std::vector<WindowView> table = [] {
        using Test = SequentialPanel;
        std::vector<WindowView> views{
            {"window", tr("Window"), Of::Recording, nullptr},
            {"input", tr("Input"), Of::Recording, [](Parts parts) { return parts.bench().inputView(); }},
            {"output", tr("Statistic"), Of::Recording, [](Parts parts) { return parts.bench().outputView(); }},
            {"threshold", tr("Threshold"), Of::Recording, [](Parts parts) { return &parts.thresholdPlot(); }},
            {"map", tr("Maps"), Of::Pings, [](Parts parts) { return parts.pingBench().maps(); }},
            {"polar", tr("Maps from above"), Of::Pings, [](Parts parts) { return parts.pingBench().maps(); }},
            {"histories", tr("Histories"), Of::Pings, [](Parts parts) { return parts.pingBench().histories(); }},
            {"walk", tr("Walks"), Of::Scans, [](Parts parts) { return &parts.panel<Test>().walk(); }},
            {"stopping", tr("Stopping stages"), Of::Scans, [](Parts parts) { return &parts.panel<Test>().stopping(); }},
            {"posterior", tr("Posterior"), Of::Scans,
             [](Parts parts) { return &parts.panel<Test>().trajectory().posterior(); }},
            {"scan", tr("Scan"), Of::Scans, [](Parts parts) { return &parts.panel<Test>().trajectory().scan(); }},
            {"asn", tr("Average sample number"), Of::Scans,
             [](Parts parts) { return parts.panel<Test>().curvesPage(); }},
            {"prior", tr("Prior"), Of::Scans, [](Parts parts) { return parts.panel<Test>().priorPage(); }},
            {"sectors", tr("Sectors"), Of::Scans, [](Parts parts) { return parts.panel<Test>().sectorsPage(); }},
        };
        for (const PanelRow &row : panelList())
            if (!row.view.isEmpty())
                views.push_back(
                    {row.view, row.title, row.of, [dock = row.dock](Parts parts) { return parts.docked(dock); }});
        return views;
    }();
    return table;
}

WindowViews::WindowViews(WindowParts &parts, QWidget *window) : QObject(window), m_parts(parts), m_window(window) {}

const QStringList &WindowViews::names()
{
    static const QStringList names = [] {
        QStringList all;
        for (const WindowView &view : windowViews())
            all << view.name;
        return all;
    }();
    return names;
}

QWidget *WindowViews::named(const QString &name) const
{
    const auto &table = windowViews();
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const WindowView &view) { return view.name == name; });
    if (found == table.end())
        return nullptr;
    return found->widget ? found->widget(m_parts) : m_window;
}

QPixmap WindowViews::grab(const QString &name) const
{
    QWidget &view = *named(name);
    const TimeStack::Part part(m_parts.bench().timeStack(), view);
    return view.grab();
}

void WindowViews::exportPicture(const QString &name)
{
    const QString path = QFileDialog::getSaveFileName(m_window, tr("Export picture"), name + QStringLiteral(".png"),
                                                      tr("Picture (*.png);;Drawing (*.svg);;Document (*.pdf)"));
    if (!path.isEmpty())
        saveTo(name, path);
}

void WindowViews::saveTo(const QString &name, const QString &path)
{
    m_parts.reviews().files().provenance().with([this, name, path](const std::string &provenance) {
        writeAndReport(*this, path, [&] {
            QWidget &view = *named(name);
            const TimeStack::Part part(m_parts.bench().timeStack(), view);
            saveView(view, {}, path, withView(name, provenance));
        });
    });
}

/// Adds the data that `faintline render` needs to reproduce the picture, if it shows one view at one device pixel per
/// pixel.
std::string WindowViews::withView(const QString &name, const std::string &provenance) const
{
    const QWidget &shown = *named(name);
    if (&shown == m_window || shown.devicePixelRatioF() != 1.0)
        return provenance;
    const OutputLayers &layers = m_parts.workbench().layers();
    Json json = parseJson(provenance, "provenance");
    json["view"] = toJson(m_parts.viewState());
    json["render"] = {
        {"view", name.toStdString()},
        {"size", {shown.width(), shown.height()}},
        {"theme", Theme::nameOf(Theme::kind(m_window->palette())).toStdString()},
        {"layer", std::string(outputLayerNames[std::size_t(layers.layer())])},
        {"overlay", layers.isOverlay()},
        {"focused", shown.isAncestorOf(QApplication::focusWidget()) || &shown == QApplication::focusWidget()}};
    return json.dump(2) + "\n";
}

} // namespace faintline
