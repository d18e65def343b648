#pragma once

#include <QKeySequence>
#include <QList>
#include <QMap>
#include <QObject>

#include <functional>
#include <initializer_list>
#include <vector>

class QAction;
class QMainWindow;
class QMenu;

namespace faintline {

/// As rows spell it: Qt::Key_N, Qt::CTRL | Qt::Key_P, QKeySequence::Open.
struct CommandKey : QKeySequence {
    CommandKey() = default;
    template <class Key>
    CommandKey(Key key) : QKeySequence(key)
    {
    }
};

/// A command of the window: a row of the one table from which menus, tool bar, palette and the sheet of keys are made.
struct Command {
    enum When { Shown, Always }; ///< while a recording is shown

    QString text{}; ///< empty: a separator
    CommandKey key{};
    std::function<void()> run{};
    QString tip{}; ///< what the text leaves open
    When when = Shown;
    const char *name = ""; ///< by which others refer to it; also of its icon
    QString brief{};       ///< text on buttons
    bool isChoice = false; ///< one of several of its menu
    /// Its state: whether it is on, its text. Called before it is seen, and after it has run.
    std::function<void(QAction &)> show{};
    QList<QAction *> actions{};             ///< instead of all this: made where they act; null: a separator
    std::function<void(QMenu &)> entries{}; ///< of a menu that stands here; called before it is seen
};

/// The command with a check mark, which tells whether `isOn`.
Command onOff(Command command, std::function<bool()> isOn);

/// The commands of a window as actions, in its menus.
class Commands : public QObject
{
public:
    explicit Commands(QMainWindow &window);

    /// Adds entries to a menu, which is named by its way: "&View/&Theme".
    void add(const QString &menu, std::initializer_list<Command> rows);

    /// Of the row with that name.
    QAction *action(const char *name) const { return m_named.value(QLatin1String(name)); }
    QMenu *menu(const QString &way);
    /// Enables what requires a shown recording.
    void setShown(bool isShown);
    /// Brings states, and entries that depend on them, up to date.
    void refresh();

private:
    void enableMenus();
    QAction *make(const Command &row, QMenu &menu);

    QMainWindow &m_window;
    QMap<QString, QMenu *> m_menus;
    QMap<QString, QAction *> m_named;
    QList<QAction *> m_ofShown;
    std::vector<std::function<void()>> m_updates;
};

} // namespace faintline
