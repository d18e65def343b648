#pragma once

#include "app/features/live/listenSources.h"

#include <QDialog>
#include <QTimer>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QFormLayout;
class QLineEdit;
class QStackedWidget;

namespace faintline {

/// Asks for the source, the folder to record into, and when to start a new file; shows how much time the disk has left.
class ListenDialog : public QDialog
{
    Q_OBJECT

public:
    explicit ListenDialog(QWidget *parent = nullptr);

    const LiveRun::OpenSource &source() const { return m_source; } ///< valid once accepted
    QString folder() const;
    RotationSettings rotation() const;

    void accept() override; ///< if something is missing, reports it and stays open

private:
    QFormLayout *recordForm();
    const ListenSourceForm &form() const;
    void showDisk();

    QComboBox *m_kind;
    QStackedWidget *m_forms;
    QLineEdit *m_folder;
    QDoubleSpinBox *m_largest;
    QDoubleSpinBox *m_longest;
    QLabel *m_disk;
    QLabel *m_trouble;
    LiveRun::OpenSource m_source;
    QTimer m_refresh;
};

} // namespace faintline
