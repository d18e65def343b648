#include "app/features/inspect/LawPanel.h"

#include "app/base/VisibilityWatcher.h"
#include "base/logmath.h"
#include "model/transitionLaw.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/LawPlot.h"

#include <QLabel>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// ln K that the run stood at: the middle of its frames.
    double usualLnK(const Analysis &analysis)
    {
        if (analysis.lnK.empty())
            return 0.0;
        std::vector<float> sorted = analysis.lnK;
        const auto middle = sorted.begin() + std::ssize(sorted) / 2;
        std::nth_element(sorted.begin(), middle, sorted.end());
        return double(*middle);
    }

    const StateSpace &turningSpace(const Analysis &analysis)
    {
        return analysis.modelAt(analysis.modelCount() - 1).space;
    }

    QString slopeTitle(const FrameKind &kind, int perBin)
    {
        const QString unit = perBin == 1 ? kind.cellsPerFrame
                                         : QStringLiteral("1/%1 %2").arg(QString::number(perBin), kind.cellPerFrame);
        return LawPanel::tr("Change of %1 (%2)").arg(kind.anyRate, unit);
    }

    QString perSecond(double rate, const QString &unit)
    {
        return unit == QLatin1String("Hz") ? rateText(rate) : QStringLiteral("%1 %2/s").arg(powerText(rate, 3), unit);
    }

} // namespace

LawPanel::LawPanel(const Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_plots(new QVBoxLayout), m_sentence(panelSentence()),
      m_sight(new VisibilityWatcher(*this))
{
    m_sentence->setContentsMargins(8, 2, 8, 4);
    m_sentence->setAccessibleName(tr("Interpretation of the law"));
    m_plots->setContentsMargins(0, 0, 0, 0);
    m_plots->setSpacing(2);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    layout->addLayout(m_plots, 1);
    layout->addWidget(m_sentence);
    connect(m_sight, &VisibilityWatcher::came, this, [this] {
        if (!m_isSaid)
            sayWhatItMeans();
    });
    connect(&document, &Document::analysisChanged, this, &LawPanel::show);
    connect(&document, &Document::settingsChanged, this, &LawPanel::show);
}

std::vector<LawPanel::Law> LawPanel::lawsOf(const Analysis &analysis) const
{
    const ModelSettings &model = m_document.settings().model;
    const FrameKind &kind = m_document.frameKind();
    const std::vector<Axis> &grid = analysis.grid().axes;
    const auto rates = int(grid.size());
    if (model.motion == Motion::Slopes)
        return {{QStringLiteral("model.slopeChange"), slopeTitle(kind, model.slopesPerBin), model.slopeChange,
                 analysis.model.space.axes().front().rateCount - 1, rates}};
    if (rates == 1)
        return {};
    if (model.motion == Motion::NonManoeuvring)
        return {
            {{}, tr("Rates do not change from %1 to %1 (%2)").arg(kind.frame, kind.cellsPerFrame), {1.0}, 0, rates}};
    const std::vector<KinematicAxis> &axes = turningSpace(analysis).axes();
    const auto title = [&](const QString &rate) { return tr("Change of %1 (%2)").arg(rate, kind.cellsPerFrame); };
    return {{QStringLiteral("model.rangeRateChange"), title(kind.rateName(grid[0])), model.rangeRateChange,
             axes[0].rateCount - 1, 1},
            {QStringLiteral("model.bearingRateChange"), title(kind.rateName(grid[1])), model.bearingRateChange,
             axes[1].rateCount - 1, 1}};
}

void LawPanel::show()
{
    const auto &analysis = m_document.analysis();
    if (!analysis || analysis->model.space.axes().empty() || !analysis->grid().fits(analysis->model.space.axes()))
        return;
    std::vector<Law> laws = lawsOf(*analysis);
    while (m_laws.size() > laws.size()) {
        delete m_laws.back().plot;
        m_laws.pop_back();
    }
    for (std::size_t i = 0; i < laws.size(); ++i) {
        Law &law = laws[i];
        law.plot = i < m_laws.size() ? m_laws[i].plot : nullptr;
        if (!law.plot) {
            law.plot = new LawPlot;
            m_plots->addWidget(law.plot, 1);
            connect(law.plot, &LawPlot::lawDragged, this, [this] {
                m_sentence->setFixedHeight(
                    m_sentence->height()); // a change of text must not move the bar away from the pointer
                sayWhatItMeans();
            });
            connect(law.plot, &LawPlot::lawRequested, this, [this, i](const std::vector<double> &values) {
                emit lawRequested(m_laws[i].field, values);
                show(); // if there is no result, the previous state
            });
        }
        law.plot->setTitles(law.title, tr("h"));
        law.plot->setAccessibleName(law.title);
        law.plot->setEditable(!law.field.isEmpty());
        law.plot->setToolTip(law.field.isEmpty() ? QString()
                                                 : tr("Law of the rate changes. Drag a bar, or select one with ← → and "
                                                      "change it with ↑ ↓; the sum stays 1. Each change is one undo "
                                                      "step."));
        law.plot->setLaw(law.values, law.mostChange);
    }
    m_laws = std::move(laws);
    m_sentence->setMinimumHeight(0);
    m_sentence->setMaximumHeight(QWIDGETSIZE_MAX);
    sayWhatItMeans();
}

QString LawPanel::driftWords(const Analysis &analysis) const
{
    QStringList drifts;
    const StateSpace &space = turningSpace(analysis);
    const QString &cells = m_document.frameKind().cellsPerFrame;
    for (std::size_t i = 0; i < space.axes().size(); ++i) {
        const KinematicAxis &moving = space.axes()[i];
        const Axis &axis = analysis.grid().axes[i];
        const double unit = axis.step / analysis.time().step;
        const double lowest = moving.rate(0);
        const double highest = moving.rate(moving.rateCount - 1);
        const QString name = labelText(axis.unit, mostUnitLetters);
        const QString words = lowest == -highest
                                  ? tr("±%1 (±%2 %3)").arg(perSecond(highest * unit, name)).arg(highest).arg(cells)
                                  : tr("%1 … %2 (%3 … %4 %5)")
                                        .arg(perSecond(lowest * unit, name), perSecond(highest * unit, name))
                                        .arg(lowest)
                                        .arg(highest)
                                        .arg(cells);
        drifts << (space.axes().size() > 1 ? labelText(axis.name, mostUnitLetters) + QLatin1Char(' ') + words : words);
    }
    return tr("Largest drift: %1.").arg(drifts.join(QStringLiteral(", ")));
}

QString LawPanel::snrWords(const Analysis &analysis) const
{
    if (!std::holds_alternative<SmdSettings>(m_document.settings().detector))
        return tr("SNR limits are given for the sequential Markov detector only.");
    if (analysis.isBank())
        return tr("Each of the parallel models has its own ln K.");
    double kept = 0.0;
    double changing = 0.0;
    for (const Law &law : m_laws) {
        const std::vector<double> &values = law.plot->law();
        kept -= law.axes * std::log(values.front());
        changing += law.axes * damping(values).mean;
    }
    const double lnK = usualLnK(analysis);
    const auto words = [&](double loss) {
        const double snr = lowestIntegratedSnr(analysis.model.likelihood, loss * analysis.model.transitionScale - lnK);
        if (snr <= 0.0)
            return tr("any SNR, even noise");
        if (!std::isfinite(snr))
            return tr("no SNR");
        return tr("%1 dB").arg(numberText(dbFromRatio(snr), 1));
    };
    return tr("At ln K = %1, evidence accumulates above these SNRs in one frame: %2 for %3 at a constant rate, %4 if "
              "the rate changes as the law says. Below them a single path loses evidence on average; neighbouring "
              "paths help a little.")
        .arg(numberText(lnK, 2), words(kept), m_document.frameKind().signal, words(changing));
}

/// Takes tens of milliseconds, so only while the panel is visible.
void LawPanel::sayWhatItMeans()
{
    m_isSaid = m_sight->isOn();
    if (!m_isSaid)
        return;
    const auto &analysis = m_document.analysis();
    if (!analysis || m_laws.empty() || !m_laws.front().plot)
        return m_sentence->clear();
    QStringList costs;
    for (const Law &law : m_laws) {
        const LawDamping cost = damping(law.plot->law());
        costs << tr("%1 nat for the likeliest change, %2 for the least likely, %3 on average")
                     .arg(numberText(cost.likeliest, 2), numberText(cost.unlikeliest, 2), numberText(cost.mean, 2));
    }
    if (m_laws.size() == 2)
        costs = {tr("in range %1; in bearing %2").arg(costs[0], costs[1])};
    const QStringList words{driftWords(*analysis), tr("A step costs %1.").arg(costs.front()), snrWords(*analysis)};
    m_sentence->setText(words.join(QLatin1Char(' ')));
}

} // namespace faintline
