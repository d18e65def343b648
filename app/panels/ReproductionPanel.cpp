#include "app/panels/ReproductionPanel.h"

#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/ChartPlot.h"

#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QSplitter>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    QString figure(double value)
    {
        return numberText(value, std::abs(value) < 10.0 ? 3 : 1);
    }

    QString verdict(const ReproducedCell &cell)
    {
        if (!cell.isJudged())
            return QObject::tr("not judged");
        return cell.isInside() ? QObject::tr("inside") : QObject::tr("outside");
    }

} // namespace

ReproductionPanel::ReproductionPanel(QWidget *parent)
    : QWidget(parent), m_title(new QLabel(tr("Choose a table or figure from the Reproduce menu."))),
      m_notes(new QLabel), m_table(new QTableWidget(0, 8)), m_which(new QComboBox), m_plot(new ChartPlot)
{
    m_title->setFont(Theme::boldFont(13));
    m_title->setWordWrap(true);
    m_title->setContentsMargins(8, 5, 8, 3);
    m_notes->setWordWrap(true);
    m_notes->setContentsMargins(8, 3, 8, 5);
    m_table->setHorizontalHeaderLabels({tr("Detector"), tr("At"), tr("Paper"), tr("Reference"), tr("Ours"),
                                        tr("95 % interval"), tr("Gap to paper"), tr("Tolerance")});
    m_table->verticalHeader()->hide();
    m_table->verticalHeader()->setDefaultSectionSize(22);
    m_table->horizontalHeader()->setHighlightSections(false);
    m_table->horizontalHeader()->setStretchLastSection(true);
    m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->setShowGrid(false);
    m_table->setAlternatingRowColors(true);
    m_table->setFrameShape(QFrame::NoFrame);
    m_table->setAccessibleName(tr("Paper, ours, interval and gap"));
    m_plot->setEmptySentence(tr("The chart appears here."));
    m_which->hide();
    m_which->setAccessibleName(tr("Chart"));

    auto *left = new QWidget;
    auto *leftLayout = new QVBoxLayout(left);
    leftLayout->setContentsMargins(0, 0, 0, 0);
    leftLayout->setSpacing(0);
    leftLayout->addWidget(m_title);
    leftLayout->addWidget(m_table, 1);
    leftLayout->addWidget(m_notes);
    auto *right = new QWidget;
    auto *rightLayout = new QVBoxLayout(right);
    rightLayout->setContentsMargins(0, 0, 0, 0);
    rightLayout->addWidget(m_which);
    rightLayout->addWidget(m_plot, 1);
    auto *splitter = new QSplitter(Qt::Horizontal);
    splitter->addWidget(left);
    splitter->addWidget(right);
    splitter->setSizes({480, 420});
    splitter->setChildrenCollapsible(false);
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(splitter);
    connect(m_which, &QComboBox::activated, this,
            [this](int index) { m_plot->setChart(m_reproduction->charts[std::size_t(index)]); });
}

void ReproductionPanel::show(std::shared_ptr<const Reproduction> reproduction)
{
    m_reproduction = std::move(reproduction);
    const auto &cells = m_reproduction->cells;
    const auto judged =
        std::count_if(cells.begin(), cells.end(), [](const ReproducedCell &cell) { return cell.isJudged(); });
    const auto inside = std::count_if(cells.begin(), cells.end(),
                                      [](const ReproducedCell &cell) { return cell.isJudged() && cell.isInside(); });
    m_title->setText(judged > 0 ? tr("%1: %2 of %3 values within tolerance")
                                      .arg(QString::fromStdString(m_reproduction->title))
                                      .arg(inside)
                                      .arg(judged)
                                : QString::fromStdString(m_reproduction->title));
    QStringList notes{QString::fromStdString(m_reproduction->quantity)};
    for (const std::string &note : m_reproduction->notes)
        notes << QString::fromStdString(note);
    m_notes->setText(notes.join(QLatin1Char('\n')));
    m_which->clear();
    for (const Chart &chart : m_reproduction->charts)
        m_which->addItem(QString::fromStdString(chart.title));
    m_which->setVisible(m_reproduction->charts.size() > 1);
    m_plot->setChart(m_reproduction->charts.empty() ? Chart() : m_reproduction->charts.front());
    fillTable();
}

void ReproductionPanel::fillTable()
{
    if (!m_reproduction)
        return;
    const Theme::Colours &colours = Theme::colours(*this);
    m_table->setRowCount(int(m_reproduction->cells.size()));
    for (int row = 0; row < m_table->rowCount(); ++row) {
        const ReproducedCell &cell = m_reproduction->cells[std::size_t(row)];
        const bool hasInterval = cell.interval.low < cell.interval.high;
        const auto z = cell.z();
        const QString gap = !cell.paper ? QString()
                                        : numberText(cell.ours - *cell.paper, 3)
                                              + (z ? tr(" (%1 σ)").arg(numberText(*z, 1)) : QString());
        const QString texts[] = {
            QString::fromStdString(cell.row),
            QString::fromStdString(cell.column),
            cell.paper ? figure(*cell.paper) : QStringLiteral("–"),
            cell.reference ? figure(*cell.reference) : QStringLiteral("–"),
            figure(cell.ours),
            hasInterval ? figure(cell.interval.low) + QStringLiteral(" … ") + figure(cell.interval.high) : QString(),
            gap,
            verdict(cell)};
        for (int column = 0; column < 8; ++column) {
            auto *item = new QTableWidgetItem(texts[column]);
            if (column >= 2 && column <= 6)
                item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            if (column == 7 && cell.isJudged() && !cell.isInside())
                item->setForeground(colours.error);
            m_table->setItem(row, column, item);
        }
    }
    m_table->resizeColumnsToContents();
}

void ReproductionPanel::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange)
        fillTable();
}

} // namespace faintline
