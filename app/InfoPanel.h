#pragma once

#include <QWidget>

class QLabel;

namespace faintline {

class Document;

/// In figures: what was opened, how it was cut into spectra, and how the detector answers to noise.
class InfoPanel : public QWidget
{
    Q_OBJECT

public:
    explicit InfoPanel(const Document &document, QWidget *parent = nullptr);

    QSize sizeHint() const override { return {380, 220}; }

private:
    void refresh();

    const Document &m_document;
    QLabel *m_label;
};

} // namespace faintline
