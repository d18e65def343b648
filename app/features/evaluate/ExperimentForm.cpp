#include "app/features/evaluate/ExperimentForm.h"

#include "base/Error.h"
#include "base/json.h"
#include "base/numberText.h"
#include "evaluate/experiments/peers.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QStackedWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    constexpr std::size_t currentDetectors = 2; ///< with the current settings: the detector alone, and all of `detect`

    /// Frames of a block and signals that fit: Billon's geometry, made longer for longer lines.
    void fitBlocks(Experiment &lines)
    {
        if (lines.signalFrames() <= lines.blockFrames)
            return;
        const int needed = int(std::ceil((lines.durationSeconds + 50.0) * lines.stepsPerWindow));
        lines.blockFrames = needed;
        lines.frames = needed * 3 + needed / 2;
    }

    /// Before an experiment is opened.
    Experiment initial(Experiment::Kind kind)
    {
        Experiment experiment = Experiment::of(kind);
        experiment.trials = 20;
        experiment.snrDb = {-5.0, -4.0, -3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0};
        return experiment;
    }

    FieldForm<Experiment> *formOf(Experiment::Kind kind, std::initializer_list<std::string_view> mainFields)
    {
        return new FieldForm<Experiment>(ExperimentForm::tr("Lines"),
                                         withMainFields(Experiment::fields(kind), mainFields), initial(kind));
    }

} // namespace

ExperimentForm::ExperimentForm(QWidget *parent)
    : QWidget(parent), m_noise(new QComboBox), m_forms(new QStackedWidget),
      m_lines(formOf(Experiment::Kind::Lines, {"snrDb", "durationWindows", "driftCellsPerWindow", "wanderCells",
                                               "wanderWindows", "runs", "seed"})),
      m_injection(formOf(Experiment::Kind::Injection, {"snrDb", "durationSeconds", "driftHzPerSecond", "wanderHz",
                                                       "wanderSeconds", "trials", "seed", "falseAlarmsPerHour"})),
      m_grid(new QGridLayout), m_meaning(plainLabel())
{
    m_noise->addItem(tr("In simulated noise"));
    m_noise->addItem(tr("In this recording"));
    m_noise->setAccessibleName(tr("Noise to which the lines are added"));
    m_noise->setToolTip(
        tr("White noise as in Billon 2005, or the open recording, to which one line is added at a time"));
    m_forms->addWidget(m_lines);
    m_forms->addWidget(m_injection);
    auto *detectors = new QWidget;
    auto *column = new QVBoxLayout(detectors);
    column->setContentsMargins(8, 0, 8, 4);
    column->addLayout(buildDetectors());
    column->addWidget(m_meaning);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 6, 0, 6);
    layout->setSpacing(2);
    auto *noise = new QHBoxLayout;
    noise->setContentsMargins(8, 0, 8, 0);
    noise->addWidget(m_noise);
    layout->addLayout(noise);
    layout->addWidget(m_forms);
    layout->addWidget(detectors);
    layout->addStretch(1);
    m_meaning->setWordWrap(true);
    QPalette faint = m_meaning->palette();
    faint.setColor(QPalette::WindowText, Theme::colours(*this).faintText);
    m_meaning->setPalette(faint);
    m_meaning->setFont(Theme::font(12));

    connect(m_noise, &QComboBox::currentIndexChanged, m_forms, &QStackedWidget::setCurrentIndex);
    connect(m_noise, &QComboBox::currentIndexChanged, this, &ExperimentForm::suggestInjection);
    connect(m_noise, &QComboBox::currentIndexChanged, this, &ExperimentForm::changed);
    connect(m_injection, &FieldFormBase::edited, this, [this] { m_isInjectionOwn = true; });
    for (FieldForm<Experiment> *form : {m_lines, m_injection})
        connect(form, &FieldFormBase::edited, this, &ExperimentForm::changed);
    connect(this, &ExperimentForm::changed, this, &ExperimentForm::showMeaning);
    showMeaning();
}

/// The current detector, then the peers, in two columns.
QLayout *ExperimentForm::buildDetectors()
{
    m_grid->setVerticalSpacing(2);
    addDetector(new QCheckBox(tr("current detector")));
    addDetector(new QCheckBox(tr("all of detect")));
    for (const DetectorUnderTest &one : peers(1.0))
        addDetector(new QCheckBox(QString::fromStdString(one.name)));
    for (const std::size_t initial : {2, 4, 6})
        m_detectors[initial]->setChecked(true);
    m_detectors[0]->setToolTip(tr("The detector and model set in the pipeline"));
    m_detectors[1]->setToolTip(
        tr("Everything from samples to tracks with the current settings: window chosen, threshold, "
           "refinement. Takes much longer"));
    return m_grid;
}

void ExperimentForm::addDetector(QCheckBox *box)
{
    const auto place = int(m_detectors.size());
    m_grid->addWidget(box, place / 2, place % 2);
    connect(box, &QCheckBox::toggled, this, &ExperimentForm::changed);
    m_detectors.push_back(box);
}

void ExperimentForm::setExperiment(const Experiment &experiment)
{
    if (experiment.isSweep() || (!experiment.isLines() && m_windowSeconds <= 0.0))
        return;
    m_noise->setCurrentIndex(experiment.isLines() ? 0 : 1);
    form().setValue(experiment);
    m_isInjectionOwn |= !experiment.isLines();
    setDetectors(experiment.detectors);
}

void ExperimentForm::setDetectors(const std::vector<DetectorUnderTest> &detectors)
{
    for (std::size_t i = std::exchange(m_others, {}).size(); i > 0; --i) {
        delete m_detectors.back();
        m_detectors.pop_back();
    }
    const std::vector<DetectorUnderTest> known = peers(durationWindows());
    for (std::size_t i = 0; i < currentDetectors; ++i)
        m_detectors[i]->setChecked(false);
    for (std::size_t i = 0; i < known.size(); ++i)
        m_detectors[i + currentDetectors]->setChecked(std::ranges::count(detectors, known[i]) > 0);
    for (const DetectorUnderTest &one : detectors) {
        if (std::ranges::count(known, one) > 0)
            continue;
        m_others.push_back(one);
        const bool isOfAPeer = std::ranges::count(known, one.name, &DetectorUnderTest::name) > 0;
        const QString name = labelText(one.name);
        auto *box = new QCheckBox(isOfAPeer ? tr("%1, as opened").arg(name) : name);
        box->setToolTip(tr("A detector of the experiment shown, with its own settings"));
        box->setChecked(true);
        addDetector(box);
    }
    emit changed();
}

void ExperimentForm::setCurrent(const AnalysisSettings &settings, double windowSeconds, double recordingSeconds)
{
    m_isInjectionOwn &= recordingSeconds == m_recordingSeconds;
    m_settings = settings;
    m_windowSeconds = windowSeconds;
    m_recordingSeconds = recordingSeconds;
    if (windowSeconds <= 0.0)
        m_noise->setCurrentIndex(0);
    m_noise->setEnabled(windowSeconds > 0.0);
    suggestInjection();
    emit changed();
}

/// Lines like those in simulated noise, with noise on either side, unless others were entered.
void ExperimentForm::suggestInjection()
{
    if (m_windowSeconds <= 0.0 || m_isInjectionOwn)
        return;
    const Experiment &like = m_lines->value();
    Experiment injection = m_injection->value();
    injection.durationSeconds =
        m_windowSeconds * std::min(like.durationSeconds, std::floor(0.5 * m_recordingSeconds / m_windowSeconds));
    injection.driftHzPerSecond = like.driftHzPerSecond / (m_windowSeconds * m_windowSeconds);
    injection.wanderHz = like.wanderHz / m_windowSeconds;
    injection.wanderSeconds = like.wanderSeconds * m_windowSeconds;
    m_injection->setValue(injection);
}

FieldForm<Experiment> &ExperimentForm::form() const
{
    return isInRecording() ? *m_injection : *m_lines;
}

/// T_FT; one second in simulated noise.
double ExperimentForm::windowSeconds() const
{
    return isInRecording() ? m_windowSeconds : 1.0;
}

double ExperimentForm::durationWindows() const
{
    return form().value().durationSeconds / windowSeconds();
}

bool ExperimentForm::isInRecording() const
{
    return m_noise->currentIndex() == 1;
}

void ExperimentForm::setInRecording(bool isInRecording)
{
    m_noise->setCurrentIndex(isInRecording ? 1 : 0);
}

std::vector<DetectorUnderTest> ExperimentForm::chosen() const
{
    std::vector<DetectorUnderTest> result;
    if (m_detectors.front()->isChecked()) {
        DetectorUnderTest current{"current: " + std::string(detectorNames[m_settings.detector.index()]), {}};
        current.settings.model = m_settings.model;
        current.settings.detector = m_settings.detector;
        result.push_back(std::move(current));
    }
    if (m_detectors[1]->isChecked()) {
        DetectorUnderTest whole{"detect", m_settings, true};
        if (!isInRecording())
            whole.settings.spectrogram.windowSeconds = 0.0; // a window of simulated noise lasts a second
        result.push_back(std::move(whole));
    }
    const std::vector<DetectorUnderTest> all = peers(durationWindows());
    for (std::size_t i = 0; i < all.size(); ++i)
        if (m_detectors[i + currentDetectors]->isChecked())
            result.push_back(all[i]);
    for (std::size_t i = 0; i < m_others.size(); ++i)
        if (m_detectors[currentDetectors + all.size() + i]->isChecked())
            result.push_back(m_others[i]);
    return result;
}

Experiment ExperimentForm::experiment(const QString &recording) const
{
    Experiment experiment = form().value();
    experiment.detectors = chosen();
    if (isInRecording()) {
        experiment.recording = recording.toStdString();
        experiment.settings = m_settings;
    } else {
        fitBlocks(experiment);
    }
    return experiment;
}

QString ExperimentForm::name() const
{
    QStringList detectors;
    for (const DetectorUnderTest &one : chosen())
        detectors << QString::fromStdString(one.name);
    const auto db = [](double value) { return numberText(value, value == std::floor(value) ? 0 : 1); };
    const auto [lowest, highest] = std::ranges::minmax(form().value().snrDb);
    const double wander = form().value().wanderHz * windowSeconds();
    return tr("%1 · %2 … %3 dB · %4 T_FT%5")
        .arg(detectors.join(QStringLiteral(", ")), db(lowest), db(highest), numberText(durationWindows(), 0),
             wander > 0.0 ? tr(" · wander %1").arg(numberText(wander, 1)) : QString());
}

/// Throws Error.
void ExperimentForm::check() const
{
    if (chosen().empty())
        throw Error("detectors", tr("choose at least one").toStdString());
    if (form().isRefused())
        throw Error("experiment", tr("the marked value must be corrected").toStdString());
    const Experiment made = experiment({});
    checkExperiment(made);
    if (isInRecording() && made.durationSeconds > 0.5 * m_recordingSeconds)
        throw fieldError(
            "durationSeconds", formatNumber(made.durationSeconds),
            tr("a line must last at most half of what is analysed, %1 s").arg(0.5 * m_recordingSeconds).toStdString());
}

QString ExperimentForm::obstacle() const
{
    try {
        check();
        return {};
    } catch (const Error &error) {
        return messageText(error.what());
    }
}

void ExperimentForm::showMeaning()
{
    const QString why = obstacle();
    m_meaning->setText(!why.isEmpty()    ? why
                       : isInRecording() ? tr("In windows of %1 s, lines of %2 windows.")
                                               .arg(m_windowSeconds, 0, 'g', 3)
                                               .arg(numberText(durationWindows(), 0))
                                         : tr("%1 lines per SNR; one false alarm per block of noise.")
                                               .arg(form().value().trials * experiment({}).signalsPerRun()));
}

void ExperimentForm::setQuick(int runs, const QStringList &detectors, const std::vector<double> &snrDb)
{
    for (FieldForm<Experiment> *form : {m_lines, m_injection}) {
        Experiment quick = form->value();
        quick.trials = runs;
        quick.snrDb = snrDb;
        form->setValue(quick);
    }
    for (QCheckBox *box : m_detectors)
        box->setChecked(detectors.contains(box->text()));
    emit changed();
}

} // namespace faintline
