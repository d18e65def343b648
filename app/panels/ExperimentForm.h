#pragma once

#include "analysis/AnalysisSettings.h"
#include "evaluate/experiments/InjectionExperiment.h"
#include "evaluate/experiments/LineExperiment.h"

#include <QWidget>

#include <optional>
#include <vector>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QSpinBox;

namespace faintline {

/// What an experiment is to measure: lines of which kind, at which SNRs, in which noise, by which detectors.
///
/// Times are given in windows T_FT and frequencies in resolution cells 1/T_FT, as in the papers; where a recording is
/// open, what they come to there is said below.
class ExperimentForm : public QWidget
{
    Q_OBJECT

public:
    explicit ExperimentForm(QWidget *parent = nullptr);

    /// The current detector competes with these settings; `windowSeconds`: T_FT of what is open, 0 where nothing is;
    /// `recordingSeconds`: of it as much as is analysed.
    void setCurrent(const AnalysisSettings &settings, double windowSeconds, double recordingSeconds);

    bool isInRecording() const;
    void setInRecording(bool isInRecording);
    LineExperiment lines() const;
    InjectionExperiment injection(const QString &recording) const;
    /// "SMD 5 slopes, 3 of 4 · −5 … 3 dB · 100 T_FT".
    QString name() const;
    /// Why it cannot be started; empty where it can.
    QString obstacle() const;

    /// Small and quick: for a first look, and for tests.
    void setQuick(int runs, const QStringList &detectors, double lowestDb, double highestDb, double stepDb);

signals:
    void changed();

private:
    QLayout *buildDetectors();
    void connectInputs();
    void fitDuration();
    std::vector<DetectorUnderTest> chosen() const;
    std::vector<double> snrDb() const;
    void showMeaning();

    AnalysisSettings m_settings;
    double m_windowSeconds = 0.0;
    double m_recordingSeconds = 0.0;
    QComboBox *m_noise;
    std::vector<QCheckBox *> m_detectors; ///< the current one, then the peers
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
