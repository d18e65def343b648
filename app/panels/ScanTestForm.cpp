#include "app/panels/ScanTestForm.h"

#include "base/Error.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/base/settingWords.h"
#include "widgets/forms/FormSection.h"
#include "widgets/forms/SettingRow.h"

#include <QLabel>
#include <QVBoxLayout>

namespace faintline {

ScanTestForm::ScanTestForm(QWidget *parent) : QWidget(parent), m_error(plainLabel())
{
    constexpr int labelWidth = 104;
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 4, 8, 4);
    layout->setSpacing(2);
    QMap<QString, FormSection *> sections;
    for (const Field<ScanTest> &field : ScanTest::fields()) {
        const QString name = QString::fromStdString(field.name);
        const QString prefix = name.section(QLatin1Char('.'), 0, 0);
        FormSection *&section = sections[prefix];
        if (!section) {
            section = new FormSection(stageLabel(prefix));
            layout->addWidget(section);
        }
        auto *row = new SettingRow(field, *field.get(ScanTest()));
        row->setLabelWidth(labelWidth);
        section->addRow(row, field.isAdvanced);
        m_rows[name] = row;
        connect(row, &SettingRow::edited, this, [this, &field](const FieldValue &value) {
            field.set(m_test, value);
            m_error->hide();
            emit edited();
        });
    }
    m_error->setWordWrap(true);
    m_error->setTextFormat(Qt::PlainText);
    m_error->hide();
    layout->addWidget(m_error);
    layout->addStretch(1);
    setAccessibleName(tr("Settings of the sequential test"));
    showValues();
}

void ScanTestForm::setTest(const ScanTest &test)
{
    m_test = test;
    showValues();
}

void ScanTestForm::showValues()
{
    m_error->hide();
    for (const Field<ScanTest> &field : ScanTest::fields()) {
        SettingRow *row = m_rows.value(QString::fromStdString(field.name));
        row->setError(QString());
        row->setValue(*field.get(m_test));
    }
}

void ScanTestForm::showError(const Error &error)
{
    if (SettingRow *row = m_rows.value(QString::fromStdString(error.field())))
        return row->setError(messageText(error.why()));
    QPalette colours = palette();
    colours.setColor(QPalette::WindowText, Theme::colours(*this).error);
    m_error->setPalette(colours);
    m_error->setText(messageText(error.what()));
    m_error->show();
}

QWidget *ScanTestForm::editor(const QString &name) const
{
    const SettingRow *row = m_rows.value(name);
    return row ? row->editor() : nullptr;
}

} // namespace faintline
