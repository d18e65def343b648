#include "app/panels/LawPanel.h"

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

    QString perSecond(double rate, const QString &unit)
    {
        return unit == QLatin1String("Hz") ? rateText(rate) : QStringLiteral("%1 %2/s").arg(powerText(rate, 3), unit);
    }

} // namespace

LawPanel::LawPanel(const Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_plots(new QVBoxLayout), m_sentence(new QLabel),
      m_sight(new VisibilityWatcher(*this))
{
    m_sentence->setWordWrap(true);
    m_sentence->setTextFormat(Qt::PlainText);
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

QString LawPanel::sentence() const
{
    return m_sentence->text();
}

std::vector<LawPanel::Law> LawPanel::lawsOf(const Analysis &analysis) const
{
    const ModelSettings &model = m_document.settings().model;
    const auto frame = m_document.hasPings() ? tr("ping") : tr("frame");
    const auto sloped = [&](int perBin) {
        if (m_document.hasPings())
            return perBin == 1 ? tr("Change of either rate from ping to ping (cells/ping)")
                               : tr("Change of either rate from ping to ping (1/%1 cell/ping)").arg(perBin);
        return perBin == 1 ? tr("Change of slope from frame to frame (bins/frame)")
                           : tr("Change of slope from frame to frame (1/%1 bin/frame)").arg(perBin);
    };
    if (model.motion == Motion::Slopes) {
        std::vector<std::size_t> axes;
        for (std::size_t axis = 0; axis < analysis.grid().axes.size(); ++axis)
            axes.push_back(axis);
        return {{QStringLiteral("model.slopeChange"), sloped(model.slopesPerBin), model.slopeChange,
                 analysis.model.space.axes().front().rateCount - 1, axes}};
    }
    if (analysis.grid().axes.size() != 2)
        return {};
    if (model.motion == Motion::NonManoeuvring)
        return {{{}, tr("Rates do not change from ping to ping (cells/ping)"), {1.0}, 0, {0, 1}}};
    const std::vector<KinematicAxis> &axes = turningSpace(analysis).axes();
    return {{QStringLiteral("model.rangeRateChange"),
             tr("Change of range rate per %1 (cells/%1)").arg(frame),
             model.rangeRateChange,
             axes[0].rateCount - 1,
             {0}},
            {QStringLiteral("model.bearingRateChange"),
             tr("Change of bearing rate per %1 (cells/%1)").arg(frame),
             model.bearingRateChange,
             axes[1].rateCount - 1,
             {1}}};
}

void LawPanel::show()
{
    const auto &analysis = m_document.analysis();
    if (!analysis || analysis->model.space.axes().empty()
        || analysis->model.space.axes().size() != analysis->grid().axes.size())
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
                    m_sentence->height()); // other words must not move the bar from under the pointer
                sayWhatItMeans();
            });
            connect(law.plot, &LawPlot::lawRequested, this, [this, i](const std::vector<double> &values) {
                emit lawRequested(m_laws[i].field, values);
                show(); // where nothing came of it, as it was
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
    const std::vector<KinematicAxis> &axes = turningSpace(analysis).axes();
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const Axis &axis = analysis.grid().axes[i];
        const double unit = axis.step / analysis.time().step;
        const double lowest = axes[i].rate(0);
        const double highest = axes[i].rate(axes[i].rateCount - 1);
        const QString name = labelText(axis.unit, mostUnitLetters);
        const QString cells = m_document.hasPings() ? tr("cells/ping") : tr("bins/frame");
        const QString words = lowest == -highest
                                  ? tr("±%1 (±%2 %3)").arg(perSecond(highest * unit, name)).arg(highest).arg(cells)
                                  : tr("%1 … %2 (%3 … %4 %5)")
                                        .arg(perSecond(lowest * unit, name), perSecond(highest * unit, name))
                                        .arg(lowest)
                                        .arg(highest)
                                        .arg(cells);
        drifts << (axes.size() > 1 ? labelText(axis.name, mostUnitLetters) + QLatin1Char(' ') + words : words);
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
        const auto times = double(law.axes.size());
        kept -= times * std::log(values.front());
        changing += times * damping(values).mean;
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
    const QString lines = m_document.hasPings() ? tr("a target") : tr("a line");
    return tr("At ln K = %1, evidence accumulates above these SNRs in one frame: %2 for %3 at a constant rate, %4 if "
              "the rate changes as the law says. Below them a single path loses evidence on average; neighbouring "
              "paths help a little.")
        .arg(numberText(lnK, 2), words(kept), lines, words(changing));
}

/// Takes tens of milliseconds: of a panel in sight only.
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
