#pragma once

#include "app/base/Inquiry.h"
#include "inspect/straighten.h"

#include <QDialog>

#include <optional>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace faintline {

class ChartPlot;
class Document;
class Provenance;

/// Writes the recording straightened along an event's track: target frequency, smoothing of the track, and the spectrum
/// over the line's duration before and after.
class StraightenDialog : public QDialog
{
    Q_OBJECT

public:
    /// For an event of the document's analysis. Precondition: it analyses a recording.
    StraightenDialog(const Document &document, const Event &event, Provenance &provenance, QWidget *parent = nullptr);

    QDoubleSpinBox *target() const { return m_target; }
    ChartPlot &before() { return *m_before; }
    ChartPlot &after() { return *m_after; }

    /// The extension selects the format, as in writeRecording.
    void writeTo(const QString &path);

signals:
    void written(const QString &path);

private:
    struct Spectra {
        Straightened straightened;
        LineSpectrum before, after;
    };

    /// Omits unchanged values, so that the file equals that of the command line.
    StraightenChoice choice() const;
    void buildInputs();
    void buildLayout();
    void connectInputs();
    void show(const Spectra *spectra);
    void showTarget(double hz);
    void ask();
    void finish(const QString &path);
    void say(const Error &error);
    void showWriting(bool isWriting);

    std::shared_ptr<const Analysis> m_analysis;
    Event m_event;
    QString m_path; ///< of the recording; empty if it is not a file
    Provenance &m_provenance;
    QDoubleSpinBox *m_target;
    QDoubleSpinBox *m_smoothing;
    std::optional<double> m_usualTarget; ///< default values; the target after the first preview
    double m_usualSmoothing = 0.0;
    QComboBox *m_method;
    QComboBox *m_type;
    QLabel *m_sentence;
    ChartPlot *m_before;
    ChartPlot *m_after;
    QProgressBar *m_progress;
    QPushButton *m_write;
    JobRunner m_writer{this}; ///< last, as the preview, so that their jobs end first
    Inquiry<Spectra, std::shared_ptr<const Analysis>, StraightenChoice> m_preview;
};

} // namespace faintline
