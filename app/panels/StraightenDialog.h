#pragma once

#include "analysis/straighten.h"
#include "app/base/JobRunner.h"

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

/// The recording straightened along an event's track, as a file: where the line goes, how much its track is smoothed,
/// and the spectrum of the line's duration before and after.
class StraightenDialog : public QDialog
{
    Q_OBJECT

public:
    /// Of an event of the document's analysis. Precondition: that is of a recording.
    StraightenDialog(const Document &document, const Event &event, Provenance &provenance, QWidget *parent = nullptr);

    bool isBusy() const { return m_preview.isRunning() || m_writer.isRunning(); }
    QString sentence() const;
    QDoubleSpinBox *target() const { return m_target; }
    QDoubleSpinBox *smoothing() const { return m_smoothing; }
    QComboBox *method() const { return m_method; }
    QComboBox *sampleType() const { return m_type; }
    ChartPlot &before() { return *m_before; }
    ChartPlot &after() { return *m_after; }

    /// Its kind by the extension, as writeRecording has it.
    void writeTo(const QString &path);

signals:
    void settled(); ///< the spectra are those of the inputs, or the sentence says why not; or a file is written, or not
    void written(const QString &path);

private:
    struct Spectra {
        Straightened straightened;
        LineSpectrum before, after;
    };

    /// What was not changed is left out, so that the file is the command line's.
    StraightenChoice choice() const;
    void buildInputs();
    void buildLayout();
    void connectInputs();
    void follow();
    void show(const Spectra &spectra);
    void showTarget(double hz);
    void ask();
    void finish(const QString &path);
    void say(const Error &error);
    void showWriting(bool isWriting);

    std::shared_ptr<const Analysis> m_analysis;
    Event m_event;
    QString m_path; ///< of the recording; empty where it is no file
    Provenance &m_provenance;
    QDoubleSpinBox *m_target;
    QDoubleSpinBox *m_smoothing;
    std::optional<double> m_usualTarget; ///< what the boxes held at first; the target after the first preview
    double m_usualSmoothing = 0.0;
    QComboBox *m_method;
    QComboBox *m_type;
    QLabel *m_sentence;
    ChartPlot *m_before;
    ChartPlot *m_after;
    QProgressBar *m_progress;
    QPushButton *m_write;
    JobRunner m_preview; ///< the runners last, so that their jobs end first
    JobRunner m_writer;
};

} // namespace faintline
