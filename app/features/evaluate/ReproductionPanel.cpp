#include "app/features/evaluate/ReproductionPanel.h"

#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/table/ColumnTable.h"

#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QRegularExpression>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <limits>

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

    /// The number in "-3 dB" or "σ = 0.5", which orders the cells of a sweep.
    double sweptNumber(const QString &text)
    {
        static const QRegularExpression number(QStringLiteral("(?:^|= )(-?[0-9.]+(?:e[-+]?[0-9]+)?)"));
        const QRegularExpressionMatch match = number.match(text);
        return match.hasMatch() ? match.captured(1).toDouble() : std::numeric_limits<double>::quiet_NaN();
    }

    std::vector<TableHeading> reproducedHeadings()
    {
        return {{ReproductionPanel::tr("Detector"), {}, Qt::AlignLeft},
                {ReproductionPanel::tr("At"), {}, Qt::AlignLeft},
                {ReproductionPanel::tr("Paper")},
                {ReproductionPanel::tr("Reference")},
                {ReproductionPanel::tr("Ours")},
                {ReproductionPanel::tr("95 % interval")},
                {ReproductionPanel::tr("Gap to paper")},
                {ReproductionPanel::tr("Tolerance"), {}, Qt::AlignLeft}};
    }

} // namespace

ReproductionPanel::ReproductionPanel(QWidget *parent)
    : QWidget(parent), m_title(new QLabel(tr("Choose a table or figure from the Reproduce menu."))),
      m_notes(new QLabel), m_table(new ColumnTable(tr("Paper, ours, interval and gap"))), m_which(new QComboBox),
      m_plot(new ChartPlot)
{
    m_title->setFont(Theme::boldFont(13));
    m_title->setWordWrap(true);
    m_title->setContentsMargins(8, 5, 8, 3);
    m_notes->setWordWrap(true);
    m_notes->setContentsMargins(8, 3, 8, 5);
    m_table->show(reproducedHeadings());
    m_table->horizontalHeader()->setStretchLastSection(true);
    m_table->setAlternatingRowColors(true);
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
    m_plot->setEmptySentence(tr("This one has no chart."));
    m_plot->setChart(m_reproduction->charts.empty() ? Chart() : m_reproduction->charts.front());
    fillTable();
}

void ReproductionPanel::fillTable()
{
    if (!m_reproduction)
        return;
    const Theme::Colours &colours = Theme::colours(*this);
    const auto number = [](const std::optional<double> &value) {
        return value ? TableCell{figure(*value), *value} : TableCell{QStringLiteral("–")};
    };
    std::vector<std::vector<TableCell>> rows;
    for (const ReproducedCell &cell : m_reproduction->cells) {
        const bool hasInterval = cell.interval.low < cell.interval.high;
        const double gap = cell.paper ? cell.ours - *cell.paper : 0.0;
        const auto z = cell.z();
        const QString column = QString::fromStdString(cell.column);
        rows.push_back(
            {{QString::fromStdString(cell.row)},
             {column, sweptNumber(column)},
             number(cell.paper),
             number(cell.reference),
             number(cell.ours),
             hasInterval ? TableCell{figure(cell.interval.low) + QStringLiteral(" … ") + figure(cell.interval.high),
                                     cell.interval.low}
                         : TableCell{},
             cell.paper ? TableCell{numberText(gap, 3) + (z ? tr(" (%1 σ)").arg(numberText(*z, 1)) : QString()), gap}
                        : TableCell{},
             {.text = verdict(cell),
              .colour = cell.isJudged() && !cell.isInside() ? QVariant(colours.error) : QVariant()}});
    }
    m_table->show(reproducedHeadings(), std::move(rows));
    m_table->resizeColumnsToContents();
}

void ReproductionPanel::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange)
        fillTable();
}

} // namespace faintline
