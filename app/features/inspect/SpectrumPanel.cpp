#include "app/features/inspect/SpectrumPanel.h"

#include "app/document/Document.h"
#include "widgets/base/familyWords.h"
#include "widgets/plot/ChartPlot.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr std::size_t plottedPoints = 3000;

    /// A curve in dB; with more values than can be drawn, the maximum of each group.
    Curve curveOf(const std::string &name, const std::vector<double> &hz, const std::vector<double> &values,
                  const Span &band, double addedDb)
    {
        const auto first = std::lower_bound(hz.begin(), hz.end(), band.low) - hz.begin();
        const auto end = std::upper_bound(hz.begin(), hz.end(), band.high) - hz.begin();
        const auto step = std::max<std::ptrdiff_t>(1, (end - first) / std::ptrdiff_t(plottedPoints));
        Curve curve{name, Curve::Kind::Measured, {}};
        for (std::ptrdiff_t i = first; i < end; i += step) {
            const auto largest =
                std::max_element(values.begin() + i, values.begin() + std::min(i + step, end)) - values.begin();
            if (const double value = values[std::size_t(largest)]; value > 0.0)
                curve.points.push_back({hz[std::size_t(largest)], 10.0 * std::log10(value) + addedDb, {}});
        }
        return curve;
    }

} // namespace

SpectrumPanel::SpectrumPanel(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_level(new QComboBox), m_calibration(new QDoubleSpinBox),
      m_plot(new ChartPlot), m_spectra(
                                 this, &SpectrumPanel::question,
                                 [](const auto &analysis, double seconds, const Span &visible, SpectrumQuantity level,
                                    const RunContext &context) {
                                     return spectraOf(*analysis, seconds, {visible.low, visible.high}, level, context);
                                 },
                                 &SpectrumPanel::show)
{
    m_level->addItems({tr("dB over noise"), tr("dB re full scale²/Hz")});
    m_level->setAccessibleName(tr("Level of the spectrum"));
    m_calibration->setRange(-300.0, 300.0);
    m_calibration->setDecimals(1);
    m_calibration->setPrefix(tr("calibration "));
    m_calibration->setSuffix(tr(" dB"));
    m_calibration->setAccessibleName(tr("Calibration of the level"));
    m_calibration->setToolTip(
        tr("Level that a full-scale sample represents, in dB re the sensor's unit; added to the spectrum"));
    m_plot->setEmptySentence(tr("The spectrum at the cursor and the mean of the visible part appear here."));
    auto *top = new QHBoxLayout;
    top->setContentsMargins(8, 4, 8, 2);
    top->addWidget(m_level);
    top->addWidget(m_calibration);
    top->addStretch(1);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(top);
    layout->addWidget(m_plot, 1);

    connect(m_level, &QComboBox::activated, this, &SpectrumPanel::follow);
    connect(m_calibration, &QDoubleSpinBox::valueChanged, this, &SpectrumPanel::show);
    connect(&document, &Document::opened, this, &SpectrumPanel::follow);
    connect(&document, &Document::analysisChanged, this, &SpectrumPanel::follow);
    connect(&document.viewport(), &Viewport::scaleChanged, this, &SpectrumPanel::show);
    m_spectra.watch(*this);
    m_spectra.askAt(document.viewport(), &Viewport::cursorChanged, &Viewport::spanChanged, &Viewport::followingChanged);
    follow();
}

SpectrumQuantity SpectrumPanel::chosenLevel() const
{
    return m_level->currentIndex() == 0 ? SpectrumQuantity::OverNoise : SpectrumQuantity::Density;
}

void SpectrumPanel::follow()
{
    m_level->setEnabled(!m_document.isEmpty() && m_document.recording());
    m_calibration->setVisible(chosenLevel() == SpectrumQuantity::Density);
    m_spectra.ask();
}

SpectrumPanel::Asking::Question SpectrumPanel::question() const
{
    if (m_document.viewport().isFollowing())
        return {}; // a picture that moves is read when it is held
    const Span visible = m_document.viewport().time();
    const auto analysis = m_document.inspectedUntil(visible.high);
    if (!analysis)
        return m_document.live().isEmpty() ? QString() : Asking::Question();
    const auto &cursor = m_document.viewport().cursor();
    return std::tuple(analysis, cursor ? cursor->seconds : visible.middle(), visible,
                      m_document.recording() ? chosenLevel() : SpectrumQuantity::OverNoise);
}

void SpectrumPanel::show()
{
    const Spectra *spectra = m_spectra.answer();
    if (!spectra)
        return m_plot->setChart({});
    const bool isDensity = chosenLevel() == SpectrumQuantity::Density && m_document.recording();
    const double added = isDensity ? m_calibration->value() : 0.0;
    const Span band = this->band();
    Chart chart{"Spectrum",
                "Frequency (Hz)",
                isDensity ? (added == 0.0 ? "Level (dB re full scale²/Hz)" : "Level (dB, calibrated, in 1 Hz)")
                          : "Level (dB over noise)",
                m_document.viewport().isLogarithmic(),
                false,
                {}};
    const auto analysis = m_document.lineAnalysis();
    const std::string rest = analysis && analysis->unsubtracted ? ", strong lines subtracted" : "";
    chart.curves.push_back(curveOf("at the cursor" + rest, spectra->position, spectra->frame, band, added));
    chart.curves.push_back(curveOf("mean of the visible part" + rest, spectra->position, spectra->mean, band, added));
    m_plot->setChart(chart);
    markTeeth();
}

/// What is visible, and of a family, all that its members reach from there.
Span SpectrumPanel::band() const
{
    const Span &visible = m_document.viewport().frequency();
    const auto analysis = m_document.lineAnalysis();
    if (!analysis || analysis->settings.family.isNone())
        return visible;
    const std::vector<double> lowest = memberFrequencies(analysis->settings.family, visible.low);
    const std::vector<double> highest = memberFrequencies(analysis->settings.family, visible.high);
    return {*std::min_element(lowest.begin(), lowest.end()), *std::max_element(highest.begin(), highest.end())};
}

void SpectrumPanel::markTeeth()
{
    const auto analysis = m_document.lineAnalysis();
    const auto &cursor = m_document.viewport().cursor();
    std::vector<ChartMark> marks;
    if (analysis && cursor && !analysis->settings.family.isNone()) {
        const FamilySettings &family = analysis->settings.family;
        const std::vector<double> hz = memberFrequencies(family, cursor->hz);
        for (std::size_t k = 0; k < hz.size(); ++k)
            marks.push_back({hz[k], memberText(family, family.members[k])});
        std::sort(marks.begin(), marks.end(), [](const ChartMark &a, const ChartMark &b) { return a.x < b.x; });
    }
    m_plot->setMarks(std::move(marks));
}

} // namespace faintline
