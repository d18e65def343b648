#pragma once

#include "signal/fileFormats.h"

#include "widgets/forms/FieldForm.h"

#include <QDialog>

class QDialogButtonBox;
class QLabel;

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
    FieldForm<OpenOptions> *m_form;
    QLabel *m_length;
    QDialogButtonBox *m_buttons;
};

} // namespace faintline
