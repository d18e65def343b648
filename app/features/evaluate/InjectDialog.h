#pragma once

#include "scene/LineScene.h"
#include "signal/Recording.h"

#include "widgets/forms/FieldForm.h"

#include <QDialog>

class QDialogButtonBox;
class QLabel;

namespace faintline {

/// Parameters of a line to add to the open recording; it begins at the cursor.
class InjectDialog : public QDialog
{
    Q_OBJECT

public:
    InjectDialog(const RecordingInfo &recording, double startSeconds, double frequencyHz, double windowSeconds,
                 QWidget *parent = nullptr);

    const LineSettings &line() const { return m_line->value(); }

private:
    void check();

    RecordingInfo m_recording;
    FieldForm<LineSettings> *m_line;
    QLabel *m_why;
    QDialogButtonBox *m_buttons;
};

} // namespace faintline
