#include "app/WindowViews.h"

#include "app/ComparePanel.h"
#include "app/EvaluatePanel.h"
#include "app/EventReviews.h"
#include "app/HandLinePanel.h"
#include "app/InfoPanel.h"
#include "app/LatencyPanel.h"
#include "app/MainWindow.h"
#include "app/NoiseFitPanel.h"
#include "app/OutputLayers.h"
#include "app/PingBench.h"
#include "app/SequentialPanel.h"
#include "app/StateSlicePanel.h"
#include "app/SweepPanel.h"
#include "app/TrajectoryPage.h"
#include "app/WhyPanel.h"
#include "app/Workbench.h"
#include "app/saveView.h"
#include "widgets/BarPlot.h"
#include "widgets/CellPicture.h"
#include "widgets/EventTable.h"
#include "widgets/ExceedancePlot.h"
#include "widgets/PingMap.h"
#include "widgets/WalkPlot.h"

#include <QApplication>
#include <QFileDialog>
#include <QHash>

namespace faintline {

WindowViews::WindowViews(MainWindow &window) : QObject(&window), m_window(window) {}

const QStringList &WindowViews::names()
{
    static const QStringList names{"window",  "input",      "output", "threshold", "events",    "noise", "noisefit", "pd",    "why",
                                   "compare", "sweep",      "hand",   "map",       "polar",     "slice", "histories", "latency",
                                   "sequential", "walk",    "stopping", "posterior", "scan",    "asn",   "prior",    "sectors"};
    return names;
}

QWidget *WindowViews::named(const QString &name) const
{
    const bool hasPings = m_window.document().hasPings();
    Workbench &bench = m_window.workbench();
    PingBench &pings = m_window.pingBench();
    SequentialPanel &sequential = m_window.sequential();
    const QHash<QString, QWidget *> views{
        {"window", &m_window},
        {"input", hasPings ? static_cast<QWidget *>(pings.input()) : bench.inputPane()},
        {"output", hasPings ? static_cast<QWidget *>(pings.output()) : bench.outputPane()},
        {"threshold", &m_window.thresholdPlot()},
        {"events", &m_window.eventTable()},
        {"noise", &m_window.info()},
        {"noisefit", &m_window.noiseFit()},
        {"pd", &m_window.evaluation()},
        {"why", &m_window.why()},
        {"compare", &m_window.comparePanel()},
        {"sweep", &m_window.sweep()},
        {"map", pings.maps()},
        {"polar", pings.maps()},
        {"slice", &m_window.states()},
        {"histories", pings.histories()},
        {"latency", &m_window.latency()},
        {"hand", &m_window.handLine()},
        {"sequential", &sequential},
        {"walk", &sequential.walk()},
        {"stopping", &sequential.stopping()},
        {"posterior", &sequential.trajectory().posterior()},
        {"scan", &sequential.trajectory().scan()},
        {"asn", sequential.curvesPage()},
        {"prior", sequential.priorPage()},
        {"sectors", sequential.sectorsPage()},
    };
    return views.value(name);
}

void WindowViews::exportPicture(const QString &name)
{
    const QString path = QFileDialog::getSaveFileName(&m_window, tr("Export picture"), name + QStringLiteral(".png"),
                                                      tr("Picture (*.png);;Drawing (*.svg);;Document (*.pdf)"));
    if (!path.isEmpty())
        saveTo(name, path);
}

void WindowViews::saveTo(const QString &name, const QString &path)
{
    m_window.reviews().provenance().with([this, name, path](const std::string &provenance) {
        try {
            saveView(*named(name), {}, path, withView(name, provenance));
        } catch (const Error &error) {
            emit failed(error);
        }
    });
}

/// With what `faintline render` needs to make the picture again, where it can: of one view, on a screen as its own.
std::string WindowViews::withView(const QString &name, const std::string &provenance) const
{
    const QWidget &shown = *named(name);
    if (&shown == &m_window || shown.devicePixelRatioF() != 1.0)
        return provenance;
    const OutputLayers &layers = m_window.workbench().layers();
    Json json = parseJson(provenance, "provenance");
    json["view"] = toJson(m_window.bench().viewState());
    json["render"] = {{"view", name.toStdString()},
                      {"size", {shown.width(), shown.height()}},
                      {"theme", Theme::nameOf(Theme::kind(m_window.palette())).toStdString()},
                      {"layer", std::string(outputLayerNames[static_cast<std::size_t>(layers.layer())])},
                      {"overlay", layers.isOverlay()},
                      {"focused", shown.isAncestorOf(QApplication::focusWidget()) || &shown == QApplication::focusWidget()}};
    return json.dump(2) + "\n";
}

} // namespace faintline
