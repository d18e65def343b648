#pragma once

#include "plan/AnalysisSettings.h"

#include <QMap>
#include <QString>
#include <QWidget>

class QLabel;
class QScrollArea;
class QVBoxLayout;

namespace faintline {

class FormSection;
class SettingRow;

/// A form generated from AnalysisSettings::fields(), so that settings need no widgets of their own.
///
/// One collapsible section per stage; a text label, an editor of the field's kind, its unit; the field's sentence,
/// range and default as tool tip; a bold label and a reset button if the value differs from the default. Invalid input
/// is reported under the field and not emitted. Seldom-used fields are folded under "More".
class SettingsForm : public QWidget
{
    Q_OBJECT

public:
    explicit SettingsForm(QWidget *parent = nullptr);
    ~SettingsForm() override;

    /// Shows these values; emits nothing. Clears errors.
    void setSettings(const AnalysisSettings &settings);
    const AnalysisSettings &settings() const { return m_settings; }

    /// Shows an error under a field, or under the form if there is no such field; an empty sentence removes it.
    void setError(const QString &name, const QString &sentence);
    void clearErrors();

    /// Shows the result of an automatic value under the field: setNote("spectrogram.windowSeconds", "automatic: 0.5
    /// s").
    void setNote(const QString &name, const QString &note);

    /// Slope in Hz/s of one bin per frame for the open source, shown beside slopes in either unit; 0 if unknown.
    void setHzPerSecondOfABinAFrame(double hzPerSecond);

    /// Shows or hides a section; stages that the open source does not use are hidden.
    void setSectionShown(const QString &prefix, bool isShown);
    /// Whether the open source and the selected detector have a setting; its row is not shown while it has no effect.
    bool isOffered(const QString &name) const;
    /// Scrolls to a field, unfolds its section and gives it the focus.
    void reveal(const QString &name);

    /// The widget that edits a field, null if it is not shown.
    QWidget *editor(const QString &name) const;

signals:
    void settingEdited(const QString &name, const faintline::FieldValue &value);
    /// "Reset all": the application restores the defaults.
    void resetRequested();

private:
    void addRow(const Field<AnalysisSettings> &field);
    void showSlope(const QString &name, double slope);
    FormSection &section(const QString &prefix);

    AnalysisSettings m_settings;
    double m_hzPerSecond = 0.0; ///< of one bin per frame
    QMap<QString, SettingRow *> m_rows;
    QMap<QString, FormSection *> m_sections;
    QVBoxLayout *m_layout = nullptr;
    QScrollArea *m_scroll;
    QLabel *m_error;
};

} // namespace faintline
