#include "app/features/inspect/NoiseFitPanel.h"

#include "app/document/Document.h"
#include "plan/Calibration.h"
#include "widgets/base/axisWords.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/table/ColumnTable.h"

#include <QHeaderView>
#include <QLabel>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr int bandCount = 6;
    constexpr double rarest = 1e-4; ///< beyond it a ratio would be based on a handful of cells
    constexpr std::int64_t mostCells = 20'000'000;
    constexpr double fewest = 10.0; ///< least number of values beyond a plotted quantile

    QString bandNumbers(const FittedBand &band, const FrequencyUnit &unit)
    {
        const int decimals = decimalsFor((band.high - band.low) / unit.hz / 10.0);
        return QObject::tr("%1 … %2").arg(numberText(band.low / unit.hz, decimals),
                                          numberText(band.high / unit.hz, decimals));
    }

    QString bandText(const FittedBand &band, const Axis &axis)
    {
        const FrequencyUnit unit =
            axis.unit == "Hz" ? frequencyUnit(std::max(std::abs(band.low), std::abs(band.high))) : shownUnit(axis);
        return bandNumbers(band, unit) + QLatin1Char(' ') + unit.name;
    }

    /// Bins at 0 Hz and at half the rate which are no noise of that law, and are kept from the detector.
    Index blindCells(const Analysis &analysis)
    {
        const SelectionSettings &selection = analysis.settings.selection;
        if (!analysis.recording || analysis.recording->info().isComplex || !isWholeBand(selection))
            return 0;
        const std::vector<double> &cells = analysis.settings.decide.inhibitCells;
        const double half = cells.empty() ? 0.0 : cells.back();
        return Index(std::ceil(half * frameGeometry(analysis.settings.spectrogram).binsPerCell)) + 1;
    }

    Chart chartOf(const std::vector<FittedBand> &bands, const Axis &axis)
    {
        Chart chart{"Normalised noise against its law", "quantile of the law e^(-y)", "measured y", false, false, {}};
        double longest = 1.0;
        for (const FittedBand &band : bands) {
            Curve curve{bandText(band, axis).toStdString(), Curve::Kind::Measured, {}};
            for (double x = 0.5; double(band.law.count()) * std::exp(-x) >= fewest; x += 0.5) {
                curve.points.push_back({x, band.law.quantile(std::exp(-x)), {}});
                longest = std::max(longest, x);
            }
            chart.curves.push_back(std::move(curve));
        }
        chart.curves.push_back({"the law", Curve::Kind::Theory, {{0.0, 0.0, {}}, {longest, longest, {}}}});
        return chart;
    }

    constexpr int leastChart = 190; ///< pixels
    constexpr int leastTable = 90;
    constexpr double notable = 3.0; ///< multiple of a Pfa

    /// Noise a little too strong adds up faster than resets take away; a ratio would only tell how small the Pfa was.
    bool growsWithoutEnd(const MisfitPfa &pfa)
    {
        return pfa.actual > 0.1;
    }

    QString pfaText(const MisfitPfa &pfa)
    {
        return growsWithoutEnd(pfa) ? NoiseFitPanel::tr("grows") : QStringLiteral("× ") + powerText(pfa.ratio(), 3);
    }

    std::vector<TableHeading> bandHeadings(const QString &unit)
    {
        return {{NoiseFitPanel::tr("Band (%1)").arg(unit), {}, Qt::AlignLeft},
                {NoiseFitPanel::tr("Mean")},
                {NoiseFitPanel::tr("KS (10⁻³)"),
                 NoiseFitPanel::tr("Kolmogorov–Smirnov distance to e^(-y), and its 95 % limit for the number of "
                                   "independent values, in thousandths")},
                {NoiseFitPanel::tr("Pfa"),
                 NoiseFitPanel::tr("Ratio of the false-alarm probabilities per cell of this band's noise and of noise "
                                   "of the law itself, at the current threshold, or at 10⁻⁴ if that probability is too "
                                   "small to be estimated")}};
    }

} // namespace

NoiseFitPanel::NoiseFitPanel(const Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_sentence(panelSentence()), m_plot(new ChartPlot),
      m_table(new ColumnTable(tr("Fit of the noise, band by band"))),
      m_fit(
          this,
          [this] {
              return m_fit.questionIf(bool(m_document.analysis()), tr("Open a recording to measure its noise."),
                                      m_document.analysis());
          },
          measure, &NoiseFitPanel::show)
{
    m_sentence->setContentsMargins(8, 6, 8, 4);
    m_plot->setEmptySentence(tr("Quantiles of the noise appear here."));
    m_table->show(bandHeadings(QStringLiteral("Hz")));
    m_table->setSmall();
    m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    auto *splitter = new QSplitter(Qt::Vertical);
    splitter->addWidget(m_plot);
    splitter->addWidget(m_table);
    splitter->setSizes({260, 170});
    splitter->setChildrenCollapsible(false);
    m_plot->setMinimumHeight(leastChart);
    m_table->setMinimumHeight(leastTable);
    auto *content = new QWidget;
    auto *layout = new QVBoxLayout(content);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_sentence);
    layout->addWidget(splitter, 1);
    setScrolledColumn(*this, content);

    m_fit.watch(*this, m_sentence);
    m_fit.askAt(document, &Document::opened, &Document::analysisChanged);
    m_fit.ask();
}

NoiseFitPanel::Fit NoiseFitPanel::measure(const std::shared_ptr<const Analysis> &analysis, const RunContext &context)
{
    Fit fit{analysis, {}, {}};
    const FrameGeometry geometry =
        analysis->recording ? faintline::frameGeometry(analysis->settings.spectrogram) : FrameGeometry();
    fit.bands =
        fitNoise(*analysis->frames, {bandCount, mostCells, blindCells(*analysis)}, geometry, context.part(0.0, 0.4));
    if (analysis->settings.model.motion == Motion::Slopes) // a sonar's targets move on two axes, these cells lie on one
        fit.pfa = misfitPfa(fit.bands, analysis->settings,
                            std::max(rarest, analysis->calibration->exceedanceAt(analysis->threshold)),
                            context.part(0.4, 1.0));
    return fit;
}

void NoiseFitPanel::show()
{
    if (!m_fit.answer()) {
        m_plot->setChart({});
        return m_table->clear();
    }
    const Fit &fit = *m_fit.answer();
    const Axis &axis = fit.analysis->grid().axes.back();
    m_plot->setChart(chartOf(fit.bands, axis));
    const FrequencyUnit unit = shownUnit(axis);
    std::vector<std::vector<TableCell>> rows;
    for (std::size_t i = 0; i < fit.bands.size(); ++i) {
        const FittedBand &band = fit.bands[i];
        const double distance = band.law.distance();
        rows.push_back(
            {{bandNumbers(band, unit), band.low},
             {numberText(band.law.mean(), 3), band.law.mean()},
             {tr("%1 %2 %3")
                  .arg(numberText(1e3 * distance, 1), band.fits() ? QStringLiteral("≤") : QStringLiteral(">"),
                       numberText(1e3 * NoiseLaw::distanceLimit(band.independent), 1)),
              distance},
             fit.pfa.empty() ? TableCell{QStringLiteral("–")} : TableCell{pfaText(fit.pfa[i]), fit.pfa[i].ratio()}});
    }
    m_table->show(bandHeadings(unit.name), std::move(rows));
    say(fit);
}

void NoiseFitPanel::say(const Fit &fit)
{
    const auto misfits =
        std::count_if(fit.bands.begin(), fit.bands.end(), [](const FittedBand &band) { return !band.fits(); });
    if (fit.pfa.empty())
        return m_sentence->setText((misfits == 0 ? tr("All bands follow the law.")
                                                 : tr("%1 of %2 bands depart from the law; targets in a band also "
                                                      "cause this.")
                                                       .arg(misfits)
                                                       .arg(fit.bands.size()))
                                   + QLatin1Char(' ')
                                   + tr("The effect of misfits on Pfa is computed for slope sets "
                                        "only."));
    const auto worst = std::max_element(fit.pfa.begin(), fit.pfa.end(),
                                        [](const MisfitPfa &a, const MisfitPfa &b) { return a.ratio() < b.ratio(); });
    const QString band = bandText(fit.bands[std::size_t(worst - fit.pfa.begin())], fit.analysis->grid().axes.back());
    const bool isHarmless = misfits == 0 && worst->ratio() < notable;
    const QString law = misfits > 0 ? tr("%1 of %2 bands depart from the law; lines in a band also cause this.")
                                          .arg(misfits)
                                          .arg(fit.bands.size())
                        : isHarmless ? tr("All bands follow the law.")
                                     : tr("All bands follow the law except in their tails, which include any lines.");
    const QString ratio = powerText(worst->ratio(), 3);
    const QString nominal = powerText(worst->nominal);
    QString alarms =
        tr("If %1 were noise only, it would give %2 times the nominal Pfa of %3 per cell.").arg(band, ratio, nominal);
    if (growsWithoutEnd(*worst))
        alarms = tr("If %1 were noise only, D would grow without bound and nearly every cell would exceed the "
                    "threshold.")
                     .arg(band);
    else if (isHarmless)
        alarms =
            tr("At a nominal Pfa of %1 per cell, the bands give at most %2 times that (%3).").arg(nominal, ratio, band);
    m_sentence->setText(law + QLatin1Char(' ') + alarms);
}

} // namespace faintline
