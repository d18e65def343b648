#include "app/window/programWindows.h"

#include "app/base/filePath.h"
#include "app/document/Recovery.h"
#include "app/window/MainWindow.h"
#include "app/window/Opener.h"

#include <QScreen>

#include <algorithm>

namespace faintline {

namespace {

    /// A window that does not fit its screen together with its frame takes all of the screen.
    void fitScreen(QWidget &window)
    {
        constexpr QSize frame(16, 48); // of most window managers
        const QSize room = window.screen()->availableSize() - frame;
        if (window.size().boundedTo(room) == window.size())
            return;
        window.resize(window.size().boundedTo(room));
        window.setWindowState(window.windowState() | Qt::WindowMaximized);
    }

} // namespace

std::vector<std::unique_ptr<MainWindow>> programWindows(const std::vector<std::string> &files,
                                                        const OpenOptions &options)
{
    Theme::apply(WindowMemory(WindowMemory::programStore()).theme());
    std::vector<std::unique_ptr<MainWindow>> windows;
    for (std::size_t i = 0; i < std::max<std::size_t>(1, files.size()); ++i) {
        windows.push_back(std::make_unique<MainWindow>(WindowMemory::programStore(), Recovery::programFolder()));
        fitScreen(*windows.back());
        windows.back()->show(); // first: Qt crashes if panels are arranged in a maximised window before it is shown
        if (i < files.size())
            windows.back()->open(pathText(files[i]), options);
    }
    windows.front()->opener().offerRecovery(Recovery::programFolder());
    return windows;
}

} // namespace faintline
