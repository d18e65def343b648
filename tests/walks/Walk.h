#pragma once

#include "app/window/MainWindow.h"
#include "walks/Hand.h"

#include <QCoreApplication>
#include <QTemporaryDir>

#include <functional>
#include <memory>
#include <type_traits>
#include <vector>

class QTableView;

namespace faintline {

class WaterfallPicture;

namespace test {

    /// A user who goes through the program step by step: finds what the window shows by its name, uses it by hand, and
    /// waits until what should follow is seen.
    ///
    /// The program runs as its users start it. A walk has a thread of its own, so that menus and dialogs, which run
    /// event loops of theirs, do not stop it; whatever looks at widgets does so in the program's thread, by `see`. What
    /// is not seen within the patience of a slow machine ends the walk with a picture of the screen.
    class Walk
    {
    public:
        /// Runs a walk in the program; the exit code.
        static int run(const char *name, int argc, char **argv, void (*way)(Walk &));

        Hand hand;

        /// Starts the program with these files, as after it was quit.
        void start(const std::vector<std::string> &files = {});
        MainWindow &window() { return *m_windows.front(); }
        QString path(const QString &name) const { return m_folder.filePath(name); } ///< in a folder of the walk's own

        /// The value of `look`, taken in the program's thread.
        template <class Look>
        auto see(Look look)
        {
            std::invoke_result_t<Look> result{};
            QMetaObject::invokeMethod(
                qApp, [&] { result = look(); }, Qt::BlockingQueuedConnection);
            return result;
        }
        void waitUntil(const QString &what, const std::function<bool()> &isSo);
        void waitForResults(); ///< nothing is being computed
        /// Saves the screen as NAME.png where FAINTLINE_WALK_PICTURES tells a folder.
        void takePicture(const QString &name);

        // ---- what is seen; each waits until it is ---------------------------------------------------------------

        /// The middle of a widget that bears this name, is enabled and not covered.
        QPoint placeOf(const QString &name, const char *kind = "QWidget");
        /// The place of a widget's part that is not covered.
        QPoint placeIn(const std::function<QWidget *()> &widget, const std::function<QPointF()> &part);
        QPoint placeIn(WaterfallPicture &picture, double seconds, double hz);
        void waitForText(const QString &part); ///< in a label, a button or a window's title

        // ---- what is done --------------------------------------------------------------------------------------

        void click(const QString &name, const char *kind = "QWidget") { hand.click(placeOf(name, kind)); }
        void clickTab(const QString &title);
        void choose(const QStringList &way);                   ///< from the menu bar
        void pick(const QString &entry);                       ///< from the open menu
        void fillIn(const QString &name, const QString &text); ///< replaces a field's text, and presses Return
        void answerFileDialog(const QString &title, const QString &file);

    private:
        QPoint waitForPlace(const QString &what, const std::function<QPoint()> &place);

        std::vector<std::unique_ptr<MainWindow>> m_windows;
        QTemporaryDir m_folder;
    };

} // namespace test

} // namespace faintline
