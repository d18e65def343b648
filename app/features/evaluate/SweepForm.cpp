#include "app/features/evaluate/SweepForm.h"

#include "base/Error.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/settingWords.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    constexpr double windowsOfALine = 60.0; ///< initial duration of a line
    constexpr double windowsOfMargin = 30.0;
    constexpr double samplesOfAWindow = 400.0;   ///< of simulated noise
    constexpr double initialWindowSeconds = 0.5; ///< without a recording

    Experiment linesOf(double windowSeconds, Experiment lines = Experiment::of(Experiment::Kind::Sweep))
    {
        lines.sampleRateHz = samplesOfAWindow / windowSeconds;
        lines.durationSeconds = windowsOfALine * windowSeconds;
        lines.marginSeconds = lines.wanderSeconds = windowsOfMargin * windowSeconds;
        return lines;
    }

    QHBoxLayout *row(std::initializer_list<QWidget *> widgets)
    {
        auto *layout = new QHBoxLayout;
        layout->setSpacing(4);
        for (QWidget *widget : widgets)
            layout->addWidget(widget, qobject_cast<QLabel *>(widget) ? 0 : 1);
        return layout;
    }

    double numberOf(const QLineEdit &edit, const char *what)
    {
        const std::optional<double> value = parseNumber(edit.text().trimmed().toStdString());
        if (!value)
            throw Error(what, "must be a number");
        return *value;
    }

    double asNumber(const FieldValue &value)
    {
        const auto *whole = std::get_if<int>(&value);
        return whole ? *whole : std::get<double>(value);
    }

    QString text(double value)
    {
        return QString::number(value, 'g', 6);
    }

    /// "Threshold · Pfa per cell".
    QString titleOf(const FieldInfo &field)
    {
        const QString name = QString::fromStdString(field.name);
        const QString label = QString::fromStdString(labelOf(field));
        if (!name.contains(QLatin1Char('.')))
            return SweepForm::tr("Line · %1").arg(label);
        const QString stage = stageLabel(name.section(QLatin1Char('.'), 0, 0));
        return stage == label ? label : stage + QStringLiteral(" · ") + label;
    }

} // namespace

SweepForm::SweepForm(QWidget *parent)
    : QWidget(parent), m_parameter(new QComboBox), m_from(new QLineEdit), m_to(new QLineEdit), m_steps(new QSpinBox),
      m_byFactors(new QCheckBox(tr("logarithmic"))), m_noise(new QComboBox),
      m_lines(new FieldForm<Experiment>(tr("Lines"),
                                        withMainFields(Experiment::fields(Experiment::Kind::Sweep),
                                                       {"snrDb", "durationSeconds", "marginSeconds", "driftHzPerSecond",
                                                        "wanderHz", "wanderSeconds", "trials", "seed"}),
                                        linesOf(initialWindowSeconds))),
      m_meaning(plainLabel())
{
    m_steps->setRange(2, 60);
    m_steps->setValue(6);
    m_steps->setAccessibleName(tr("Number of values"));
    m_parameter->setAccessibleName(tr("Setting or property of the line to vary"));
    m_parameter->setMaxVisibleItems(30);
    m_parameter->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_parameter->setMinimumContentsLength(16);
    m_from->setAccessibleName(tr("First value"));
    m_to->setAccessibleName(tr("Last value"));
    m_byFactors->setToolTip(tr("Equal ratios between values instead of equal steps"));
    m_noise->addItem(tr("in simulated noise"));
    m_noise->addItem(tr("in this recording"));
    m_noise->setAccessibleName(tr("Noise to which the lines are added"));

    auto *form = new QFormLayout(this);
    form->setContentsMargins(8, 6, 8, 6);
    form->setVerticalSpacing(4);
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
    form->addRow(tr("Vary"), m_parameter);
    form->addRow(tr("Values"), row({m_from, new QLabel(tr("to")), m_to}));
    form->addRow(tr("Steps"), row({m_steps, m_byFactors}));
    form->addRow(tr("Lines"), m_noise);
    form->addRow(m_lines);
    form->addRow(m_meaning);
    m_meaning->setWordWrap(true);
    m_meaning->setTextFormat(Qt::PlainText);
    m_meaning->setFont(Theme::font(12));

    fillParameters();
    connect(m_parameter, &QComboBox::currentIndexChanged, this, &SweepForm::suggestRange);
    for (QLineEdit *edit : {m_from, m_to})
        connect(edit, &QLineEdit::textChanged, this, &SweepForm::changed);
    connect(m_lines, &FieldFormBase::edited, this, &SweepForm::changed);
    connect(m_steps, &QSpinBox::valueChanged, this, &SweepForm::changed);
    connect(m_byFactors, &QCheckBox::toggled, this, &SweepForm::changed);
    connect(m_noise, &QComboBox::currentIndexChanged, this, &SweepForm::changed);
    connect(this, &SweepForm::changed, this, &SweepForm::showMeaning);
    setParameter(QStringLiteral("decide.thresholdNats"));
    suggestRange();
}

void SweepForm::setCurrent(const AnalysisSettings &settings, const QString &recording, double windowSeconds)
{
    const bool isOther = recording != m_recording || windowSeconds != m_windowSeconds;
    const bool isOtherDetector = settings.detector.index() != m_settings.detector.index();
    m_settings = settings;
    m_recording = recording;
    m_windowSeconds = windowSeconds;
    m_noise->setEnabled(!recording.isEmpty());
    if (recording.isEmpty())
        m_noise->setCurrentIndex(0);
    if (isOtherDetector)
        fillParameters();
    if (isOther && windowSeconds > 0.0) {
        m_lines->setValue(linesOf(windowSeconds, m_lines->value()));
    }
    const double setSeconds = settings.spectrogram.windowSeconds;
    if (const double used = setSeconds > 0.0      ? setSeconds
                            : windowSeconds > 0.0 ? windowSeconds
                                                  : initialWindowSeconds;
        std::exchange(m_usedSeconds, used) != used) {
        Experiment lines = m_lines->value();
        lines.sampleRateHz = samplesOfAWindow / used;
        m_lines->setValue(lines);
    }
    emit changed();
}

/// Properties of the line, and numeric settings of the chosen detector.
void SweepForm::fillParameters()
{
    const QString before = m_parameter->currentData().toString();
    const QSignalBlocker blocker(m_parameter);
    m_parameter->clear();
    const auto add = [this](const FieldInfo &field) {
        m_parameter->addItem(titleOf(field), QString::fromStdString(field.name));
        m_parameter->setItemData(m_parameter->count() - 1, QString::fromStdString(field.sentence), Qt::ToolTipRole);
    };
    for (const Field<Experiment> &property : lineProperties())
        add(property);
    for (const Field<AnalysisSettings> &field : AnalysisSettings::fields())
        if (isSweepable(field) && field.get(m_settings))
            add(field);
    setParameter(before);
}

void SweepForm::setParameter(const QString &parameter)
{
    m_parameter->setCurrentIndex(std::max(m_parameter->findData(parameter), 0));
}

void SweepForm::setRange(double from, double to, int steps, bool isLogarithmic)
{
    m_from->setText(text(from));
    m_to->setText(text(to));
    m_steps->setValue(steps);
    m_byFactors->setChecked(isLogarithmic);
}

void SweepForm::setLines(double snrDb, double durationSeconds, int trials)
{
    Experiment lines = m_lines->value();
    lines.snrDb = {snrDb};
    lines.durationSeconds = durationSeconds;
    lines.marginSeconds = lines.wanderSeconds = 0.5 * durationSeconds;
    lines.trials = trials;
    m_lines->setValue(lines);
    emit changed();
}

void SweepForm::setExperiment(const Experiment &sweep)
{
    if (m_parameter->findData(QString::fromStdString(sweep.parameter)) < 0 || sweep.values.empty())
        return;
    setParameter(QString::fromStdString(sweep.parameter));
    const double first = sweep.values.front(), last = sweep.values.back();
    const auto count = int(sweep.values.size());
    const bool isLogarithmic = count > 2 && first > 0.0 && last > 0.0
                               && sweep.values == sweepValues(sweep.parameter, first, last, count, true);
    setRange(first, last, count, isLogarithmic);
    m_noise->setCurrentIndex(!sweep.recording.empty() && !m_recording.isEmpty() ? 1 : 0);
    m_lines->setValue(sweep);
    emit changed();
}

const FieldInfo &SweepForm::field() const
{
    return parameterInfo(m_parameter->currentData().toString().toStdString());
}

double SweepForm::presentValue(const FieldInfo &info) const
{
    for (const Field<Experiment> &property : lineProperties())
        if (property.name == info.name)
            return asNumber(*property.get(m_lines->value()));
    const std::optional<FieldValue> held = settingField(info.name).get(m_settings);
    return held ? asNumber(*held) : 0.0;
}

/// A range around the present value: a factor of three either way for positive values, some steps for integers.
void SweepForm::suggestRange()
{
    const FieldInfo &info = field();
    const double value = presentValue(info);
    const auto within = [&](double wanted) { return std::clamp(wanted, info.minimum, info.maximum); };
    if (info.name == "decide.thresholdNats")
        setRange(6.0, 20.0, 8, false);
    else if (info.name == "snrDb")
        setRange(value - 5.0, value + 5.0, 6, false);
    else if (info.kind == FieldKind::Integer)
        setRange(within(value - 2.0), within(value + 2.0), 5, false);
    else if (value > 0.0)
        setRange(within(value / 4.0), within(value * 4.0), 5, true);
    else
        setRange(within(value - 1.0), within(value + 1.0), 5, false);
    emit changed();
}

bool SweepForm::isInRecording() const
{
    return m_noise->currentIndex() == 1;
}

Experiment SweepForm::experiment() const
{
    if (m_lines->isRefused())
        throw Error("sweep", tr("the marked value must be corrected").toStdString());
    Experiment sweep = m_lines->value();
    sweep.settings = m_settings;
    sweep.settings.selection = isInRecording() ? m_settings.selection : SelectionSettings();
    sweep.parameter = field().name;
    const double from = numberOf(*m_from, "from"), to = numberOf(*m_to, "to");
    sweep.values = sweepValues(sweep.parameter, from, to, m_steps->value(), m_byFactors->isChecked());
    sweep.recording = isInRecording() ? m_recording.toStdString() : std::string();
    checkExperiment(sweep);
    return sweep;
}

QString SweepForm::name() const
{
    const FieldInfo &info = field();
    const QString unit = info.unit.empty() ? QString() : QLatin1Char(' ') + QString::fromStdString(info.unit);
    const QString where = isInRecording() ? tr("in the recording") : tr("simulated");
    return tr("%1 %2 … %3%4, %5").arg(titleOf(info), m_from->text(), m_to->text(), unit, where);
}

void SweepForm::showMeaning()
{
    try {
        const Experiment sweep = experiment();
        QStringList values;
        for (const double value : sweep.values)
            values << text(value);
        m_meaning->setText(
            tr("%1. Each on %2 trials of %3 s%4.")
                .arg(values.join(QStringLiteral(", ")))
                .arg(sweep.trials)
                .arg(text(sweep.trialSeconds()),
                     sweep.recording.empty() ? tr(" of white noise, %1 Hz").arg(text(sweep.sampleRateHz)) : QString()));
    } catch (const Error &error) {
        m_meaning->setText(messageText(error.what()));
    }
}

} // namespace faintline
