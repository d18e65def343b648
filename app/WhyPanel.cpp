#include "app/WhyPanel.h"

#include "app/Document.h"
#include "widgets/ChartPlot.h"
#include "widgets/quantities.h"

#include <QHeaderView>
#include <QLabel>
#include <QSplitter>
#include <QTableWidget>
#include <QTimer>
#include <QVBoxLayout>

#include <cmath>

namespace faintline {

namespace {

    constexpr int pauseMs = 60;
    constexpr std::size_t longestLadder = 2000; ///< steps; of a longer path the newest

    QString signedText(double value)
    {
        return (value > 0.0 ? QStringLiteral("+") : QString()) + numberText(value, 2);
    }

    Chart chartOf(const Explanation &explanation, const Axis &time)
    {
        Chart chart{"Evidence along the best path", "Time (s)", "Sum (nat)", false, false, {}};
        Curve sum{"sum of all terms", Curve::Kind::Measured, {}};
        for (const PathStep &step : explanation.steps)
            sum.points.push_back({time.value(static_cast<double>(step.frame)), step.score, {}});
        const double first = sum.points.front().x;
        const double last = sum.points.back().x;
        chart.curves.push_back(std::move(sum));
        chart.curves.push_back({"threshold", Curve::Kind::Theory, {{first, explanation.threshold, {}}, {last, explanation.threshold, {}}}});
        return chart;
    }

} // namespace

QString whySentence(const Explanation &explanation, const Axis &time, const Axis &frequency)
{
    double evidence = 0.0;
    double transitions = 0.0;
    double lnK = 0.0;
    for (const PathStep &step : explanation.steps) {
        evidence += step.logLikelihoodRatio;
        transitions += step.lnTransition;
        lnK += step.lnK;
    }
    const double margin = explanation.displayed - explanation.threshold;
    const auto steps = explanation.steps.size();
    const double since = time.value(static_cast<double>(explanation.steps.front().frame));
    QString words = QObject::tr("%1: D = %2 nat at %3 and %4, %5 nat %6 the threshold. ")
                        .arg(explanation.isTracked ? QObject::tr("Followed by a track")
                                                   : margin >= 0.0 ? QObject::tr("Detected") : QObject::tr("Not detected"),
                             numberText(explanation.displayed, 2), secondsText(explanation.seconds, time.step),
                             hertzText(explanation.position.back(), frequency.step), numberText(std::abs(margin), 2),
                             margin >= 0.0 ? QObject::tr("above") : QObject::tr("below"));
    words += steps == 1 ? QObject::tr("Starting afresh in this frame beats every path that came before. ")
                        : QObject::tr("The path has %1 steps; before %2 starting afresh was better than going on. ")
                              .arg(steps)
                              .arg(secondsText(since, time.step));
    return words
        + QObject::tr("Evidence %1, transitions %2, ln K %3 make %4.")
              .arg(signedText(evidence), signedText(transitions), signedText(lnK), numberText(explanation.statistic, 2));
}

WhyPanel::WhyPanel(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_sentence(new QLabel), m_plot(new ChartPlot), m_ladder(new QTableWidget(0, 6)),
      m_pause(new QTimer(this))
{
    m_sentence->setWordWrap(true);
    m_sentence->setTextFormat(Qt::PlainText);
    m_sentence->setContentsMargins(8, 6, 8, 4);
    m_sentence->setText(tr("Click in a picture: here stands why there is a detection, or none."));
    m_plot->setEmptySentence(tr("The evidence along the path appears here."));
    m_ladder->setHorizontalHeaderLabels({tr("Time"), tr("f"), tr("λ"), tr("ln P"), tr("ln K"), tr("Sum")});
    m_ladder->horizontalHeaderItem(2)->setToolTip(tr("Evidence: log-likelihood ratio of the cell's power, nat"));
    m_ladder->horizontalHeaderItem(3)->setToolTip(tr("Logarithm of the transition's probability, nat"));
    m_ladder->horizontalHeaderItem(4)->setToolTip(tr("What going on is credited with, against starting afresh, nat"));
    m_ladder->verticalHeader()->hide();
    m_ladder->verticalHeader()->setDefaultSectionSize(20);
    m_ladder->horizontalHeader()->setHighlightSections(false);
    m_ladder->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    m_ladder->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_ladder->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_ladder->setShowGrid(false);
    m_ladder->setFrameShape(QFrame::NoFrame);
    m_ladder->setAccessibleName(tr("The best path, newest step first"));
    auto *splitter = new QSplitter(Qt::Vertical);
    splitter->addWidget(m_plot);
    splitter->addWidget(m_ladder);
    splitter->setSizes({180, 240});
    splitter->setChildrenCollapsible(false);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_sentence);
    layout->addWidget(splitter, 1);

    m_pause->setSingleShot(true);
    m_pause->setInterval(pauseMs);
    connect(m_pause, &QTimer::timeout, this, &WhyPanel::explainCursor);
    connect(&document.viewport(), &Viewport::cursorChanged, this, &WhyPanel::follow);
    connect(&document, &Document::analysisChanged, this, &WhyPanel::follow);
    connect(&m_runner, &JobRunner::failed, this, [this](const Error &error) {
        m_sentence->setText(QString::fromUtf8(error.what()));
        emit settled();
    });
    connect(&m_runner, &JobRunner::finished, this, &WhyPanel::settled);
}

QString WhyPanel::sentence() const
{
    return m_sentence->text();
}

void WhyPanel::showEvent(QShowEvent *event)
{
    QWidget::showEvent(event);
    follow();
}

void WhyPanel::resizeEvent(QResizeEvent *event)
{
    constexpr int enoughForBoth = 400;
    m_plot->setVisible(height() >= enoughForBoth);
    QWidget::resizeEvent(event);
}

void WhyPanel::follow()
{
    if (isVisible())
        m_pause->start();
}

void WhyPanel::explainCursor()
{
    const auto &analysis = m_document.analysis();
    const auto cursor = m_document.viewport().cursor();
    const bool isOneAxis = analysis && analysis->grid().axes.size() == 1;
    if (analysis && !isOneAxis)
        m_sentence->setText(tr("Of pings the ladder is on the command line: faintline-cli explain with --time, --range and --bearing."));
    if (!isOneAxis || !cursor) {
        emit settled();
        return;
    }
    if (!std::holds_alternative<SmdSettings>(analysis->settings.detector)) {
        m_explanation.reset();
        m_ladder->setRowCount(0);
        m_plot->setChart({});
        m_sentence->setText(tr("Only the sequential Markov detector decides along a path; choose it to see why."));
        emit settled();
        return;
    }
    m_runner.start([this, analysis, point = *cursor](const RunContext &context) -> JobRunner::Delivery {
        auto explanation = explain(*analysis, point.seconds, {point.hz}, context);
        return [this, analysis, explanation = std::move(explanation)] { show(explanation, *analysis); };
    });
}

void WhyPanel::show(const Explanation &explanation, const Analysis &analysis)
{
    m_explanation = explanation;
    const Axis &time = analysis.time();
    const Axis &frequency = analysis.grid().axes.back();
    const StateSpace &space = analysis.model.space;
    const FrequencyUnit unit = frequencyUnit(std::max(std::abs(frequency.first), std::abs(frequency.last())));
    m_ladder->horizontalHeaderItem(1)->setText(tr("f (%1)").arg(unit.name));
    m_sentence->setText(whySentence(explanation, time, frequency));
    m_plot->setChart(chartOf(explanation, time));
    const std::size_t count = std::min(explanation.steps.size(), longestLadder);
    m_ladder->setRowCount(static_cast<int>(count));
    for (std::size_t row = 0; row < count; ++row) {
        const PathStep &step = explanation.steps[explanation.steps.size() - 1 - row];
        const QString texts[] = {secondsText(time.value(static_cast<double>(step.frame)), time.step),
                                 numberText(frequency.value(static_cast<double>(space.cellOf(step.state))) / unit.hz, decimalsFor(frequency.step / unit.hz)),
                                 signedText(step.logLikelihoodRatio),
                                 numberText(step.lnTransition, 2),
                                 signedText(step.lnK),
                                 numberText(step.score, 2)};
        for (int column = 0; column < 6; ++column) {
            auto *item = new QTableWidgetItem(texts[column]);
            item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            m_ladder->setItem(static_cast<int>(row), column, item);
        }
    }
}

} // namespace faintline
