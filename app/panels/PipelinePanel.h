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
class SettingsForm;

/// The chain from recording to tracks as one form: what is open, a starting point, and every setting.
class PipelinePanel : public QWidget
{
    Q_OBJECT

public:
    PipelinePanel(Document &document, AnalysisController &controller, QWidget *parent = nullptr);

    SettingsForm *form() const { return m_form; }

    QSize sizeHint() const override { return {270, 600}; }

private:
    void showRecording();
    void showSettings();
    void showNotes();
    void showError(const Error &error);
    void showWindows();
    void applyPreset(int index);
    void applyWindow(int index);
    /// A preset says nothing about which part of the recording is looked at.
    AnalysisSettings withSelection(AnalysisSettings settings) const;

    Document &m_document;
    AnalysisController &m_controller;
    QLabel *m_recording;
    QComboBox *m_preset;
    QComboBox *m_window;
    QFormLayout *m_top;
    SettingsForm *m_form;
    std::optional<WindowChoice> m_choice; ///< the last one made for what is open
};

} // namespace faintline
