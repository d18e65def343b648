#pragma once

#include "app/panels/listenSources.h"

#include <QDialog>

class QComboBox;
class QLabel;
class QLineEdit;
class QStackedWidget;

namespace faintline {

/// Asks what to listen to, and into which folder it is recorded.
class ListenDialog : public QDialog
{
    Q_OBJECT

public:
    explicit ListenDialog(QWidget *parent = nullptr);

    const LiveRun::OpenSource &source() const { return m_source; } ///< once accepted
    QString folder() const;

    void accept() override; ///< stays where something is missing, and says what

private:
    QComboBox *m_kind;
    QStackedWidget *m_forms;
    QLineEdit *m_folder;
    QLabel *m_trouble;
    LiveRun::OpenSource m_source;
};

} // namespace faintline
