#include "app/panels/ExperimentForm.h"

#include "app/panels/formInputs.h"
#include "evaluate/experiments/peers.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace faintline {

namespace {

    constexpr double mostSnrs = 60.0;
    constexpr std::size_t currentDetectors = 2; ///< with the current settings: the detector alone, and all of `detect`

    /// Frames of a block and signals that fit: Billon's geometry, made longer for longer lines.
    void fitBlocks(LineExperiment &lines)
    {
        const int needed = int(std::ceil((lines.durationWindows + 50.0) * lines.stepsPerWindow));
        if (needed <= lines.blockFrames)
            return;
        lines.blockFrames = needed;
        lines.frames = needed * 3 + needed / 2;
    }

    /// Inputs side by side with a word between them.
    QHBoxLayout *row(QWidget *first, std::initializer_list<std::pair<QString, QWidget *>> others)
    {
        auto *layout = new QHBoxLayout;
        layout->setSpacing(4);
        layout->addWidget(first, 1);
        for (const auto &[word, input] : others) {
            layout->addWidget(new QLabel(word));
            layout->addWidget(input, 1);
        }
        return layout;
    }

} // namespace

ExperimentForm::ExperimentForm(QWidget *parent)
    : QWidget(parent), m_noise(new QComboBox), m_grid(new QGridLayout),
      m_lowestDb(numberInput(-5, {-40, 40, 1, 1}, tr(" dB"), tr("Lowest SNR"))),
      m_highestDb(numberInput(3, {-40, 40, 1, 1}, tr(" dB"), tr("Highest SNR"))),
      m_stepDb(numberInput(1, {0.1, 20, 0.5, 1}, tr(" dB"), tr("Step between SNRs"))),
      m_duration(numberInput(100, {1, 5000, 10, 0}, tr(" T_FT"), tr("Duration of a line, in windows"))),
      m_drift(numberInput(0, {-5, 5, 0.05, 3}, tr(" cells/T_FT"), tr("Steady drift, in resolution cells per window"))),
      m_wander(
          numberInput(0, {0, 20, 0.5, 2}, tr(" cells"), tr("Standard deviation of the wander, in resolution cells"))),
      m_wanderTime(numberInput(15, {1, 1000, 1, 0}, tr(" T_FT"), tr("Correlation time of the wander, in windows"))),
      m_falseAlarms(
          numberInput(1, {0.001, 1000, 1, 3}, tr(" /h"), tr("False alarms per hour to which all detectors are set"))),
      m_runs(countInput(20, 1, 100000,
                        tr("Number of runs of 30 lines each in simulated noise, or of lines added one at a "
                           "time to a recording"))),
      m_seed(countInput(1, 0, 2147483647, tr("Seed; the same seed gives identical results"))), m_meaning(plainLabel())
{
    m_noise->addItem(tr("in simulated noise"));
    m_noise->addItem(tr("in this recording"));
    m_noise->setAccessibleName(tr("Noise to which the lines are added"));
    m_noise->setToolTip(
        tr("White noise as in Billon 2005, or the open recording, to which one line is added at a time"));

    for (QDoubleSpinBox *box : {m_lowestDb, m_highestDb, m_stepDb})
        box->setButtonSymbols(QAbstractSpinBox::NoButtons);

    auto *form = new QFormLayout(this);
    form->setContentsMargins(8, 6, 8, 6);
    form->setVerticalSpacing(4);
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
    form->addRow(tr("Lines"), m_noise);
    form->addRow(tr("SNR"), row(m_lowestDb, {{tr("to"), m_highestDb}, {tr("by"), m_stepDb}}));
    form->addRow(tr("Duration"), m_duration);
    form->addRow(tr("Drift"), m_drift);
    form->addRow(tr("Wander"), row(m_wander, {{tr("over"), m_wanderTime}}));
    form->addRow(tr("Runs"), row(m_runs, {{tr("seed"), m_seed}}));
    form->addRow(tr("False alarms"), m_falseAlarms);
    form->addRow(tr("Detectors"), buildDetectors());
    form->addRow(m_meaning);
    m_meaning->setWordWrap(true);
    QPalette faint = m_meaning->palette();
    faint.setColor(QPalette::WindowText, Theme::colours(*this).faintText);
    m_meaning->setPalette(faint);
    m_meaning->setFont(Theme::font(12));
    connectInputs();
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
    if (const auto *lines = std::get_if<LineExperiment>(&experiment)) {
        m_noise->setCurrentIndex(0);
        m_duration->setValue(lines->durationWindows);
        m_drift->setValue(lines->driftCellsPerWindow);
        m_wander->setValue(lines->wanderCells);
        m_wanderTime->setValue(lines->wanderWindows);
        m_runs->setValue(lines->runs);
        m_seed->setValue(lines->seed);
        setSnrs(lines->snrDb);
    } else if (const auto *injection = std::get_if<InjectionExperiment>(&experiment);
               injection && m_windowSeconds > 0) {
        m_noise->setCurrentIndex(1);
        m_duration->setValue(injection->durationSeconds / m_windowSeconds);
        m_drift->setValue(injection->driftHzPerSecond * m_windowSeconds * m_windowSeconds);
        m_wander->setValue(injection->wanderHz * m_windowSeconds);
        m_wanderTime->setValue(injection->wanderSeconds / m_windowSeconds);
        m_runs->setValue(injection->trials);
        m_seed->setValue(injection->seed);
        m_falseAlarms->setValue(injection->falseAlarmsPerHour);
        setSnrs(injection->snrDb);
    } else {
        return;
    }
    setDetectors(detectorsOf(experiment));
}

/// Lowest, highest, and mean step.
void ExperimentForm::setSnrs(const std::vector<double> &snrDb)
{
    if (snrDb.empty())
        return;
    const auto [lowest, highest] = std::ranges::minmax(snrDb);
    m_lowestDb->setValue(lowest);
    m_highestDb->setValue(highest);
    if (snrDb.size() > 1)
        m_stepDb->setValue((highest - lowest) / double(snrDb.size() - 1));
}

void ExperimentForm::setDetectors(const std::vector<DetectorUnderTest> &detectors)
{
    for (std::size_t i = std::exchange(m_others, {}).size(); i > 0; --i) {
        delete m_detectors.back();
        m_detectors.pop_back();
    }
    const std::vector<DetectorUnderTest> known = peers(m_duration->value());
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

void ExperimentForm::connectInputs()
{
    connect(m_noise, &QComboBox::currentIndexChanged, this, &ExperimentForm::changed);
    for (QDoubleSpinBox *box :
         {m_lowestDb, m_highestDb, m_stepDb, m_duration, m_drift, m_wander, m_wanderTime, m_falseAlarms})
        connect(box, &QDoubleSpinBox::valueChanged, this, &ExperimentForm::changed);
    for (QSpinBox *box : {m_runs, m_seed})
        connect(box, &QSpinBox::valueChanged, this, &ExperimentForm::changed);
    connect(m_noise, &QComboBox::currentIndexChanged, this, &ExperimentForm::fitDuration);
    connect(this, &ExperimentForm::changed, this, &ExperimentForm::showMeaning);
}

void ExperimentForm::setCurrent(const AnalysisSettings &settings, double windowSeconds, double recordingSeconds)
{
    m_settings = settings;
    m_windowSeconds = windowSeconds;
    m_recordingSeconds = recordingSeconds;
    if (windowSeconds <= 0.0)
        m_noise->setCurrentIndex(0);
    m_noise->setEnabled(windowSeconds > 0.0);
    fitDuration();
    emit changed();
}

/// In a recording, a line must fit with noise on either side.
void ExperimentForm::fitDuration()
{
    if (isInRecording() && m_duration->value() * m_windowSeconds > 0.5 * m_recordingSeconds)
        m_duration->setValue(std::floor(0.5 * m_recordingSeconds / m_windowSeconds));
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
    const std::vector<DetectorUnderTest> all = peers(m_duration->value());
    for (std::size_t i = 0; i < all.size(); ++i)
        if (m_detectors[i + currentDetectors]->isChecked())
            result.push_back(all[i]);
    for (std::size_t i = 0; i < m_others.size(); ++i)
        if (m_detectors[currentDetectors + all.size() + i]->isChecked())
            result.push_back(m_others[i]);
    return result;
}

std::vector<double> ExperimentForm::snrDb() const
{
    std::vector<double> result;
    for (int i = 0; double(i) < mostSnrs; ++i) {
        const double db = m_lowestDb->value() + i * m_stepDb->value();
        if (db > m_highestDb->value() + 1e-9)
            break;
        result.push_back(std::round(db * 1e6) / 1e6);
    }
    return result;
}

LineExperiment ExperimentForm::lines() const
{
    LineExperiment lines;
    lines.seed = m_seed->value();
    lines.runs = m_runs->value();
    lines.snrDb = snrDb();
    lines.durationWindows = m_duration->value();
    lines.driftCellsPerWindow = m_drift->value();
    lines.wanderCells = m_wander->value();
    lines.wanderWindows = m_wanderTime->value();
    lines.detectors = chosen();
    fitBlocks(lines);
    return lines;
}

InjectionExperiment ExperimentForm::injection(const QString &recording) const
{
    InjectionExperiment injection;
    injection.recording = recording.toStdString();
    injection.seed = m_seed->value();
    injection.trials = m_runs->value();
    injection.snrDb = snrDb();
    injection.durationSeconds = m_duration->value() * m_windowSeconds;
    injection.driftHzPerSecond = m_drift->value() / (m_windowSeconds * m_windowSeconds);
    injection.wanderHz = m_wander->value() / m_windowSeconds;
    injection.wanderSeconds = m_wanderTime->value() * m_windowSeconds;
    injection.falseAlarmsPerHour = m_falseAlarms->value();
    injection.settings = m_settings;
    injection.detectors = chosen();
    return injection;
}

QString ExperimentForm::name() const
{
    QStringList detectors;
    for (const DetectorUnderTest &one : chosen())
        detectors << QString::fromStdString(one.name);
    const auto db = [](double value) { return numberText(value, value == std::floor(value) ? 0 : 1); };
    return tr("%1 · %2 … %3 dB · %4 T_FT%5")
        .arg(detectors.join(QStringLiteral(", ")), db(m_lowestDb->value()), db(m_highestDb->value()),
             numberText(m_duration->value(), 0),
             m_wander->value() > 0.0 ? tr(" · wander %1").arg(numberText(m_wander->value(), 1)) : QString());
}

QString ExperimentForm::obstacle() const
{
    if (chosen().empty())
        return tr("Choose at least one detector.");
    if (snrDb().empty())
        return tr("The highest SNR lies below the lowest.");
    if (!isInRecording()) {
        try {
            checkExperiment(lines());
        } catch (const Error &error) {
            return messageText(error.what());
        }
    }
    return {};
}

void ExperimentForm::showMeaning()
{
    m_falseAlarms->setEnabled(isInRecording());
    QString text;
    if (isInRecording() && m_windowSeconds > 0.0)
        text = tr("With T_FT = %1 s, lines last %2; %3 false alarms per hour.")
                   .arg(m_windowSeconds, 0, 'g', 3)
                   .arg(secondsText(m_duration->value() * m_windowSeconds, 0.1), powerText(m_falseAlarms->value(), 3));
    else
        text =
            tr("%1 lines per SNR; one false alarm per block of noise.").arg(m_runs->value() * lines().signalsPerRun());
    const QString why = obstacle();
    m_meaning->setText(why.isEmpty() ? text : why);
}

void ExperimentForm::setQuick(int runs, const QStringList &detectors, double lowestDb, double highestDb, double stepDb)
{
    m_runs->setValue(runs);
    m_lowestDb->setValue(lowestDb);
    m_highestDb->setValue(highestDb);
    m_stepDb->setValue(stepDb);
    for (QCheckBox *box : m_detectors)
        box->setChecked(detectors.contains(box->text()));
}

} // namespace faintline
