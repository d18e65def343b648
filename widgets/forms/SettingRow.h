#pragma once

#include "base/Field.h"

#include <QWidget>

class QLabel;
class QToolButton;

namespace faintline {

/// One setting in a form: label, editor, unit, and a button that restores the default.
class SettingRow : public QWidget
{
    Q_OBJECT

public:
    /// A number with `stepsInOne` steps per unit has arrows that move between multiples; other values can be typed.
    SettingRow(const FieldInfo &info, const FieldValue &defaultValue, double stepsInOne = 0.0,
               QWidget *parent = nullptr);

    const FieldInfo &info() const { return m_info; }
    QWidget *editor() const { return m_editor; }
    QLabel *label() const { return m_label; }

    void setValue(const FieldValue &value);
    /// Whether the text in the editor was refused, and is not the value.
    bool isRefused() const { return m_isRefused; }
    void setError(const QString &sentence);
    void setNote(const QString &note);
    void setLabelWidth(int width);
    /// Whether each letter and digit that is typed counts, not only the finished text.
    void setTracking(bool isOn);
    void setStepsInOne(double steps) { m_stepsInOne = steps; }
    /// For a unit and range that differ from those of the field's table.
    void setUnit(const QString &unit, double largestMagnitude);

signals:
    void edited(const faintline::FieldValue &value);
    void refusalChanged();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    void makeEditor();
    void acceptText(const QString &text);
    void refuse(const QString &why);
    void stepBy(int steps);
    void accept(const FieldValue &value);
    void showMessage();

    FieldInfo m_info;
    FieldValue m_default;
    FieldValue m_value;
    bool m_isRefused = false; ///< the last input
    bool m_isTracking = false;
    bool m_isTyping = false; ///< its text stays as it is
    double m_stepsInOne;
    QLabel *m_label;
    QWidget *m_editor = nullptr;
    QLabel *m_unit;
    QToolButton *m_reset;
    QLabel *m_message; ///< error or note
    QString m_error;
    QString m_note;
};

} // namespace faintline
