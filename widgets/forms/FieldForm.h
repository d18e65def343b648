#pragma once

#include "base/Field.h"
#include "widgets/forms/SettingRow.h"

#include <QMap>
#include <QString>
#include <QWidget>

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

class QLabel;
class QVBoxLayout;

namespace faintline {

class Error;
class FormSection;

/// What forms of all structs have in common; see FieldForm.
class FieldFormBase : public QWidget
{
    Q_OBJECT

public:
    /// Shows the error under the field that it names, or under the form.
    void showError(const Error &error);
    /// Except those of refused text.
    void clearErrors();
    /// Whether the text of a row was refused: the value is not what is written.
    bool isRefused() const;
    /// As of its rows.
    void setTracking(bool isOn);
    /// The widget that edits a field; null if there is none of this name.
    QWidget *editor(const QString &name) const;

signals:
    void edited(); ///< also when text was refused, or no longer is

protected:
    FieldFormBase(const QString &heading, QWidget *parent);

    /// In the section of its prefix, or of the heading.
    SettingRow *addRow(const FieldInfo &field, const FieldValue &initial);
    void showValue(const std::string &name, const FieldValue &value);

private:
    QString m_heading;
    QMap<QString, FormSection *> m_sections;
    QMap<QString, SettingRow *> m_rows;
    QVBoxLayout *m_layout;
    QLabel *m_error;
};

/// A form generated from a table of fields, which edits a value in place: what has no row keeps its value. SettingsForm
/// is the one of an analysis's settings.
template <class S>
class FieldForm : public FieldFormBase
{
public:
    /// `heading`: of the fields whose name has no prefix. `initial`: the value to which a row can be reset.
    explicit FieldForm(const QString &heading, std::vector<Field<S>> fields = S::fields(), const S &initial = S(),
                       QWidget *parent = nullptr)
        : FieldFormBase(heading, parent), m_fields(std::move(fields)), m_value(initial)
    {
        for (const Field<S> &field : m_fields)
            connect(addRow(field, *field.get(initial)), &SettingRow::edited, this,
                    [this, &field](const FieldValue &value) {
                        field.set(m_value, value);
                        clearErrors();
                        emit edited();
                    });
        setValue(initial);
    }

    const S &value() const { return m_value; }
    /// Emits nothing; clears errors.
    void setValue(const S &value)
    {
        m_value = value;
        for (const Field<S> &field : m_fields)
            showValue(field.name, *field.get(value));
        clearErrors();
    }

private:
    std::vector<Field<S>> m_fields;
    S m_value;
};

/// The fields of these names, in their order; the others after them, folded away.
template <class S>
std::vector<Field<S>> withMainFields(const std::vector<Field<S>> &fields, std::initializer_list<std::string_view> names)
{
    std::vector<Field<S>> all;
    const auto isMain = [&](const Field<S> &field) { return std::ranges::count(names, field.name) > 0; };
    for (const std::string_view name : names)
        std::ranges::copy_if(fields, std::back_inserter(all),
                             [&](const Field<S> &field) { return field.name == name; });
    for (const Field<S> &field : fields)
        if (!isMain(field))
            all.push_back(field.advanced());
    return all;
}

} // namespace faintline
