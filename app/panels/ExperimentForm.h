#pragma once

#include "evaluate/experiments/Campaign.h"
#include "plan/AnalysisSettings.h"

#include <QWidget>

#include <optional>
#include <vector>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QGridLayout;
class QLabel;
class QSpinBox;

namespace faintline {

/// Form of an experiment: kind of lines, SNRs, noise, and detectors.
///
/// Times are in windows T_FT and frequencies in resolution cells 1/T_FT, as in the papers; their values for the open
/// recording are shown below.
class ExperimentForm : public QWidget
{
    Q_OBJECT

public:
    explicit ExperimentForm(QWidget *parent = nullptr);

    /// The current detector takes part with these settings; `windowSeconds`: T_FT of the open source, 0 without one;
    /// `recordingSeconds`: analysed duration.
    void setCurrent(const AnalysisSettings &settings, double windowSeconds, double recordingSeconds);

    /// Shows the values of an experiment; detectors that the form does not offer are added to the choice.
    void setExperiment(const Experiment &experiment);

    bool isInRecording() const;
    void setInRecording(bool isInRecording);
    LineExperiment lines() const;
    InjectionExperiment injection(const QString &recording) const;
    /// "SMD 5 slopes, 3 of 4 · −5 … 3 dB · 100 T_FT".
    QString name() const;
    /// Why it cannot be started; empty if it can.
    QString obstacle() const;

    /// Small and fast values, for a quick look and for tests.
    void setQuick(int runs, const QStringList &detectors, double lowestDb, double highestDb, double stepDb);

signals:
    void changed();

private:
    QLayout *buildDetectors();
    void addDetector(QCheckBox *box);
    void connectInputs();
    void setSnrs(const std::vector<double> &snrDb);
    void setDetectors(const std::vector<DetectorUnderTest> &detectors);
    void fitDuration();
    std::vector<DetectorUnderTest> chosen() const;
    std::vector<double> snrDb() const;
    void showMeaning();

    AnalysisSettings m_settings;
    double m_windowSeconds = 0.0;
    double m_recordingSeconds = 0.0;
    QComboBox *m_noise;
    QGridLayout *m_grid;                     ///< of the detectors, in two columns
    std::vector<QCheckBox *> m_detectors;    ///< two with the current settings, the peers, and m_others
    std::vector<DetectorUnderTest> m_others; ///< of the experiment that is shown
    QDoubleSpinBox *m_lowestDb;
    QDoubleSpinBox *m_highestDb;
    QDoubleSpinBox *m_stepDb;
    QDoubleSpinBox *m_duration;
    QDoubleSpinBox *m_drift;
    QDoubleSpinBox *m_wander;
    QDoubleSpinBox *m_wanderTime;
    QDoubleSpinBox *m_falseAlarms;
    QSpinBox *m_runs;
    QSpinBox *m_seed;
    QLabel *m_meaning;
};

} // namespace faintline
