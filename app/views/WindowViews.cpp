#include "app/views/WindowViews.h"

#include "app/base/tr.h"
#include "app/base/writeAndReport.h"
#include "app/control/EventFiles.h"
#include "app/control/EventReviews.h"
#include "app/control/OutputLayers.h"
#include "app/document/saveView.h"
#include "app/panels/ChannelsPanel.h"
#include "app/panels/ComparePanel.h"
#include "app/panels/DopplerPanel.h"
#include "app/panels/EvaluatePanel.h"
#include "app/panels/HandLinePanel.h"
#include "app/panels/InfoPanel.h"
#include "app/panels/LatencyPanel.h"
#include "app/panels/NoiseFitPanel.h"
#include "app/panels/SequentialPanel.h"
#include "app/panels/SpectrumPanel.h"
#include "app/panels/StateSlicePanel.h"
#include "app/panels/SurveyPanel.h"
#include "app/panels/SweepPanel.h"
#include "app/panels/TargetsPanel.h"
#include "app/panels/TrajectoryPage.h"
#include "app/panels/WhyPanel.h"
#include "app/views/WindowParts.h"
#include "app/workspace/PingBench.h"
#include "app/workspace/Workbench.h"
#include "widgets/base/Theme.h"
#include "widgets/base/TimeStack.h"
#include "widgets/events/EventTable.h"
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
    static const std::vector<WindowView> table{
        {"window", tr("Window"), Of::Recording, nullptr},
        {"input", tr("Input"), Of::Recording, [](Parts parts) { return parts.bench().inputView(); }},
        {"output", tr("Statistic"), Of::Recording, [](Parts parts) { return parts.bench().outputView(); }},
        {"threshold", tr("Threshold"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.thresholdPlot(); }},
        {"events", tr("Events"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.eventTable(); }},
        {"noise", tr("Noise and calibration"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.info(); }},
        {"noisefit", tr("Noise fit"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.noiseFit(); }},
        {"spectrum", tr("Spectrum"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.spectrum(); }},
        {"channels", tr("Channels"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.channels(); }},
        {"doppler", tr("Doppler fit"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.doppler(); }},
        {"pd", tr("Pd and ROC"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.evaluation(); }},
        {"why", tr("Why"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.why(); }},
        {"compare", tr("Compare"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.comparePanel(); }},
        {"sweep", tr("Sweep"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.sweep(); }},
        {"hand", tr("By hand"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.handLine(); }},
        {"slice", tr("States"), Of::Recording, [](Parts parts) -> QWidget * { return &parts.states(); }},
        {"map", tr("Maps"), Of::Pings, [](Parts parts) { return parts.pingBench().maps(); }},
        {"polar", tr("Maps from above"), Of::Pings, [](Parts parts) { return parts.pingBench().maps(); }},
        {"histories", tr("Histories"), Of::Pings, [](Parts parts) { return parts.pingBench().histories(); }},
        {"latency", tr("Latency"), Of::Pings, [](Parts parts) -> QWidget * { return &parts.latency(); }},
        {"targets", tr("Targets"), Of::Pings, [](Parts parts) -> QWidget * { return &parts.targets(); }},
        {"sequential", tr("Sequential test"), Of::Scans, [](Parts parts) -> QWidget * { return &parts.sequential(); }},
        {"walk", tr("Walks"), Of::Scans, [](Parts parts) -> QWidget * { return &parts.sequential().walk(); }},
        {"stopping", tr("Stopping stages"), Of::Scans,
         [](Parts parts) -> QWidget * { return &parts.sequential().stopping(); }},
        {"posterior", tr("Posterior"), Of::Scans,
         [](Parts parts) -> QWidget * { return &parts.sequential().trajectory().posterior(); }},
        {"scan", tr("Scan"), Of::Scans,
         [](Parts parts) -> QWidget * { return &parts.sequential().trajectory().scan(); }},
        {"asn", tr("Average sample number"), Of::Scans, [](Parts parts) { return parts.sequential().curvesPage(); }},
        {"prior", tr("Prior"), Of::Scans, [](Parts parts) { return parts.sequential().priorPage(); }},
        {"sectors", tr("Sectors"), Of::Scans, [](Parts parts) { return parts.sequential().sectorsPage(); }},
        {"survey", tr("Survey"), Of::Survey, [](Parts parts) -> QWidget * { return &parts.survey(); }},
    };
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
