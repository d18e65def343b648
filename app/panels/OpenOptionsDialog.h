#pragma once

#include "recording/openRecording.h"

#include <QDialog>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QSpinBox;

namespace faintline {

/// Asks for what a file of bare samples does not tell: type, rate, channels, header. Shown only when a file needs it.
class OpenOptionsDialog : public QDialog
{
    Q_OBJECT

public:
    /// Begins with what the file's name says.
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
