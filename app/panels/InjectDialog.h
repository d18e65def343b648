#pragma once

#include "scene/LineScene.h"
#include "signal/Recording.h"

#include <QDialog>

class QDialogButtonBox;
class QDoubleSpinBox;
class QLabel;

namespace faintline {

/// Parameters of a line to add to the open recording; it begins at the cursor.
class InjectDialog : public QDialog
{
    Q_OBJECT

public:
    InjectDialog(const RecordingInfo &recording, double startSeconds, double frequencyHz, double windowSeconds,
                 QWidget *parent = nullptr);

    LineSettings line() const;

private:
    void check();

    RecordingInfo m_recording;
    double m_windowSeconds;
    QDoubleSpinBox *m_snr;
    QDoubleSpinBox *m_start;
    QDoubleSpinBox *m_duration;
    QDoubleSpinBox *m_frequency;
    QDoubleSpinBox *m_drift;
    QDoubleSpinBox *m_wander;
    QDoubleSpinBox *m_wanderTime;
    QLabel *m_why;
    QDialogButtonBox *m_buttons;
};

} // namespace faintline
