#pragma once

#include "app/base/Panel.h"
#include "plan/WindowChoice.h"

#include <optional>

class QComboBox;
class QFormLayout;
class QLabel;

namespace faintline {

class AnalysisController;
class Document;
class OwnPresets;
class SettingsForm;

/// The chain from recording to tracks as one form: the open source, a preset, and all settings.
class PipelinePanel : public Panel
{
    Q_OBJECT

public:
    PipelinePanel(Document &document, AnalysisController &controller, OwnPresets &ownPresets,
                  QWidget *parent = nullptr);

    SettingsForm *form() const { return m_form; }

    /// Saves the displayed settings under a name of the user's choice.
    void savePreset();
    /// Asks for the preset to remove.
    void removePreset();

    QSize sizeHint() const override { return {270, 600}; }

private:
    void showRecording();
    void showSettings();
    void listPresets();
    const Preset &presetAt(int index) const;
    void showNotes();
    void showError(const Error &error);
    void showWindows();
    void applyPreset(int index);
    void applyWindow(int index);
    /// Keeps the selected part of the recording, which presets do not contain, and fits the order of false alarms to it.
    AnalysisSettings forSource(AnalysisSettings settings) const;

    Document &m_document;
    AnalysisController &m_controller;
    OwnPresets &m_ownPresets;
    QLabel *m_recording;
    QComboBox *m_preset;
    QComboBox *m_window;
    QFormLayout *m_top;
    SettingsForm *m_form;
    std::optional<WindowChoice> m_choice; ///< the last one for the open source
};

} // namespace faintline
