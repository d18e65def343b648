#pragma once

#include <QFrame>
#include <QList>
#include <QPointer>

class QAction;
class QLineEdit;
class QListWidget;

namespace faintline {

/// Finds every command of the window by name: type some of its letters and press Enter. The letters need not be
/// adjacent: "nofi" finds "Noise fit". Arrow keys choose, Escape closes. A popup, so that no floating panel covers it.
class CommandPalette : public QFrame
{
    Q_OBJECT

public:
    explicit CommandPalette(QWidget *window);

    /// Shows the commands that are enabled now.
    void open(const QList<QAction *> &commands);

    QLineEdit *line() const { return m_line; }
    QListWidget *list() const { return m_list; }

    /// How well a name matches the typed text: larger is better, negative if the letters do not occur in this order.
    /// Names in which the text begins a word come first.
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
    QPointer<QWidget> m_previousFocus; ///< has the focus when a command is carried out

    void giveFocusBack();
};

} // namespace faintline
