#include "app/headless/subcommands.h"

#include "app/cli/addOpening.h"
#include "app/cli/inRange.h"
#include "app/views/WindowViews.h"
#include "base/Error.h"

#include <QStringList>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace faintline {

namespace {

    /// The views of a kind of source, separated by commas.
    std::string viewNames(WindowView::Of of)
    {
        QStringList names;
        for (const WindowView &view : windowViews())
            if (view.of == of)
                names << view.name;
        return names.join(QStringLiteral(", ")).toStdString();
    }

} // namespace

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
        ->add_option("--view", options.views,
                     "One of: " + viewNames(WindowView::Of::Recording) + "; of sonar pings: "
                         + viewNames(WindowView::Of::Pings) + "; of radar scans: " + viewNames(WindowView::Of::Scans)
                         + "; of the results of a survey: " + viewNames(WindowView::Of::Survey)
                         + "; separate several by commas")
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
        ->add_option("--axes", options.axes,
                     "Names of the two axes shown, of scans on more than two axes, separated by a comma, such as "
                     "range,Doppler; by default the first two")
        ->delimiter(',')
        ->expected(2)
        ->allow_extra_args(false);
    command->add_flag("--slice", options.isSliced, "Cut the other axes at the cursor instead of showing their maxima");
    command
        ->add_option("--position", options.position,
                     "Position of the cursor in pings or scans: one number for each axis, in its unit, separated by "
                     "commas")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--layer", options.layer,
                     "Layer of the output: statistic, rate, bearing-rate (pings only), age, reset, inhibited or "
                     "presence (lines only)")
        ->capture_default_str();
    command->add_flag("--overlay", options.isLayerOver, "Draw the layer over the statistic instead of in its place");
    command->add_option("--theme", options.theme, "light, dark or contrast")
        ->check(CLI::IsMember({"light", "dark", "contrast"}))
        ->capture_default_str();
    command->add_option("--preset", options.preset, "Preset to start from");
    command->add_option("--set", options.settings, "A setting, name=value; may be repeated")->allow_extra_args(false);
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
    command->add_option("source", options.source, "Recording, scenario (.json) or session (.faintline)")->required();
    command->add_option("--out", options.out, "The page (.html)")->required();
    command->add_option("--preset", options.preset, "Preset to start from");
    command->add_option("--set", options.settings, "A setting, name=value; may be repeated")->allow_extra_args(false);
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
    command->add_option("--junit", options.junit,
                        "Write the results as JUnit XML, a test case for each picture (.xml)");
    command->add_flag("--json", options.isJson, "Print the results as JSON");
    return command;
}

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
    for (const double number : options.position)
        if (!std::isfinite(number))
            throw Error("--position", "must consist of finite numbers");
}

} // namespace faintline
