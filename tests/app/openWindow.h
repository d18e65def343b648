#pragma once

#include "app/features/pictures/Workbench.h"
#include "app/window/Listening.h"
#include "app/window/MainWindow.h"
#include "support/slowdown.h"

#include <QAbstractButton>
#include <QFile>
#include <QLabel>
#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <memory>

namespace faintline::test {

/// How tests of the window begin: a small scene, a window without questions, and waiting.

constexpr int patience = 120'000 * slowdown; ///< ms, for a machine that is busy with other things

/// A file with that text; its path.
inline QString writeFile(const QTemporaryDir &folder, const QString &name, const QByteArray &text)
{
    QFile file(folder.filePath(name));
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size())
        qFatal("cannot write a test file");
    return file.fileName();
}

/// A window that is seen and asks nothing.
inline std::unique_ptr<MainWindow> newWindow(QSize size = {1400, 900}, std::unique_ptr<QSettings> memory = {},
                                             const QString &recoveryFolder = {})
{
    auto window = std::make_unique<MainWindow>(std::move(memory), recoveryFolder);
    window->setAsking(false);
    window->resize(size);
    window->show();
    return window;
}

/// The button of a widget with that text.
inline QAbstractButton *buttonOf(const QWidget &widget, const QString &text)
{
    for (QAbstractButton *button : widget.findChildren<QAbstractButton *>())
        if (button->text().remove(QLatin1Char('&')) == text)
            return button;
    qFatal("no button %s", qPrintable(text));
}

/// Waits until nothing of a part of the window is computed.
template <class Part>
bool settle(const Part &part)
{
    return QTest::qWaitFor([&] { return !isBusy(part); }, patience);
}

inline bool settle(MainWindow &window)
{
    return settle(window.controller());
}

/// What a panel says; empty if it says nothing.
inline QString sentenceOf(const QWidget &panel)
{
    const auto *label = panel.findChild<QLabel *>(QStringLiteral("sentence"));
    return label->isHidden() ? QString() : label->text();
}

inline bool openAndSettle(MainWindow &window, const QString &path, const AnalysisController::Adjust &adjust = {})
{
    window.open(path, {}, adjust);
    return settle(window);
}

/// A test of a window in which something is open.
class WindowTest : public QObject
{
protected:
    WindowTest() { Theme::apply(Theme::Kind::Light); }

    /// Opens a scene in a new window; whether that is done.
    bool open(const QByteArray &scene, const AnalysisController::Adjust &adjust = {}, QSize size = {1400, 900})
    {
        m_window = newWindow(size);
        return openAndSettle(*m_window, writeFile(m_folder, QStringLiteral("scene.json"), scene), adjust);
    }

    QString path(const QString &name) const { return m_folder.filePath(name); }
    Document &document() const { return m_window->document(); }
    Viewport &viewport() const { return document().viewport(); }
    WaterfallView &input() const { return *m_window->workbench().input(); }
    WaterfallView &output() const { return *m_window->workbench().output(); }

    QTemporaryDir m_folder;
    std::unique_ptr<MainWindow> m_window;
};

} // namespace faintline::test
