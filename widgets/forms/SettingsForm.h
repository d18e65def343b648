#pragma once

#include "analysis/AnalysisSettings.h"

#include <QMap>
#include <QString>
#include <QWidget>

class QLabel;
class QScrollArea;
class QVBoxLayout;

namespace faintline {

class FormSection;
class SettingRow;

/// A form made from AnalysisSettings::fields(): nobody writes a widget for a setting.
///
/// One collapsible section per stage; a label in words, an editor of the field's kind, its unit; the field's sentence,
/// range and default as tool tip; a bold label and a button to go back where the value differs from the default. Text
/// that cannot be read is answered under the field and not emitted. Seldom-used fields are folded away under "More".
class SettingsForm : public QWidget
{
    Q_OBJECT

public:
    explicit SettingsForm(QWidget *parent = nullptr);
    ~SettingsForm() override;

    /// Shows these values; emits nothing. Clears errors.
    void setSettings(const AnalysisSettings &settings);
    const AnalysisSettings &settings() const { return m_settings; }

    /// A sentence under one field, or under the form where there is no such field; empty takes it away.
    void setError(const QString &name, const QString &sentence);
    void clearErrors();

    /// What an automatic value came to, shown under the field: setNote("spectrogram.windowSeconds", "automatic: 0.5
    /// s").
    void setNote(const QString &name, const QString &note);

    /// How many Hz/s one bin a frame is in what is open, shown beside slopes of either unit; 0 where nobody knows.
    void setHzPerSecondOfABinAFrame(double hzPerSecond);

    /// Hides the stages that what is open does not go through.
    void setSectionShown(const QString &prefix, bool isShown);
    /// Scrolls to a field, unfolds its section and gives it the focus.
    void reveal(const QString &name);

    /// The widget that edits a field, null if it is not shown.
    QWidget *editor(const QString &name) const;

signals:
    void settingEdited(const QString &name, const faintline::FieldValue &value);
    /// "Reset all": the app sets the defaults.
    void resetRequested();

private:
    void addRow(const Field<AnalysisSettings> &field);
    void showSlope(const QString &name, double slope);
    FormSection &section(const QString &prefix);

    AnalysisSettings m_settings;
    double m_hzPerSecond = 0.0; ///< of one bin a frame
    QMap<QString, SettingRow *> m_rows;
    QMap<QString, FormSection *> m_sections;
    QVBoxLayout *m_layout = nullptr;
    QScrollArea *m_scroll;
    QLabel *m_error;
};

} // namespace faintline
