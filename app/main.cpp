// The window, and its subcommands that draw pictures without a screen.

#include "app/cli/addOpening.h"
#include "app/headless/pictureResults.h"
#include "app/headless/renderCommand.h"
#include "app/headless/replayPicture.h"
#include "app/headless/subcommands.h"
#include "app/window/MainWindow.h"
#include "app/window/programWindows.h"
#include "base/files/keepNoHoles.h"
#include "base/files/standardStreams.h"
#include "base/oneLine.h"
#include "widgets/base/icon.h"

#include <QApplication>
#include <QFile>
#include <QTemporaryFile>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace faintline {

namespace {

    /// Prints an error on one line, whatever its source.
    int fail(const std::string &where, const std::string &why, int exitCode)
    {
        std::fprintf(stderr, "error: %s\n", oneLine(where + ": " + why, longestMessage).c_str());
        return exitCode;
    }

    struct Screen {
        QSize size; ///< of the largest window
        double scale = 1.0;
    };

    /// A virtual screen for programs without one; the default of 800 × 800 would clip windows.
    std::unique_ptr<QTemporaryFile> use(const Screen &screen)
    {
        if (screen.scale != 1.0)
            qputenv("QT_SCALE_FACTOR", QByteArray::number(screen.scale));
        if (qEnvironmentVariableIsSet("QT_QPA_PLATFORM"))
            return {};
        auto file = std::make_unique<QTemporaryFile>();
        if (!file->open())
            throw Error("temporary folder", file->errorString().toStdString(), Error::Kind::Failure);
        file->write(
            QStringLiteral(R"({"synchronousWindowSystemEvents": false, "windowFrameMargins": false, "screens": [)"
                           R"({"name": "picture", "x": 0, "y": 0, "width": %1, "height": %2,)"
                           R"( "logicalDpi": 96, "logicalBaseDpi": 96, "dpr": 1}]})")
                .arg(std::lround(screen.size.width() * screen.scale))
                .arg(std::lround(screen.size.height() * screen.scale))
                .toLatin1());
        file->close();
        qputenv("QT_QPA_PLATFORM", "offscreen:configfile=" + QFile::encodeName(file->fileName()));
        return file;
    }

    /// Suppresses Qt's messages about the machine. If Qt fails fatally, the program ends with one line.
    void keepQuiet(QtMsgType type, const QMessageLogContext &, const QString &message)
    {
        if (type == QtFatalMsg)
            std::_Exit(fail("Qt", message.toStdString(), 1));
    }

    /// Message handler while looking for a display.
    void missScreen(QtMsgType type, const QMessageLogContext &, const QString &)
    {
        const auto value = [](const char *name) {
            return qEnvironmentVariableIsSet(name) ? " is \"" + qEnvironmentVariable(name).toStdString() + "\""
                                                   : std::string(" is not set");
        };
        if (type == QtFatalMsg)
            std::_Exit(fail("screen",
                            "no display is available for a window (DISPLAY" + value("DISPLAY") + ", WAYLAND_DISPLAY"
                                + value("WAYLAND_DISPLAY") + ", QT_QPA_PLATFORM" + value("QT_QPA_PLATFORM")
                                + "); 'faintline render' works "
                                  "without a display",
                            1));
    }

    /// Draws in a window that is not shown.
    template <class Options>
    int runRender(int argc, char *argv[], const Screen &wanted, const Options &options, void (*draw)(const Options &))
    {
        qInstallMessageHandler(keepQuiet);
        Theme::prepareForPictures();
        const auto screen = use(wanted);
        QApplication application(argc, argv);
        draw(options);
        return 0;
    }

    /// Redraws a picture on the same virtual screen as when it was made.
    int runReplay(int argc, char *argv[], const ReplayOptions &options)
    {
        if (isChart(options))
            return runRender(argc, argv, {RenderOptions().size}, options, replay);
        qInstallMessageHandler(keepQuiet);
        const QImage picture = pictureOf(options);
        return runRender(argc, argv, {picture.size(), scaleOf(picture)}, options, replay);
    }

    int runWindow(int argc, char *argv[], const std::vector<std::string> &files, const OpenOptions &options)
    {
        keepNoHoles(1 << 20); // returns the memory of temporary results of tuning
        Theme::prepareEnvironment();
        const QtMessageHandler before = qInstallMessageHandler(missScreen);
        QApplication application(argc, argv);
        qInstallMessageHandler(before);
        QApplication::setApplicationName(QStringLiteral("faintline"));
        QApplication::setApplicationDisplayName(QStringLiteral("Faintline"));
        QApplication::setWindowIcon(programIcon());
        const auto windows = programWindows(files, options);
        return QApplication::exec();
    }

    int run(int argc, char *argv[])
    {
        CLI::App program("Faintline: finds faint lines that drift and wander. Without a subcommand, opens the window.",
                         "faintline");
        program.set_version_flag("--version", "faintline " FAINTLINE_VERSION);
        std::vector<std::string> files;
        OpenOptions opening;
        program.add_option("file", files, "Recordings, scenarios (.json) or sessions (.faintline) to open");
        addOpening(program, opening);
        RenderOptions rendering;
        std::string size = "1600x1000";
        const CLI::App *renderCommand = addRender(program, rendering, size);
        RenderOptions reporting;
        const CLI::App *reportCommand = addReport(program, reporting);
        CheckOptions checking;
        const CLI::App *checkCommand = addCheckPictures(program, checking);
        ReplayOptions replaying;
        const CLI::App *replayCommand = addReplay(program, replaying);
        try {
            program.parse(argc, argv);
        } catch (const CLI::ParseError &error) {
            if (error.get_exit_code() == 0)
                return program.exit(error);
            return fail("command line", std::string(error.what()) + " (see faintline --help)", 2);
        }
        if (checkCommand->parsed()) {
            runCheckPictures(checking);
            return 0;
        }
        if (reportCommand->parsed())
            return runRender(argc, argv, {reporting.size}, reporting, report);
        if (replayCommand->parsed())
            return runReplay(argc, argv, replaying);
        if (!renderCommand->parsed())
            return runWindow(argc, argv, files, opening);
        checkNumbers(rendering);
        rendering.size = parseSize(size);
        return runRender(argc, argv, {rendering.size, rendering.scale}, rendering, render);
    }

} // namespace

} // namespace faintline

int main(int argc, char *argv[])
{
    faintline::openStandardStreams();
    try {
        const int code = faintline::run(argc, argv);
        if (code == 0 && !faintline::flushStandardOutput())
            return faintline::fail("standard output", "cannot be written; the output is incomplete", 1);
        return code;
    } catch (const faintline::Error &error) {
        return faintline::fail(error.where(), error.why(), error.kind() == faintline::Error::Kind::Mistake ? 2 : 1);
    } catch (const std::exception &error) {
        return faintline::fail("internal failure", error.what(), 1);
    }
}
