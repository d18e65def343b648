#pragma once

#include "analysis/WindowChoice.h"

#include <QWidget>

#include <optional>

class QComboBox;
class QFormLayout;
class QLabel;

namespace faintline {

class AnalysisController;
class Document;
class OwnPresets;
class SettingsForm;

/// The chain from recording to tracks as one form: what is open, a starting point, and every setting.
class PipelinePanel : public QWidget
{
    Q_OBJECT

public:
    PipelinePanel(Document &document, AnalysisController &controller, OwnPresets &ownPresets,
                  QWidget *parent = nullptr);

    SettingsForm *form() const { return m_form; }

    /// The settings that are shown get a name of the user's.
    void savePreset();
    /// Asks which one.
    void removePreset();

    QSize sizeHint() const override { return {270, 600}; }

signals:
    void failed(const faintline::Error &error);

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
    /// A preset says nothing about which part of the recording is looked at.
    AnalysisSettings withSelection(AnalysisSettings settings) const;

    Document &m_document;
    AnalysisController &m_controller;
    OwnPresets &m_ownPresets;
    QLabel *m_recording;
    QComboBox *m_preset;
    QComboBox *m_window;
    QFormLayout *m_top;
    SettingsForm *m_form;
    std::optional<WindowChoice> m_choice; ///< the last one made for what is open
};

} // namespace faintline
