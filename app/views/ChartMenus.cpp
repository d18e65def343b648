#include "app/views/ChartMenus.h"

#include "app/base/filePath.h"
#include "app/base/writeAndReport.h"
#include "app/document/saveView.h"
#include "app/features/evaluate/EvaluatePanel.h"
#include "app/features/evaluate/SweepPanel.h"
#include "app/features/events/EventFiles.h"
#include "app/features/events/EventReviews.h"
#include "app/features/inspect/ChannelsPanel.h"
#include "app/features/inspect/NoiseFitPanel.h"
#include "app/features/inspect/SpectrumPanel.h"
#include "app/features/pictures/Bench.h"
#include "app/views/WindowParts.h"
#include "app/views/chartCaption.h"
#include "exchange/writeChart.h"
#include "widgets/base/TimeStack.h"
#include "widgets/plot/ChartFigure.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/plot/plotCsv.h"
#include "widgets/table/ColumnTable.h"

#include <QFileDialog>
#include <QMenu>

namespace faintline {

namespace {

    std::string csvOf(QWidget &chart)
    {
        if (const auto *table = qobject_cast<ColumnTable *>(&chart))
            return table->csv();
        if (const auto *plot = qobject_cast<ChartPlot *>(&chart))
            return chartCsv(plot->chart());
        if (const auto *plot = qobject_cast<ExceedancePlot *>(&chart))
            return plotCsv(*plot, true);
        return plotCsv(static_cast<QwtPlot &>(static_cast<StripPlot &>(chart)), false);
    }

} // namespace

ChartMenus::ChartMenus(WindowParts &parts, QWidget *window) : QObject(window), m_parts(parts), m_window(window)
{
    const auto offer = [this](QWidget *chart) {
        if (chart->contextMenuPolicy() == Qt::CustomContextMenu)
            return;
        chart->setContextMenuPolicy(Qt::CustomContextMenu);
        connect(chart, &QWidget::customContextMenuRequested, this, [this, chart](const QPoint &at) {
            QMenu menu;
            menu.addAction(tr("Save chart…"), this, [this, chart] { ask(*chart); });
            menu.exec(chart->mapToGlobal(at));
        });
    };
    for (ChartPlot *chart : window->findChildren<ChartPlot *>())
        offer(chart);
    for (StripPlot *chart : window->findChildren<StripPlot *>())
        offer(chart);
    for (ColumnTable *table : window->findChildren<ColumnTable *>()) {
        connect(table->addAction(tr("Save table…")), &QAction::triggered, this, [this, table] {
            if (const QString path = QFileDialog::getSaveFileName(m_window, tr("Save table"),
                                                                  QStringLiteral("table.csv"), tr("Numbers (*.csv)"));
                !path.isEmpty())
                saveTo(*table, path);
        });
    }
    connect(&parts.thresholdPlot(), &ExceedancePlot::contextMenuRequested, this, [this](QMenu *menu) {
        menu->addSeparator();
        menu->addAction(tr("Save chart…"), this, [this] { ask(m_parts.thresholdPlot()); });
    });
}

QString ChartMenus::captionFor(const QWidget &chart) const
{
    const auto of = [this](int experiment) {
        const Experiments::Entry *entry = m_parts.experiments().entry(experiment);
        return entry ? captionOf(*entry) : captionOf(m_parts.document(), CaptionOf::Statistic);
    };
    if (m_parts.panel<EvaluatePanel>().isAncestorOf(&chart))
        return of(m_parts.panel<EvaluatePanel>().shown());
    if (m_parts.panel<SweepPanel>().isAncestorOf(&chart))
        return of(m_parts.panel<SweepPanel>().shown());
    const bool isOfInput = m_parts.panel<SpectrumPanel>().isAncestorOf(&chart)
                           || m_parts.panel<ChannelsPanel>().isAncestorOf(&chart)
                           || m_parts.panel<NoiseFitPanel>().isAncestorOf(&chart);
    return captionOf(m_parts.document(), isOfInput ? CaptionOf::Input : CaptionOf::Statistic);
}

void ChartMenus::ask(QWidget &chart)
{
    const QString path = QFileDialog::getSaveFileName(m_window, tr("Save chart"), QStringLiteral("chart.svg"),
                                                      tr("Drawing (*.svg);;Document (*.pdf);;Picture (*.png);;Numbers "
                                                         "(*.csv)"));
    if (!path.isEmpty())
        saveTo(chart, path);
}

void ChartMenus::saveTo(QWidget &chart, const QString &path)
{
    const auto save = [this, path, &chart](const std::string &provenance) {
        writeAndReport(*this, path, [&] {
            const auto *plot = qobject_cast<ChartPlot *>(&chart);
            const QString caption = captionFor(chart);
            const TimeStack::Part part(m_parts.bench().timeStack(), chart); // with a time axis of its own
            const auto figure =
                plot ? std::make_unique<ChartFigure>(*plot, caption) : std::make_unique<ChartFigure>(chart, caption);
            saveView(*figure, csvOf(chart), path, provenance);
        });
    };
    m_parts.document().isEmpty() ? save({}) : m_parts.reviews().files().provenance().with(save);
}

} // namespace faintline
