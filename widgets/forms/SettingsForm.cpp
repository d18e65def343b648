#include "widgets/forms/SettingsForm.h"

#include "plan/slopeUnit.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/settingWords.h"
#include "widgets/forms/FormSection.h"
#include "widgets/forms/SettingRow.h"
#include "widgets/forms/settingApplies.h"

#include <QCoreApplication>
#include <QEvent>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSet>
#include <QVBoxLayout>

namespace faintline {

namespace {

    constexpr int labelWidth = 108;

    QString prefixOf(const QString &name)
    {
        return name.section(QLatin1Char('.'), 0, 0);
    }

    bool isSlope(const QString &name)
    {
        return name == QLatin1String("model.lowestSlope") || name == QLatin1String("model.highestSlope");
    }

    /// Four digits, with a true minus sign.
    QString numberOf(double value)
    {
        return QString::number(value, 'g', 4).replace(QLatin1Char('-'), QChar(0x2212));
    }

    /// Lays out the contents around a row now, instead of on return to the event loop, so that its place is known.
    void layOut(QScrollArea &area, const QWidget *row)
    {
        for (QWidget *around = row->parentWidget(); around != area.viewport(); around = around->parentWidget())
            around->layout()->activate();
        QEvent contentsChanged(QEvent::LayoutRequest);
        QCoreApplication::sendEvent(&area, &contentsChanged);
    }

} // namespace

SettingsForm::SettingsForm(QWidget *parent) : QWidget(parent), m_scroll(new QScrollArea), m_error(plainLabel())
{
    auto *content = new QWidget;
    m_layout = new QVBoxLayout(content);
    m_layout->setContentsMargins(2, 2, 2, 4);
    m_layout->setSpacing(2);
    for (const auto &field : AnalysisSettings::fields())
        addRow(field);
    m_layout->addStretch(1);

    m_scroll->setWidget(content);
    m_scroll->setWidgetResizable(true);
    m_scroll->setFrameShape(QFrame::NoFrame);
    m_scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_scroll->setFocusPolicy(Qt::NoFocus);
    m_error->setWordWrap(true);
    m_error->setContentsMargins(8, 2, 8, 2);
    m_error->hide();
    auto *reset = new QPushButton(tr("Reset all to defaults"));
    connect(reset, &QPushButton::clicked, this, &SettingsForm::resetRequested);

    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 4);
    layout->setSpacing(4);
    layout->addWidget(m_scroll, 1);
    layout->addWidget(m_error);
    layout->addWidget(reset, 0, Qt::AlignHCenter);
    m_scroll->setMinimumWidth(content->minimumSizeHint().width() + 14);
    setAccessibleName(tr("Settings"));
    setSettings(m_settings);
}

SettingsForm::~SettingsForm() = default;

void SettingsForm::setSectionShown(const QString &prefix, bool isShown)
{
    if (FormSection *section = m_sections.value(prefix))
        section->setVisible(isShown);
}

FormSection &SettingsForm::section(const QString &prefix)
{
    FormSection *&section = m_sections[prefix];
    if (!section) {
        section = new FormSection(stageLabel(prefix));
        m_layout->addWidget(section);
    }
    return *section;
}

void SettingsForm::addRow(const Field<AnalysisSettings> &field)
{
    const QString name = QString::fromStdString(field.name);
    auto *row = new SettingRow(field, defaultValue(field), isSlope(name) ? m_settings.model.slopesPerBin : 0);
    row->setLabelWidth(labelWidth);
    connect(row, &SettingRow::edited, this,
            [this, name](const FieldValue &edited) { emit settingEdited(name, edited); });
    section(prefixOf(name)).addRow(row, field.isAdvanced);
    m_rows[name] = row;
}

void SettingsForm::setSettings(const AnalysisSettings &settings)
{
    m_settings = settings;
    clearErrors();
    QSet<QString> used; // sections in use: only the selected detector's
    for (const auto &field : AnalysisSettings::fields()) {
        const QString name = QString::fromStdString(field.name);
        SettingRow *row = m_rows.value(name);
        const auto value = field.get(settings);
        if (!row)
            continue;
        row->setVisible(settingApplies(field.name, settings));
        if (!value)
            continue;
        row->setValue(*value);
        if (isSlope(name))
            showSlope(name, std::get<double>(*value));
        used.insert(prefixOf(name));
    }
    for (auto section = m_sections.begin(); section != m_sections.end(); ++section) {
        section.value()->setVisible(used.contains(section.key()));
        section.value()->offerMore();
    }
}

void SettingsForm::setHzPerSecondOfABinAFrame(double hzPerSecond)
{
    m_hzPerSecond = hzPerSecond;
    for (const auto &field : AnalysisSettings::fields())
        if (const QString name = QString::fromStdString(field.name); isSlope(name))
            showSlope(name, std::get<double>(*field.get(m_settings)));
}

/// Shows the unit of a slope, its step, and its value in the other unit.
void SettingsForm::showSlope(const QString &name, double slope)
{
    SettingRow &row = *m_rows.value(name);
    const bool isHertz = m_settings.model.slopeUnit == SlopeUnit::HzPerSecond;
    const bool isKnown = m_hzPerSecond > 0.0;
    constexpr double mostBins = 100.0;
    row.setUnit(isHertz ? tr("Hz/s") : tr("bins/frame"),
                isHertz ? (isKnown ? mostBins * m_hzPerSecond : row.info().maximum) : mostBins);
    row.setStepsInOne(m_settings.model.slopesPerBin / (isHertz && isKnown ? m_hzPerSecond : 1.0));
    if (!isKnown)
        return row.setNote(QString());
    const ModelSettings &model = m_settings.model;
    const ModelSettings inBins = withSlopesIn(SlopeUnit::BinsPerFrame, model, m_hzPerSecond);
    const double bins = name == QLatin1String("model.lowestSlope") ? inBins.lowestSlope : inBins.highestSlope;
    row.setNote(isHertz ? tr("%1 bins/frame here").arg(numberOf(bins))
                        : tr("%1 Hz/s here").arg(numberOf(slope * m_hzPerSecond)));
}

void SettingsForm::setError(const QString &name, const QString &sentence)
{
    if (SettingRow *row = m_rows.value(name)) {
        row->setError(sentence);
        if (!sentence.isEmpty()) {
            row->show(); // also if it does not apply
            section(prefixOf(name)).reveal(row);
        }
        return;
    }
    QPalette palette = m_error->palette();
    palette.setColor(QPalette::WindowText, Theme::colours(*this).error);
    m_error->setPalette(palette);
    m_error->setText(sentence);
    m_error->setVisible(!sentence.isEmpty());
}

void SettingsForm::clearErrors()
{
    for (SettingRow *row : std::as_const(m_rows))
        row->setError(QString());
    m_error->hide();
}

void SettingsForm::setNote(const QString &name, const QString &note)
{
    if (SettingRow *row = m_rows.value(name))
        row->setNote(note);
}

bool SettingsForm::isOffered(const QString &name) const
{
    return m_rows.contains(name) && settingField(name.toStdString()).get(m_settings).has_value()
           && !m_sections.value(prefixOf(name))->isHidden();
}

void SettingsForm::reveal(const QString &name)
{
    SettingRow *row = m_rows.value(name);
    if (!row)
        return;
    row->show(); // also if it does not apply
    section(prefixOf(name)).reveal(row);
    layOut(*m_scroll, row);
    m_scroll->ensureWidgetVisible(row);
    row->editor()->setFocus(Qt::OtherFocusReason);
}

QWidget *SettingsForm::editor(const QString &name) const
{
    const SettingRow *row = m_rows.value(name);
    return row ? row->editor() : nullptr;
}

} // namespace faintline
