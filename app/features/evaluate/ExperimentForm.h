#pragma once

#include "evaluate/experiments/Campaign.h"
#include "plan/AnalysisSettings.h"
#include "widgets/forms/FieldForm.h"

#include <optional>
#include <vector>

class QCheckBox;
class QComboBox;
class QGridLayout;
class QLabel;
class QStackedWidget;

namespace faintline {

/// Form of an experiment: lines in simulated noise or in the open recording, from the tables of both, and detectors.
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
    Experiment experiment(const QString &recording) const; ///< `recording`: path of the open one
    /// "SMD 5 slopes, 3 of 4 · −5 … 3 dB · 100 T_FT".
    QString name() const;
    /// Why it cannot be started; empty if it can.
    QString obstacle() const;

    /// Small and fast values, for a quick look and for tests.
    void setQuick(int runs, const QStringList &detectors, const std::vector<double> &snrDb);

signals:
    void changed();

private:
    QLayout *buildDetectors();
    void addDetector(QCheckBox *box);
    void setDetectors(const std::vector<DetectorUnderTest> &detectors);
    void suggestInjection();
    FieldForm<Experiment> &form() const; ///< the one that is shown
    double windowSeconds() const;
    double durationWindows() const;
    std::vector<DetectorUnderTest> chosen() const;
    void check() const;
    void showMeaning();

    AnalysisSettings m_settings;
    double m_windowSeconds = 0.0;
    double m_recordingSeconds = 0.0;
    bool m_isInjectionOwn = false; ///< not as suggested for the recording
    QComboBox *m_noise;
    QStackedWidget *m_forms; ///< of both
    FieldForm<Experiment> *m_lines;
    FieldForm<Experiment> *m_injection;
    QGridLayout *m_grid;                     ///< of the detectors, in two columns
    std::vector<QCheckBox *> m_detectors;    ///< two with the current settings, the peers, and m_others
    std::vector<DetectorUnderTest> m_others; ///< of the experiment that is shown
    QLabel *m_meaning;
};

} // namespace faintline
