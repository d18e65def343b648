#pragma once

#include "evaluate/experiments/Experiment.h"
#include "widgets/forms/FieldForm.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QSpinBox;

namespace faintline {

/// Form of a sweep: the setting, its values, and the test lines.
class SweepForm : public QWidget
{
    Q_OBJECT

public:
    explicit SweepForm(QWidget *parent = nullptr);

    /// Sets all other settings. `recording`: path of the open one, empty if there is none.
    void setCurrent(const AnalysisSettings &settings, const QString &recording, double windowSeconds);

    /// Shows the values of a sweep; all other settings stay those of the window.
    void setExperiment(const Experiment &sweep);

    /// The specified experiment. Throws Error if it is invalid.
    Experiment experiment() const;
    bool isInRecording() const;
    /// "Threshold 5 … 15 nat, simulated".
    QString name() const;

    /// For a quick look, and for tests.
    void setParameter(const QString &parameter);
    void setRange(double from, double to, int steps, bool isLogarithmic);
    void setLines(double snrDb, double durationSeconds, int trials);

signals:
    void changed();

private:
    void fillParameters();
    void suggestRange();
    void showMeaning();
    const FieldInfo &field() const;
    double presentValue(const FieldInfo &info) const;

    AnalysisSettings m_settings;
    QString m_recording;
    double m_windowSeconds = 0.0;
    double m_usedSeconds = 0.0; ///< the window set, else that of the analysis
    QComboBox *m_parameter;
    QLineEdit *m_from;
    QLineEdit *m_to;
    QSpinBox *m_steps;
    QCheckBox *m_byFactors;
    QComboBox *m_noise;
    FieldForm<Experiment> *m_lines;
    QLabel *m_meaning;
};

} // namespace faintline
