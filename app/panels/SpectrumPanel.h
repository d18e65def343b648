#pragma once

#include "app/base/JobRunner.h"
#include "inspect/spectra.h"
#include "widgets/base/Span.h"

#include <QWidget>

class QComboBox;
class QDoubleSpinBox;

namespace faintline {

class ChartPlot;
class Document;
class VisibilityWatcher;

/// The spectrum at the cursor, and the mean over the visible time and band: over the noise, or as a density in dB re
/// full scale²/Hz, to which a calibration is added. For a family of lines it covers the band of its members, with marks
/// at the members for the cursor's position. Computed while visible.
class SpectrumPanel : public QWidget
{
    Q_OBJECT

public:
    explicit SpectrumPanel(Document &document, QWidget *parent = nullptr);

    bool isBusy() const { return m_runner.isRunning(); }
    ChartPlot &plot() { return *m_plot; }
    QDoubleSpinBox *calibration() const { return m_calibration; }

    QSize sizeHint() const override { return {360, 300}; }

signals:
    void settled();

private:
    void follow();
    void show();
    Span band() const;
    void markTeeth();
    SpectrumLevel chosenLevel() const;

    Document &m_document;
    QComboBox *m_level;
    QDoubleSpinBox *m_calibration;
    ChartPlot *m_plot;
    VisibilityWatcher *m_sight;
    Spectra m_spectra;  ///< displayed, without the calibration
    JobRunner m_runner; ///< last, so that its jobs end first
};

} // namespace faintline
