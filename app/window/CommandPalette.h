#pragma once

#include <QFrame>
#include <QList>
#include <QPointer>

class QAction;
class QLineEdit;
class QListWidget;

namespace faintline {

/// Every command of the window by name: type some letters of it, Enter carries it out. Letters need not stand together:
/// "nofi" finds "Noise fit". Arrows choose, Escape leaves.
class CommandPalette : public QFrame
{
    Q_OBJECT

public:
    explicit CommandPalette(QWidget *window);

    /// Shows what can be done now.
    void open(const QList<QAction *> &commands);

    QLineEdit *line() const { return m_line; }
    QListWidget *list() const { return m_list; }

    /// How well a name suits what was typed: larger is better; negative if its letters are not there in this order.
    static int match(const QString &name, const QString &typed);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void collect(const QList<QAction *> &actions, const QString &path);
    void filter(const QString &typed);
    void carryOut();

    struct Command {
        QString name; ///< "Menu: entry", "Menu: submenu: entry"
        QAction *action;
    };

    QLineEdit *m_line;
    QListWidget *m_list;
    QList<Command> m_commands;
    QPointer<QWidget> m_previousFocus; ///< where a command is carried out

    void giveFocusBack();
};

} // namespace faintline
