// The window, and its subcommands that draw pictures without a screen.

#include "app/cli/inRange.h"
#include "app/render/comparePictures.h"
#include "app/render/renderCommand.h"
#include "app/render/replayPicture.h"
#include "app/window/MainWindow.h"
#include "app/window/programWindows.h"
#include "base/keepNoHoles.h"
#include "base/oneLine.h"
#include "base/standardStreams.h"
#include "widgets/base/icon.h"

#include <CLI/CLI.hpp>

#include <QApplication>
#include <QFile>
#include <QTemporaryFile>

#include <algorithm>
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

    QSize parseSize(const std::string &text)
    {
        constexpr int smallest = 100;
        constexpr int largest = 16384;
        int width = 0;
        int height = 0;
        char rest = 0;
        if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || std::min(width, height) < smallest
            || std::max(width, height) > largest)
            throw Error("--size " + text, "must be WIDTHxHEIGHT in pixels, each 100 … 16384, such as 1600x1000");
        return {width, height};
    }

    void addOpening(CLI::App &command, OpenOptions &options)
    {
        command.add_flag("--iq", options.iq, "Treat two channels as I and Q");
        command.add_option("--raw-type", options.rawType, "Type of raw samples: ci16_le, cf32, cu8 …");
        command.add_option("--raw-rate", options.rawRateHz, "Sample rate of raw samples, Hz")->check(isRawRate());
        command.add_option("--raw-channels", options.rawChannels, "Channels of raw samples")->check(isRawChannels());
        command.add_option("--raw-header", options.rawHeaderBytes, "Bytes before the first raw sample");
    }

    CLI::App *addRender(CLI::App &program, RenderOptions &options, std::string &size)
    {
        CLI::App *command = program.add_subcommand("render", "Write a picture of the window or of one of its views");
        command
            ->add_option("source", options.source,
                         "Recording, scenario, lesson or experiment (.json) or session (.faintline)")
            ->required();
        command->add_option("--out", options.out, "Picture to write (.png); with several views, each name is appended")
            ->required();
        command
            ->add_option(
                "--view", options.views,
                "window, input, output, threshold, events, noise, noisefit, spectrum, channels, doppler, pd, "
                "why, compare, sweep, "
                "sequential, walk, posterior; for sonar pings also map, polar, histories, slice, latency, targets; for "
                "radar scans stopping, scan, asn, prior, sectors; separate several by commas")
            ->delimiter(',')
            ->allow_extra_args(false)
            ->capture_default_str();
        command->add_option("--size", size, "Pixels")->capture_default_str();
        command
            ->add_option("--scale", options.scale,
                         "Device pixels per pixel, as on a high-resolution screen, such as 1.25 or 2; the picture is "
                         "drawn at that resolution")
            ->check(inRange(1.0, 4.0))
            ->capture_default_str();
        command->add_option("--time", options.seconds, "Time of the cursor, s");
        command->add_option("--frequency", options.hz, "Frequency of the cursor, Hz");
        command->add_option("--range", options.range, "Range of the cursor in pings, in the unit of the range axis");
        command->add_option("--bearing", options.bearing, "Bearing of the cursor in pings, degrees");
        command
            ->add_option("--layer", options.layer,
                         "Layer of the output: statistic, rate, bearing-rate (pings only), age, reset, inhibited or "
                         "presence (lines only)")
            ->capture_default_str();
        command->add_flag("--overlay", options.isLayerOver,
                          "Draw the layer over the statistic instead of in its place");
        command->add_option("--theme", options.theme, "light, dark or contrast")
            ->check(CLI::IsMember({"light", "dark", "contrast"}))
            ->capture_default_str();
        command->add_option("--preset", options.preset, "Preset to start from");
        command->add_option("--set", options.settings, "A setting, name=value; may be repeated")
            ->allow_extra_args(false);
        command->add_option("--preset-a", options.presetA, "Preset from which A of a comparison starts");
        command->add_option("--set-a", options.settingsA, "A setting of A of a comparison, name=value; may be repeated")
            ->allow_extra_args(false);
        command->add_option("--channel", options.channel, "Channel, counted from 0");
        options.part.addTo(*command);
        command->add_option("--step", options.step, "Step of a lesson (.json with steps) to show, counted from 1");
        addOpening(*command, options.opening);
        return command;
    }

    CLI::App *addReport(CLI::App &program, RenderOptions &options)
    {
        CLI::App *command = program.add_subcommand("report", "Write one HTML page: pictures, events, reviews, "
                                                             "calibration, path breakdowns, provenance");
        command->add_option("source", options.source, "Recording, scenario (.json) or session (.faintline)")
            ->required();
        command->add_option("--out", options.out, "The page (.html)")->required();
        command->add_option("--preset", options.preset, "Preset to start from");
        command->add_option("--set", options.settings, "A setting, name=value; may be repeated")
            ->allow_extra_args(false);
        command->add_option("--channel", options.channel, "Channel, counted from 0");
        options.part.addTo(*command);
        addOpening(*command, options.opening);
        return command;
    }

    CLI::App *addReplay(CLI::App &program, ReplayOptions &options)
    {
        CLI::App *command = program.add_subcommand(
            "replay",
            "Reproduce a picture from its provenance and compare the pixels, or reproduce the table of a sequential "
            "test's chart");
        command
            ->add_option("PICTURE", options.picture,
                         "A PNG that render wrote, or a .csv of the sequential test on scans (use faintline-cli replay "
                         "for other tables)")
            ->required();
        command->add_option("--recording", options.recording, "Recording, if it is not beside the picture");
        return command;
    }

    CLI::App *addCheckPictures(CLI::App &program, CheckOptions &options)
    {
        CLI::App *command = program.add_subcommand("check-pictures", "Compare pictures pixel for pixel; exit code 1 if "
                                                                     "any differs");
        command->add_option("EXPECTED", options.expected, "A PNG, or a folder of them")->required();
        command->add_option("ACTUAL", options.actual, "A PNG, or a folder of them")->required();
        command->add_option("--out", options.out,
                            "Folder for the expected, actual and difference pictures of each "
                            "mismatch, and index.html");
        command->add_flag("--tolerate-rasters", options.toleratesRasters,
                          "Tolerate 1e-5 of the pixels at the adjacent "
                          "colour of a colour map");
        return command;
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

    /// Rejects "nan" and "inf", which no range check catches.
    void checkNumbers(const RenderOptions &options)
    {
        const std::pair<const char *, std::optional<double>> numbers[] = {{"--scale", options.scale},
                                                                          {"--time", options.seconds},
                                                                          {"--frequency", options.hz},
                                                                          {"--range", options.range},
                                                                          {"--bearing", options.bearing}};
        for (const auto &[name, number] : numbers)
            if (number && !std::isfinite(*number))
                throw Error(name, "must be a finite number");
    }

    /// Draws in a window that is not shown.
    template <class Options>
    int runRender(int argc, char *argv[], const Screen &wanted, const Options &options, void (*draw)(const Options &))
    {
        qInstallMessageHandler(keepQuiet);
        Theme::prepareEnvironment();
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
