#include "app/features/evaluate/EvaluatePanel.h"

#include "app/base/StartColumn.h"
#include "app/document/Document.h"
#include "app/features/evaluate/ExperimentForm.h"
#include "app/features/evaluate/showEntry.h"
#include "evaluate/experiments/campaignCharts.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/ChartPlot.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QTabWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// Why curves that seem to be the same are not; empty if there is nothing to explain. `measured`: without the curve
    /// of the operating point.
    QString explanationOf(const Chart &measured, bool hasOperatingPoint)
    {
        QStringList sentences;
        if (std::ranges::count(measured.curves, Curve::Kind::Theory, &Curve::kind) > 0)
            sentences << EvaluatePanel::tr("Theory counts as many independent means in a block as lines fit into it. "
                                           "The sliding mean has more, so "
                                           "the measured curve lies below theory, by up to about 1 dB.");
        if (hasOperatingPoint)
            sentences << EvaluatePanel::tr(
                "“T = …” is the threshold of this window; the other curves of Pd against SNR "
                "are at the threshold of 1 false alarm per block.");
        return sentences.isEmpty() ? QString() : asHtml(sentences.join(QStringLiteral(" ")));
    }

} // namespace

EvaluatePanel::EvaluatePanel(const Document &document, Experiments &experiments, QWidget *parent)
    : Panel(parent), m_document(document), m_experiments(experiments), m_form(new ExperimentForm),
      m_column(new StartColumn(m_form, tr("Progress of the experiment"), tr("Run this experiment in the background"))),
      m_tabs(new QTabWidget), m_pd(new ChartPlot), m_roc(new ChartPlot), m_snr(new QComboBox)
{
    auto *rocPage = new QWidget;
    auto *rocTop = new QHBoxLayout;
    rocTop->setContentsMargins(8, 4, 8, 0);
    rocTop->addWidget(new QLabel(tr("at")));
    rocTop->addWidget(m_snr);
    rocTop->addStretch(1);
    m_snr->setAccessibleName(tr("SNR of the ROC curves"));
    auto *rocLayout = new QVBoxLayout(rocPage);
    rocLayout->setContentsMargins(0, 0, 0, 0);
    rocLayout->setSpacing(0);
    rocLayout->addLayout(rocTop);
    rocLayout->addWidget(m_roc, 1);
    m_tabs->addTab(m_pd, tr("Pd against SNR"));
    m_tabs->addTab(rocPage, tr("ROC"));
    m_tabs->setDocumentMode(true);
    m_pd->setInvitation(tr("click it to see one of its trials"));
    sayWhyEmpty(false);

    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_column);
    layout->addWidget(m_tabs, 1);

    connect(m_column, &StartColumn::startRequested, this, &EvaluatePanel::start);
    connect(m_column, &StartColumn::cancelRequested, this, &EvaluatePanel::cancel);
    connect(m_form, &ExperimentForm::changed, this, &EvaluatePanel::followForm);
    connect(m_snr, &QComboBox::activated, this, [this] {
        if (const Experiments::Entry *entry = m_experiments.entry(m_shown))
            showRoc(*entry);
    });
    connect(m_tabs, &QTabWidget::currentChanged, this, [this] {
        if (const Experiments::Entry *entry = m_experiments.entry(m_shown))
            showRoc(*entry);
    });
    connect(m_pd, &ChartPlot::pointActivated, this, [this](std::size_t curve, std::size_t point) {
        if (const Experiments::Entry *entry = m_experiments.entry(m_shown); entry && entry->campaign)
            emit trialRequested(m_shown, curve, point);
    });
    connect(&experiments, &Experiments::changed, this, &EvaluatePanel::follow);
    connect(&experiments, &Experiments::removed, this, [this](int id) {
        if (id == m_shown)
            show(0);
    });
    connect(&document, &Document::shownThresholdChanged, this, [this] {
        if (const Experiments::Entry *entry = m_experiments.entry(m_shown); entry && entry->campaign && isVisible())
            showOperatingPoint(*entry);
    });
    connect(&document, &Document::analysisChanged, this, &EvaluatePanel::followDocument);
    connect(&document, &Document::opened, this, &EvaluatePanel::followDocument);
    connect(&document, &Document::settingsChanged, this, &EvaluatePanel::followDocument);
    followForm();
}

void EvaluatePanel::followDocument()
{
    double windowSeconds = 0.0;
    double recordingSeconds = 0.0;
    if (const auto &analysis = m_document.analysis(); analysis && analysis->recording) {
        windowSeconds = analysis->frames->geometry().windowSeconds;
        recordingSeconds = double(analysis->time().count) * analysis->time().step;
    }
    m_form->setCurrent(m_document.usedSettings(), windowSeconds, recordingSeconds);
}

void EvaluatePanel::followForm()
{
    m_column->setStartable(m_form->obstacle().isEmpty());
    if (const Experiments::Entry *entry = m_experiments.entry(m_shown))
        showEntry(*m_column, *entry, ofForm());
}

/// The experiment that the form would start.
Experiment EvaluatePanel::ofForm() const
{
    return m_form->experiment(m_document.sourcePath());
}

void EvaluatePanel::start()
{
    if (const QString why = m_form->obstacle(); !why.isEmpty())
        return emit failed(Error("experiment", why.toStdString()));
    const bool isInRecording = m_form->isInRecording();
    if (isInRecording && !m_document.recording())
        return emit failed(Error("experiment", "needs an open recording to which lines can be added"));
    const QString name = isInRecording ? tr("In %1: %2").arg(m_document.sourceName(), m_form->name()) : m_form->name();
    show(m_experiments.start(name, ofForm(), isInRecording ? m_document.recording() : nullptr));
}

void EvaluatePanel::cancel()
{
    m_experiments.cancel(m_shown);
}

void EvaluatePanel::show(int id)
{
    m_shown = id;
    if (const Experiments::Entry *entry = m_experiments.entry(id)) {
        fillSnrs(*entry);
        if (entry->campaign && ofForm() != entry->campaign->experiment)
            m_form->setExperiment(entry->campaign->experiment);
        return follow(id);
    }
    m_pd->setChart({});
    m_roc->setChart({});
    sayWhyEmpty(false);
    m_column->clearState();
}

void EvaluatePanel::follow(int id)
{
    const Experiments::Entry *entry = m_experiments.entry(id);
    if (id != m_shown || !entry)
        return;
    showEntry(*m_column, *entry, ofForm());
    sayWhyEmpty(entry->isOpen());
    showPd(*entry);
    showRoc(*entry);
}

void EvaluatePanel::sayWhyEmpty(bool isComputing)
{
    for (ChartPlot *plot : {m_pd, m_roc})
        plot->setEmptySentence(isComputing ? tr("The curves are being computed.")
                                           : tr("Choose lines and detectors, then press Start to plot the curves."));
}

void EvaluatePanel::fillSnrs(const Experiments::Entry &entry)
{
    m_snr->clear();
    if (!entry.campaign)
        return;
    const std::vector<double> snrs = entry.campaign->experiment.snrDb;
    for (const double db : snrs)
        m_snr->addItem(tr("%1 dB").arg(numberText(db, db == std::floor(db) ? 0 : 1)));
    m_snr->setCurrentIndex(int(snrs.size() / 2));
}

void EvaluatePanel::showPd(const Experiments::Entry &entry)
{
    m_pd->setInvitation(entry.campaign ? tr("click it to see one of its trials") : QString());
    m_pdChart = entry.imported
                    ? Chart{"Detection probability", "SNR (dB)", "Pd", false, false, curvesOf(*entry.imported)}
                : entry.campaign ? pdChart(*entry.campaign)
                                 : Chart();
    showOperatingPoint(entry);
}

/// Follows the threshold while it is dragged, on existing curves.
void EvaluatePanel::showOperatingPoint(const Experiments::Entry &entry)
{
    const auto shown = [](Chart chart, const std::optional<Curve> &extra) {
        if (extra)
            chart.curves.push_back(*extra);
        return chart;
    };
    const bool hasThreshold = entry.campaign && m_document.analysis();
    const AnalysisSettings &settings = m_document.settings();
    const double threshold = m_document.shownThreshold();
    const auto atThreshold = hasThreshold ? pdAtOperatingPoint(*entry.campaign, settings, threshold) : std::nullopt;
    m_pd->setChart(shown(m_pdChart, atThreshold));
    m_pd->setToolTip(explanationOf(m_pdChart, atThreshold.has_value()));
    if (m_tabs->currentIndex() != 1 || m_snr->currentIndex() < 0)
        return;
    const auto point = hasThreshold ? operatingPoint(*entry.campaign, shownSnr(), settings, threshold) : std::nullopt;
    m_roc->setChart(shown(m_rocChart, point));
    m_roc->setToolTip(explanationOf(m_rocChart, point.has_value()));
}

std::size_t EvaluatePanel::shownSnr() const
{
    return std::size_t(std::max(m_snr->currentIndex(), 0));
}

/// Only while visible: it costs more than Pd.
void EvaluatePanel::showRoc(const Experiments::Entry &entry)
{
    if (m_tabs->currentIndex() != 1)
        return;
    m_rocChart = entry.campaign && m_snr->currentIndex() >= 0 ? rocChart(*entry.campaign, shownSnr()) : Chart();
    m_roc->setChart(m_rocChart);
    showOperatingPoint(entry);
}

} // namespace faintline
