#include "app/cli/commands.h"
#include "app/cli/inRange.h"
#include "app/cli/printSummary.h"
#include "app/cli/provenance.h"

#include "analyse/analyse.h"
#include "analyse/events.h"
#include "base/Field.h"
#include "base/files/AtomicFile.h"
#include "inspect/straighten.h"
#include "refine/subtractLines.h"
#include "signal/formats/writeRecording.h"

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
        std::string method;
        std::string out;
        std::string curve;
        std::string rest;
        std::string type = "float32";
    };

    std::string toCsv(const FrequencyCurve &curve)
    {
        std::string text = "t,f\n";
        for (std::size_t i = 0; i < curve.hz().size(); ++i)
            text += formatNumber(curve.time().value(double(i))) + "," + formatNumber(curve.hz()[i]) + "\n";
        return text;
    }

    /// Level of the line above its surroundings in one spectrum of its duration, before and after.
    std::string heights(const Recording &before, const Straightened &straight, const RunContext &context)
    {
        const double was = lineHeight(before, straight.before, context.part(0.0, 0.4)).db;
        const double is = lineHeight(*straight.recording, straight.after, context.part(0.4, 1.0)).db;
        if (!std::isfinite(was) || !std::isfinite(is))
            return "its surroundings are silent";
        char text[160];
        std::snprintf(text, sizeof text,
                      "in one spectrum of its %.6g s %.1f dB over its surroundings before, %.1f dB after",
                      straight.before.toSeconds - straight.before.fromSeconds, was, is);
        return text;
    }

    /// The recording without the event's line, fitted in amplitude and phase in each channel.
    RecordingPointer withoutEvent(const RecordingPointer &recording, const Analysis &analysis, int id,
                                  const RunContext &context)
    {
        const std::vector<LinePath> paths = pathsOf(analysis, {*trackOfId(analysis.tracks, id)});
        const int channels = recording->info().channelCount;
        RecordingPointer rest = recording;
        for (int channel = 0; channel < channels; ++channel)
            rest = std::make_shared<ResidualRecording>(
                rest, channel, paths, nullptr,
                context.part(double(channel) / channels, double(channel + 1) / channels));
        return rest;
    }

    void straighten(const StraightenOptions &options, const Common &common)
    {
        for (const std::string &name : {options.out, options.rest})
            if (!name.empty())
                checkRecordingName(name);
        checkOutputs({options.out, options.curve, options.rest});
        const RunContext context = common.context();
        const RecordingPointer recording = options.analysis.recording();
        const auto analysis =
            options.analysis.numbered(analyse(recording, options.analysis.settings(), {}, context.part(0.0, 0.6)));
        const Event event = chosenEvent(*analysis, options.event);
        StraightenChoice choice{options.smooth, options.target, {}};
        if (!options.method.empty())
            choice.kind = straighteningOf(options.method);
        const Straightened straight = straightened(*analysis, event, choice);
        const FrequencyCurve &curve = straight.curve;
        const std::string told = heights(*recording, straight, context.part(0.6, 0.8));
        CommitTogether files;
        writeProvenance(common, options.analysis.inputs(), {options.out, options.curve, options.rest});
        const auto type = options.type == "int16" ? WrittenType::Int16 : WrittenType::Float32;
        writeRecording(*straight.recording, options.out, type, context.part(0.8, 0.9));
        if (!options.rest.empty())
            writeRecording(*withoutEvent(recording, *analysis, event.id, context.part(0.9, 0.95)), options.rest, type,
                           context.part(0.95, 1.0));
        if (!options.curve.empty())
            writeTextFile(options.curve, toCsv(curve));
        files.commit();
        const auto [least, most] = std::minmax_element(curve.hz().begin(), curve.hz().end());
        const Axis &axis = analysis->grid().axes.back();
        std::printf("event %d of %zu, %s … %s s, %s … %s Hz: %snow at %s Hz\n%s\n", event.id, analysis->tracks.size(),
                    secondsOf(event.onsetSeconds, analysis->time()).c_str(),
                    secondsOf(event.endSeconds, analysis->time()).c_str(), positionText(*least, axis).c_str(),
                    positionText(*most, axis).c_str(), straight.kind == Straightening::Resample ? "resampled, " : "",
                    positionText(straight.targetHz, axis).c_str(), told.c_str());
    }

} // namespace

void addStraighten(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<StraightenOptions>();
    CLI::App *command = app.add_subcommand(
        "straighten", "Shift or resample a recording so that a detected line stays at one frequency");
    options->analysis.addTo(*command, common);
    command
        ->add_option("--event", options->event,
                     "Number of the event to straighten along; by default the one with the largest statistic")
        ->check(inRange(1, 2147483647));
    command
        ->add_option("--smooth", options->smooth,
                     "Period, s, of a wander of the track that is halved by smoothing; by default 32 frames")
        ->check(inRange(1e-9, 1e9));
    command->add_option("--target", options->target,
                        "Frequency of the straightened line, Hz; by default the track's mean");
    command
        ->add_option("--method", options->method,
                     "Shift the band with the line, or resample along it, which makes all its multiples constant; by "
                     "default resample for family.relation=harmonics, else shift")
        ->check(CLI::IsMember({"shift", "resample"}));
    command->add_option("--type", options->type, "Sample type")
        ->check(CLI::IsMember({"float32", "int16"}))
        ->capture_default_str();
    addOutput(*command, common, "--out", options->out, "Recording to write")->required();
    addOutput(*command, common, "--rest", options->rest,
              "Also write the recording without the line, which is subtracted with its phase from every channel");
    addOutput(*command, common, "--curve", options->curve, "Write the smooth frequency over time, .csv");
    command->callback([options, &common] { straighten(*options, common); });
}

} // namespace faintline::cli
