#include "widgets/forms/FieldForm.h"

#include "base/Error.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/settingWords.h"
#include "widgets/forms/FormSection.h"

#include <QLabel>
#include <QVBoxLayout>

namespace faintline {

FieldFormBase::FieldFormBase(const QString &heading, QWidget *parent)
    : QWidget(parent), m_heading(heading), m_layout(new QVBoxLayout(this)), m_error(plainLabel())
{
    m_layout->setContentsMargins(8, 4, 8, 4);
    m_layout->setSpacing(2);
    m_error->setWordWrap(true);
    m_error->setTextFormat(Qt::PlainText);
    m_error->hide();
    m_layout->addWidget(m_error);
    m_layout->addStretch(1);
}

SettingRow *FieldFormBase::addRow(const FieldInfo &field, const FieldValue &initial)
{
    constexpr int labelWidth = 104;
    const QString name = QString::fromStdString(field.name);
    const auto dot = name.indexOf(QLatin1Char('.'));
    FormSection *&section = m_sections[name.left(std::max<qsizetype>(dot, 0))];
    if (!section) {
        section = new FormSection(dot < 0 ? m_heading : stageLabel(name.left(dot)));
        m_layout->insertWidget(m_layout->count() - 2, section); // above the error and the stretch
    }
    auto *row = new SettingRow(field, initial);
    row->setLabelWidth(labelWidth);
    connect(row, &SettingRow::refusalChanged, this, &FieldFormBase::edited);
    section->addRow(row, field.isAdvanced);
    section->offerMore();
    return m_rows[name] = row;
}

void FieldFormBase::showValue(const std::string &name, const FieldValue &value)
{
    m_rows.value(QString::fromStdString(name))->setValue(value);
}

void FieldFormBase::clearErrors()
{
    m_error->hide();
    for (SettingRow *row : std::as_const(m_rows))
        if (!row->isRefused())
            row->setError(QString());
}

bool FieldFormBase::isRefused() const
{
    return std::ranges::any_of(m_rows, &SettingRow::isRefused);
}

void FieldFormBase::showError(const Error &error)
{
    if (SettingRow *row = m_rows.value(QString::fromStdString(error.field())))
        return row->setError(messageText(error.why()));
    QPalette colours = palette();
    colours.setColor(QPalette::WindowText, Theme::colours(*this).error);
    m_error->setPalette(colours);
    m_error->setText(messageText(error.what()));
    m_error->show();
}

void FieldFormBase::setTracking(bool isOn)
{
    for (SettingRow *row : std::as_const(m_rows))
        row->setTracking(isOn);
}

QWidget *FieldFormBase::editor(const QString &name) const
{
    const SettingRow *row = m_rows.value(name);
    return row ? row->editor() : nullptr;
}

} // namespace faintline
