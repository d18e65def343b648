#pragma once

#include "app/panels/listenSources.h"

#include <QDialog>
#include <QTimer>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QFormLayout;
class QLineEdit;
class QStackedWidget;

namespace faintline {

/// Asks what to listen to, into which folder it is recorded, and when another file begins; says how much the disk
/// takes.
class ListenDialog : public QDialog
{
    Q_OBJECT

public:
    explicit ListenDialog(QWidget *parent = nullptr);

    const LiveRun::OpenSource &source() const { return m_source; } ///< once accepted
    QString folder() const;
    RotationSettings rotation() const;
    QString diskWords() const;

    void accept() override; ///< stays where something is missing, and says what

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
