#include "app/cli/commands.h"
#include "app/cli/provenance.h"

#include "analysis/chooseWindow.h"
#include "analysis/straighten.h"
#include "base/AtomicFile.h"
#include "base/Field.h"
#include "recording/writeRecording.h"
#include "spectrum/StraightenedRecording.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

namespace faintline::cli {

namespace {

    struct StraightenOptions {
        AnalysisOptions analysis;
        int event = 0;
        double smooth = 0.0;
        std::optional<double> target;
        std::string out;
        std::string curve;
        std::string type = "float32";
    };

    /// The track of an event; of event 0 the one with the largest statistic.
    const Track &trackOf(const Analysis &analysis, int event)
    {
        const std::vector<Track> &tracks = analysis.tracks;
        if (tracks.empty())
            throw Error("no event found", "nothing to straighten along; lower the threshold, for instance --set "
                                          "decide.falseAlarmsPerHour=10");
        if (event == 0)
            return *std::max_element(tracks.begin(), tracks.end(), [&](const Track &a, const Track &b) {
                return statisticOf(a, analysis) < statisticOf(b, analysis);
            });
        const auto found =
            std::find_if(tracks.begin(), tracks.end(), [event](const Track &track) { return track.id == event; });
        if (found == tracks.end())
            throw Error("--event " + std::to_string(event),
                        "no such event; found were 1 … " + std::to_string(tracks.size()));
        return *found;
    }

    std::string toCsv(const FrequencyCurve &curve)
    {
        std::string text = "t,f\n";
        for (std::size_t i = 0; i < curve.hz().size(); ++i)
            text += formatNumber(curve.time().value(static_cast<double>(i))) + "," + formatNumber(curve.hz()[i]) + "\n";
        return text;
    }

    void printHeights(const Recording &before, const Recording &after, int channel, const Track &track,
                      const Analysis &analysis, const FrequencyCurve &curve, double toHz)
    {
        const double from = analysis.time().value(static_cast<double>(track.onsetFrame));
        const double to = analysis.time().value(static_cast<double>(track.endFrame));
        const auto [least, most] = std::minmax_element(curve.hz().begin(), curve.hz().end());
        constexpr double leastCells = 40.0;
        const double half = std::max(2.0 * (*most - *least), leastCells / (to - from));
        const LineHeight was = heightInOneTransform(before, channel, from, to, 0.5 * (*least + *most), half);
        const LineHeight is = heightInOneTransform(after, 0, from, to, toHz, half);
        std::printf("one spectrum of its %.6g s: %.1f dB over its surroundings before, %.1f dB after\n", to - from,
                    was.db, is.db);
    }

    void straighten(const StraightenOptions &options, const Common &common)
    {
        checkOutputs({options.out, options.curve});
        const RunContext context = common.context();
        const RecordingPointer recording = options.analysis.recording();
        const auto analysis = analyseInChosenWindow(recording, options.analysis.settings(), context.part(0.0, 0.7));
        const Track &track = trackOf(*analysis, options.event);
        const FrequencyCurve curve = smoothFrequency(*analysis, track, options.smooth);
        const double toHz = options.target.value_or(curve.meanHz());
        const int channel = analysis->settings.selection.channel;
        const StraightenedRecording straight(recording, channel, curve, toHz);
        CommitTogether files;
        writeProvenance(common, options.analysis.inputs(), {options.out, options.curve});
        writeRecording(straight, options.out, options.type == "int16" ? WrittenType::Int16 : WrittenType::Float32,
                       context.part(0.7, 1.0));
        if (!options.curve.empty())
            writeTextFile(options.curve, toCsv(curve));
        files.commit();
        const auto [least, most] = std::minmax_element(curve.hz().begin(), curve.hz().end());
        std::printf("event %d of %zu, %.6g … %.6g s, %.8g … %.8g Hz: now at %.8g Hz\n", track.id,
                    analysis->tracks.size(), analysis->time().value(static_cast<double>(track.onsetFrame)),
                    analysis->time().value(static_cast<double>(track.endFrame)), *least, *most, toHz);
        printHeights(*recording, straight, channel, track, *analysis, curve, toHz);
    }

} // namespace

void addStraighten(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<StraightenOptions>();
    CLI::App *command =
        app.add_subcommand("straighten", "Shift a recording so that a detected line stays at one frequency");
    options->analysis.addTo(*command, common);
    command
        ->add_option("--event", options->event,
                     "Number of the event to straighten along; by default the one with the largest statistic")
        ->check(CLI::Range(1, 2147483647));
    command
        ->add_option("--smooth", options->smooth,
                     "Period, s, of a wander of the track that is halved by smoothing; by default 32 frames")
        ->check(CLI::PositiveNumber);
    command->add_option("--target", options->target,
                        "Frequency of the straightened line, Hz; by default the track's mean");
    command->add_option("--type", options->type, "Sample type")
        ->check(CLI::IsMember({"float32", "int16"}))
        ->capture_default_str();
    addOutput(*command, common, "--out", options->out, "Recording to write")->required();
    addOutput(*command, common, "--curve", options->curve, "Write the smooth frequency over time, .csv");
    command->callback([options, &common] { straighten(*options, common); });
}

} // namespace faintline::cli
