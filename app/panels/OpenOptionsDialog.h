#pragma once

#include "signal/openRecording.h"

#include <QDialog>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QSpinBox;

namespace faintline {

/// Asks for the format of a file of raw samples: type, rate, channels, header. Shown only if a file needs it.
class OpenOptionsDialog : public QDialog
{
    Q_OBJECT

public:
    /// Initialised from the file's name.
    explicit OpenOptionsDialog(const QString &path, QWidget *parent = nullptr);

    OpenOptions options() const;

private:
    void showLength();

    qint64 m_fileBytes;
    QComboBox *m_type;
    QDoubleSpinBox *m_rate;
    QSpinBox *m_channels;
    QSpinBox *m_header;
    QCheckBox *m_iq;
    QLabel *m_length;
};

} // namespace faintline
