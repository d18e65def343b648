#pragma once

#include <QWidget>

class QLabel;

namespace faintline {

class AnalysisController;
class Document;
class NoiseCheck;
class RecordingCheck;

/// Figures on the open source, its spectra, and the detector's response to noise, including this recording's.
class InfoPanel : public QWidget
{
    Q_OBJECT

public:
    InfoPanel(const Document &document, AnalysisController &controller, RecordingCheck &check,
              QWidget *parent = nullptr);

    QSize sizeHint() const override { return {380, 220}; }

private:
    void refresh();

    const Document &m_document;
    const AnalysisController &m_controller;
    QLabel *m_label;
    NoiseCheck *m_check;
};

} // namespace faintline
