#pragma once

#include <QWidget>

class QLabel;

namespace faintline {

class AnalysisController;
class Document;
class NoiseCheck;
class RecordingCheck;

/// In figures: what was opened, how it was cut into spectra, and how the detector answers to noise, this recording's
/// too.
class InfoPanel : public QWidget
{
    Q_OBJECT

public:
    InfoPanel(const Document &document, AnalysisController &controller, RecordingCheck &check,
              QWidget *parent = nullptr);

    NoiseCheck *check() const { return m_check; }

    QSize sizeHint() const override { return {380, 220}; }

private:
    void refresh();

    const Document &m_document;
    const AnalysisController &m_controller;
    QLabel *m_label;
    NoiseCheck *m_check;
};

} // namespace faintline
