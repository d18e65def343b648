#include "app/features/inspect/WhyPanel.h"

#include "app/document/Document.h"
#include "app/document/FramePlace.h"
#include "app/document/statisticUnit.h"
#include "base/logmath.h"
#include "widgets/base/Theme.h"
#include "widgets/base/axisWords.h"
#include "widgets/base/familyWords.h"
#include "widgets/base/labelText.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/table/ColumnTable.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr int pauseMs = 60;                 ///< while the cursor moves
    constexpr std::size_t longestLadder = 2000; ///< steps; of a longer path the newest

    QString signedText(double value)
    {
        return (value > 0.0 ? QStringLiteral("+") : QString()) + numberText(value, 2);
    }

    const StateSpace &spaceOf(const Explanation &explanation, const Analysis &analysis)
    {
        return analysis.modelAt(explanation.modelAt(explanation.steps.back().frame)).space;
    }

    Chart chartOf(const Explanation &explanation, const Axis &time)
    {
        Chart chart{"Evidence along the best path", "Time (s)", "Sum (nat)", false, false, {}};
        Curve sum{"sum of all terms", Curve::Kind::Measured, {}};
        for (const PathStep &step : explanation.steps)
            sum.points.push_back({time.value(double(step.frame)), step.score, {}});
        const double first = sum.points.front().x;
        const double last = sum.points.back().x;
        chart.curves.push_back(std::move(sum));
        chart.curves.push_back({"threshold",
                                Curve::Kind::Theory,
                                {{first, explanation.threshold, {}}, {last, explanation.threshold, {}}}});
        return chart;
    }

    QString axisText(const Axis &axis, double value)
    {
        return axis.unit == "Hz" ? hertzText(value, axis.step) : valueText(axis, value, axis.step);
    }

    QString placeWords(const std::vector<double> &position, const Grid &grid)
    {
        QStringList words;
        for (std::size_t axis = 0; axis < position.size(); ++axis)
            words << axisText(grid.axes[axis], position[axis]);
        return words.join(QStringLiteral(", "));
    }

    /// The rates of a state: "the state of slope 0.19 mHz/s".
    QString rateWords(Index state, const Explanation &explanation, const Analysis &analysis)
    {
        const StateSpace &space = spaceOf(explanation, analysis);
        const std::vector<double> rates = space.ratesOfPlane(space.planeOf(state));
        QStringList words;
        for (std::size_t axis = 0; axis < rates.size(); ++axis) {
            const Axis &along = analysis.grid().axes[axis];
            const double rate = rates[axis] * along.step / analysis.time().step;
            words << (along.unit == "Hz"
                          ? rateText(rate)
                          : QStringLiteral("%1 %2/s").arg(powerText(rate, 3), labelText(along.unit, mostUnitLetters)));
        }
        return QObject::tr("the state of %1").arg(words.join(QStringLiteral(", ")));
    }

    /// Follows "The path begins …".
    QString resetWords(const ResetCause &reset)
    {
        switch (reset.kind) {
        case ResetCause::Kind::Beginning:
            return QObject::tr(", with the recording.");
        case ResetCause::Kind::Background:
            return std::isfinite(reset.lost)
                       ? QObject::tr(": continuing an earlier path would have started %1 nat below the background.")
                             .arg(numberText(reset.lost, 2))
                       : QObject::tr(": no earlier path leads there.");
        case ResetCause::Kind::Forgotten:
            break;
        }
        return reset.track > 0
                   ? QObject::tr(": the previous score, %1 nat, was discarded when track %2 started.")
                         .arg(numberText(reset.lost, 2))
                         .arg(reset.track)
                   : QObject::tr(": the previous score, %1 nat, was discarded.").arg(numberText(reset.lost, 2));
    }

} // namespace

QString whySentence(const Explanation &explanation, const Analysis &analysis)
{
    double evidence = 0.0;
    double transitions = 0.0;
    double lnK = 0.0;
    for (const PathStep &step : explanation.steps) {
        evidence += step.logLikelihoodRatio;
        transitions += step.lnTransition;
        lnK += step.lnK;
    }
    const Axis &time = analysis.time();
    const double margin = explanation.displayed - explanation.threshold;
    QString words;
    if (explanation.otherWindowTrack && !explanation.isTracked)
        words = QObject::tr("Event %1 passes here; a window of %2 found it. In the window that is shown: ")
                    .arg(*explanation.otherWindowTrack)
                    .arg(secondsText(explanation.otherWindowSeconds, 0.1 * explanation.otherWindowSeconds));
    words += QObject::tr("%1: D = %2 %7 at %3 and %4, %5 %7 %6 the threshold. ")
                 .arg(explanation.isTracked ? QObject::tr("Followed by a track")
                      : margin >= 0.0       ? QObject::tr("Detected")
                                            : QObject::tr("Not detected"),
                      numberText(explanation.displayed, 2), secondsText(explanation.seconds, time.step),
                      placeWords(explanation.position, analysis.grid()), numberText(std::abs(margin), 2),
                      margin >= 0.0 ? QObject::tr("above") : QObject::tr("below"), statisticUnit(analysis.settings));
    if (!isScoreOfPaths(analysis.settings.detector))
        words += QObject::tr("This detector has no paths; the path below, in nats, is that of the sequential Markov "
                             "detector that guides its tracks. ");
    if (explanation.inhibitedFor)
        words += *explanation.inhibitedFor > 0
                     ? QObject::tr("This cell is inhibited by track %1. ").arg(*explanation.inhibitedFor)
                 : *explanation.inhibitedFor < 0
                     ? QObject::tr("This cell is inhibited by a track that was dropped later. ")
                     : QObject::tr("This cell is excluded: no signal is looked for here. ");
    if (explanation.isSubtracted)
        words += QObject::tr("A line was subtracted here; the path is that of the remainder. ");
    if (explanation.isExplainedByNoise)
        words += QObject::tr("The path through this cell is not reported: cells as strong as its own, or runs of "
                             "them, are common in this recording's noise. ");
    const auto steps = explanation.steps.size();
    const QString since = secondsText(time.value(double(explanation.steps.front().frame)), time.step);
    words += steps == 1 ? QObject::tr("The path begins in this frame")
                        : QObject::tr("The path has %1 steps and begins at %2").arg(steps).arg(since);
    words += resetWords(explanation.reset) + QLatin1Char(' ');
    for (const ModelChange &change : explanation.modelChanges)
        words += QObject::tr("From %1 on, the track belongs to the %2 model. ")
                     .arg(secondsText(time.value(double(change.frame)), time.step),
                          change.model == 0 ? QObject::tr("non-manoeuvring") : QObject::tr("manoeuvring"));
    if (explanation.otherState && std::isfinite(explanation.otherMargin))
        words +=
            QObject::tr("Runner-up: %1, %2 nat behind. ")
                .arg(rateWords(*explanation.otherState, explanation, analysis), numberText(explanation.otherMargin, 2));
    words += QObject::tr("Evidence %1, transitions %2, ln K %3")
                 .arg(signedText(evidence), signedText(transitions), signedText(lnK));
    if (explanation.offset != 0.0)
        words += QObject::tr(", %1 %2").arg(!analysis.isBank() ? QObject::tr("K of the last frame")
                                                               : QObject::tr("K and the model's threshold"),
                                            signedText(explanation.offset));
    return words + QObject::tr(" add up to %1.").arg(numberText(explanation.statistic, 2));
}

QString teethSentence(const std::vector<FamilyTooth> &teeth, const FamilySettings &family)
{
    QStringList unseen;
    for (const FamilyTooth &tooth : teeth)
        if (!tooth.isSeen())
            unseen << toothText(family, tooth);
    const bool areChannels = family.isNone();
    if (unseen.isEmpty())
        return (areChannels ? QObject::tr("Each of the %1 channels raises the evidence.")
                            : QObject::tr("Each of the %1 members raises the evidence."))
            .arg(teeth.size());
    return (areChannels ? QObject::tr("%1 of %2 channels raise the evidence; it is no smaller without %3.")
                        : QObject::tr("%1 of %2 members raise the evidence; it is no smaller without %3."))
        .arg(std::ssize(teeth) - unseen.size())
        .arg(teeth.size())
        .arg(unseen.join(QStringLiteral(", ")));
}

static std::vector<TableHeading> ladderHeadings(const Grid &grid, const ColumnTimes &times)
{
    std::vector<TableHeading> headings{{times.heading(WhyPanel::tr("Time"))}};
    for (const Axis &axis : grid.axes)
        headings.push_back({axis.unit == "Hz" ? WhyPanel::tr("f (%1)").arg(shownUnit(axis).name) : titleOf(axis)});
    headings.insert(
        headings.end(),
        {{WhyPanel::tr("λ"), WhyPanel::tr("Evidence: log-likelihood ratio of the cell's power, nat")},
         {WhyPanel::tr("ln P"), WhyPanel::tr("Logarithm of the transition's probability, nat")},
         {WhyPanel::tr("ln K"), WhyPanel::tr("ln K: bonus for continuing the path instead of restarting it (nat)")},
         {WhyPanel::tr("Sum"), WhyPanel::tr("Sum of all terms so far, nat above background")},
         {WhyPanel::tr("2nd"), WhyPanel::tr("Margin over the second-best transition into this step, nat")}});
    return headings;
}

WhyPanel::WhyPanel(Document &document, const PingViewports &viewports, QWidget *parent)
    : QWidget(parent), m_document(document), m_viewports(viewports), m_sentence(panelSentence()), m_cure(plainLabel()),
      m_remedy(new QPushButton), m_plot(new ChartPlot),
      m_teeth(new ColumnTable(tr("The members of the family along the path"))),
      m_ladder(new ColumnTable(tr("The best path, newest step first"))),
      m_why(
          this, &WhyPanel::question,
          [](const auto &analysis, double seconds, const auto &position, const RunContext &context) {
              const Explanation explanation = explain(*analysis, seconds, position, context.part(0.0, 0.9));
              return Reason{explanation, familyTeeth(*analysis, explanation, context.part(0.9, 0.95)),
                            adviceOnCell(*analysis, explanation, context.part(0.95, 1.0))};
          },
          &WhyPanel::show)
{
    m_sentence->setContentsMargins(8, 6, 8, 4);
    m_cure->setWordWrap(true);
    m_cure->setFont(Theme::boldFont());
    m_cure->setContentsMargins(8, 6, 8, 4);
    m_remedy->setObjectName(QStringLiteral("remedy"));
    m_remedy->setAccessibleName(tr("Remedy"));
    connect(m_remedy, &QPushButton::clicked, this, [this] { emit remedyRequested(*m_why.answer()->advice); });
    m_plot->setEmptySentence(tr("The evidence along the path appears here."));
    buildTables();
    auto *splitter = new QSplitter(Qt::Vertical);
    for (QWidget *part : std::initializer_list<QWidget *>{m_plot, m_teeth, m_ladder})
        splitter->addWidget(part);
    splitter->setSizes({180, 190, 240});
    splitter->setChildrenCollapsible(false);
    auto *content = new QWidget;
    auto *layout = new QVBoxLayout(content);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_cure);
    auto *remedy = new QHBoxLayout;
    remedy->setContentsMargins(8, 0, 8, 0);
    remedy->addWidget(m_remedy, 0, Qt::AlignLeft);
    layout->addLayout(remedy);
    layout->addWidget(m_sentence);
    layout->addWidget(splitter, 1);
    setScrolledColumn(*this, content); // in a low panel, the whole sentence comes first

    m_why.setPause(pauseMs);
    m_why.watch(*this, m_sentence);
    m_why.askAt(document, &Document::opened, &Document::analysisChanged);
    m_why.askAt(document.viewport(), &Viewport::cursorChanged);
    m_why.askAt(viewports, &PingViewports::placeChanged);
    m_why.ask();
}

void WhyPanel::buildTables()
{
    for (ColumnTable *table : {m_teeth, m_ladder}) {
        table->setSmall(20);
        table->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
        table->horizontalHeader()->setResizeContentsPrecision(200); // rows
        table->setTextElideMode(Qt::ElideNone);
        table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    }
    m_teeth->hide();
}

void WhyPanel::resizeEvent(QResizeEvent *event)
{
    constexpr int enoughForBoth = 400, enoughForAll = 560;
    m_plot->setVisible(height() >= (m_teeth->isHidden() ? enoughForBoth : enoughForAll));
    QWidget::resizeEvent(event);
}

WhyPanel::Asking::Question WhyPanel::question() const
{
    const auto at = cursorOf(m_document, m_viewports);
    if (!at || !m_document.plan())
        return tr("Click a cell to see why it was or was not detected.");
    const auto analysis = m_document.analysis() ? m_document.analysis() : m_document.inspectedUntil(at->seconds);
    if (!analysis)
        return tr("Other settings were in force there.");
    if (!std::holds_alternative<SmdSettings>(analysis->settings.detector))
        return tr("Only the sequential Markov detector decides along a path; choose it to see why.");
    return std::tuple(analysis, at->seconds, at->position);
}

void WhyPanel::showCure(const std::optional<Advice> &advice)
{
    m_cure->setVisible(advice.has_value());
    m_remedy->setVisible(advice.has_value());
    if (!advice)
        return;
    m_cure->setText(capitalised(QString::fromStdString(advice->sentence)) + QLatin1Char('.'));
    m_remedy->setText(capitalised(QString::fromStdString(advice->remedy)));
    m_remedy->setAccessibleName(m_remedy->text());
}

void WhyPanel::showTeeth(const std::vector<FamilyTooth> &teeth, const FamilySettings &family)
{
    constexpr int enoughRows = 3; ///< in a low panel, whose path is to be seen as well
    m_teeth->setHidden(teeth.empty());
    std::vector<std::vector<TableCell>> rows;
    const TableCell dash{QStringLiteral("–")};
    for (const FamilyTooth &tooth : teeth) {
        const double db = dbFromRatio(tooth.meanPower);
        rows.push_back({{toothText(family, tooth), double(rows.size())},
                        {numberText(tooth.hz, 2), tooth.hz},
                        tooth.meanPower > 0.0 ? TableCell{numberText(db, 1), db} : dash,
                        tooth.frames > 0 ? TableCell{signedText(tooth.evidence), tooth.evidence} : dash});
        for (TableCell &cell : rows.back())
            cell.isFaint = !tooth.isSeen();
    }
    m_teeth->show({{tr("Member")},
                   {tr("f (Hz)"), tr("Frequency of the member in this frame")},
                   {tr("y (dB)"), tr("Mean power over noise along the path; 0 dB is noise")},
                   {tr("Δλ (nat)"), tr("Evidence that the path would lose without this member; grey if none")}},
                  std::move(rows));
    const int height = m_teeth->horizontalHeader()->sizeHint().height() + m_teeth->verticalHeader()->length() + 2;
    m_teeth->setMinimumHeight(std::min(height, (enoughRows + 1) * m_teeth->verticalHeader()->defaultSectionSize() + 8));
    m_teeth->setMaximumHeight(height);
}

void WhyPanel::show()
{
    if (!m_why.answer()) {
        showCure({});
        m_ladder->clear();
        m_teeth->hide();
        return m_plot->setChart({});
    }
    const Analysis &analysis = *std::get<0>(m_why.answered());
    const auto &[explanation, teeth, advice] = *m_why.answer();
    showCure(advice);
    const Axis &time = analysis.time();
    const Grid &grid = analysis.grid();
    const StateSpace &space = spaceOf(explanation, analysis);
    const FamilySettings &family = analysis.settings.family;
    m_sentence->setText(teeth.empty()
                            ? whySentence(explanation, analysis)
                            : whySentence(explanation, analysis) + QLatin1Char(' ') + teethSentence(teeth, family));
    showTeeth(teeth, family);
    m_plot->setChart(chartOf(explanation, time));
    const ColumnTimes times(time.last(), time.step);
    const std::size_t count = std::min(explanation.steps.size(), longestLadder);
    std::vector<std::vector<TableCell>> rows(count);
    for (std::size_t row = 0; row < count; ++row) {
        const PathStep &step = explanation.steps[explanation.steps.size() - 1 - row];
        const double seconds = time.value(double(step.frame));
        rows[row] = {{times.text(seconds), seconds}};
        const std::vector<Index> cells = grid.coordinates(space.cellOf(step.state));
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const Axis &axis = grid.axes[i];
            const double unit = shownUnit(axis).hz, value = axis.value(double(cells[i])) / unit;
            rows[row].push_back({numberText(value, decimalsFor(axis.step / unit)), value});
        }
        rows[row].insert(rows[row].end(),
                         {{signedText(step.logLikelihoodRatio), step.logLikelihoodRatio},
                          {numberText(step.lnTransition, 2), step.lnTransition},
                          {signedText(step.lnK), step.lnK},
                          {numberText(step.score, 2), step.score},
                          std::isfinite(step.runnerUp) ? TableCell{numberText(-step.runnerUp, 2), -step.runnerUp}
                                                       : TableCell{QStringLiteral("–")}});
    }
    m_ladder->show(ladderHeadings(grid, times), std::move(rows));
}

} // namespace faintline
