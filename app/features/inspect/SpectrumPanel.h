#pragma once

#include "app/base/Inquiry.h"
#include "inspect/spectra.h"
#include "widgets/base/Span.h"

#include <QWidget>

class QComboBox;
class QDoubleSpinBox;

namespace faintline {

class ChartPlot;
class Document;

/// The spectrum at the cursor, and the mean over the visible time and band: over the noise, or as a density in dB re
/// full scale²/Hz, to which a calibration is added. For a family of lines it covers the band of its members, with marks
/// at the members for the cursor's position. Computed while visible.
class SpectrumPanel : public QWidget
{
    Q_OBJECT

public:
    explicit SpectrumPanel(Document &document, QWidget *parent = nullptr);

    ChartPlot &plot() { return *m_plot; }

    QSize sizeHint() const override { return {360, 300}; }

private:
    /// At the cursor's time, and the mean of the visible time.
    using Asking = Inquiry<Spectra, std::shared_ptr<const Analysis>, double, Span, SpectrumQuantity>;

    Asking::Question question() const;
    void follow();
    void show();
    Span band() const;
    void markTeeth();
    SpectrumQuantity chosenLevel() const;

    Document &m_document;
    QComboBox *m_level;
    QDoubleSpinBox *m_calibration;
    ChartPlot *m_plot;
    Asking m_spectra; ///< without the calibration
};

} // namespace faintline
