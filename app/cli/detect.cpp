#include "app/cli/commands.h"
#include "app/cli/inRange.h"
#include "app/cli/printSummary.h"
#include "app/cli/provenance.h"

#include "analyse/analyse.h"
#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "evaluate/comparison/trackScore.h"
#include "exchange/ModelFile.h"
#include "exchange/TopHits.h"
#include "exchange/annotateRecording.h"
#include "exchange/readAnnotations.h"
#include "exchange/writeEvents.h"
#include "exchange/writeReviewed.h"
#include "inspect/advice.h"
#include "inspect/judgeByBoxes.h"
#include "noise/noiseMean.h"
#include "noise/openFrames.h"
#include "scene/truthBeside.h"
#include "signal/formats/NumPy.h"
#include "signal/formats/SigmfRecording.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

namespace faintline::cli {

namespace {

    struct DetectOptions {
        AnalysisOptions analysis;
        std::string frames;
        std::string grid;
        std::string model;
        std::string events;
        std::string annotations;
        std::string tracks;
        std::string statistic;
        std::string conventional;
        std::string hits;
        double leastSnr = 0.0;
        bool annotate = false;
        bool json = false;
        bool summary = false;
    };

    /// The analysis as if the conventional detector had made it.
    Analysis conventionally(const Analysis &analysis)
    {
        if (analysis.grid().isSpectrum())
            throw Error("--conventional", "requires frames on several axes, such as sonar pings; for lines choose "
                                          "detector.kind = energy or pOfN");
        Analysis other = analysis;
        other.tracks = analysis.conventional;
        return other;
    }

    /// What was found of known targets.
    void printScore(const Analysis &analysis, const PingTruth &truth)
    {
        const std::vector<Axis> &axes = analysis.grid().axes;
        std::vector<Index> gate(axes.size(), 1);
        gate.front() = 3;
        const TrackScore score = scoreTracks(analysis.tracks, truth, analysis.grid(), gate);
        for (std::size_t i = 0; i < score.targets.size(); ++i) {
            const TargetScore &own = score.targets[i];
            std::printf("target %zu: ", i + 1);
            if (!own.isDetected()) {
                std::printf("not found\n");
                continue;
            }
            std::printf("detected in its ping %td, %s, %d track(s), RMS error %.2f range cells and %.2f beams",
                        own.detectLatency,
                        own.isConfirmed() ? ("confirmed in " + std::to_string(own.confirmLatency)).c_str()
                                          : "not confirmed",
                        own.tracks, own.rmsCells[0], own.rmsCells[1]);
            for (std::size_t axis = 2; axis < axes.size(); ++axis)
                std::printf(", %.2f cells of %s", own.rmsCells[axis], oneLine(axes[axis].name).c_str());
            std::printf(", followed in %td of %td pings\n", own.matchedPoints, own.presentPings);
        }
        std::printf("false tracks: %d, of them confirmed: %d\n", score.falseTracks, score.falseConfirmed);
    }

    /// The model of a file, with its law of resets in the settings.
    MarkovModel modelFor(const std::string &path, const NormalisedFrames &frames, AnalysisSettings &settings)
    {
        const ModelFile file = readModelFile(path);
        for (const KinematicAxis &axis : file.model.space.axes())
            if (axis.isPlaceDependent())
                throw Error(path,
                            "has an axis whose law differs from cell to cell; trackers need one law for the whole "
                            "axis, \"rates\" or a list of \"step\" probabilities");
        if (file.model.space.cellCount() != frames.grid().size())
            throw Error(path, "has " + std::to_string(file.model.space.cellCount()) + " cells, but the frames have "
                                  + std::to_string(frames.grid().size()));
        auto &smd = std::get<SmdSettings>(settings.detector);
        smd.lnK = file.reset.lnK;
        smd.reset = file.reset.law == ResetLaw::Mean   ? SmdSettings::Reset::Mean
                    : file.reset.law == ResetLaw::Half ? SmdSettings::Reset::Half
                                                       : SmdSettings::Reset::Fixed;
        return file.model;
    }

    /// The files that are asked for.
    std::vector<std::string> outputsOf(const DetectOptions &options)
    {
        return {options.events, options.tracks, options.statistic, options.conventional, options.hits};
    }

    /// Adding to an input is no output: it could not be remade from that input.
    void checkAnnotate(const DetectOptions &options, const Common &common)
    {
        const Source source = options.analysis.source();
        if (!SigmfRecording::isNamedSo(source.path) || !source.options.rawType.empty() || !source.hasSamples())
            throw Error("--annotate", "requires a SigMF recording; for others, write the events with --events");
        if (common.written || !std::ranges::all_of(outputsOf(options), &std::string::empty))
            throw Error("--annotate", "changes the recording's metadata, from which other outputs would be made; give "
                                      "no other output");
        const AtomicFile probe(SigmfRecording::metaPath(source.path), Durability::Program, Written::Document);
    }

    /// Whether the events are written with their reviews, as the window does.
    bool writesReviews(const DetectOptions &options)
    {
        return !options.annotations.empty() || isSessionPath(options.analysis.file);
    }

    void checkOptions(const DetectOptions &options)
    {
        options.analysis.checkMore();
        if (!options.annotations.empty() && options.events.empty() && !options.annotate && !options.json)
            throw Error("--annotations", "requires --events, --json or --annotate");
        if (options.json && options.summary)
            throw Error("--json", "prints the events in place of the summary; give one of --json and --summary");
        if (!options.events.empty())
            writesReviews(options) ? checkReviewedPath(options.events) : checkEventsPath(options.events);
        if (!options.tracks.empty())
            checkTracksPath(options.tracks);
        if (!options.conventional.empty())
            checkEventsPath(options.conventional);
        if (!options.hits.empty() && !options.hits.ends_with(".dat"))
            throw Error(options.hits, "the file name must end in .dat");
        if (options.leastSnr > 0.0 && options.hits.empty())
            throw Error("--least-snr", "requires --hits");
        checkOutputs(outputsOf(options));
        if (!options.frames.empty() && !options.analysis.file.empty())
            throw Error("detect", "accepts either a recording or --frames");
    }

    /// What is looked through: a recording, or frames that are ready for the detector.
    struct DetectInput {
        AnalysisSettings settings;
        OpenedSource opened;
        Annotations reviewed;            ///< in a session
        std::vector<Annotation> boxes{}; ///< that are given as annotations
    };

    /// What a table of hits says of where they come from.
    Observation observationOf(const DetectInput &input, const DetectOptions &options)
    {
        Observation observation;
        const std::string path = options.analysis.source().path;
        observation.name = std::filesystem::path(path).filename().string();
        if (input.opened.recording) {
            observation.startUnixSeconds = input.opened.recording->info().startUnixSeconds;
            observation.centreHz = input.opened.recording->info().centreHz;
        } else if (const auto power = path.empty() ? nullptr : openPower(path)) {
            observation.startUnixSeconds = power->info().startUnixSeconds;
        }
        return observation;
    }

    DetectInput open(const DetectOptions &options, const Common &common, const RunContext &context)
    {
        DetectInput input;
        input.settings = options.analysis.settings();
        if (const std::optional<Session> session = options.analysis.namedSession())
            input.reviewed = session->annotations;
        if (options.frames.empty() && options.analysis.file.empty())
            throw Error("detect", "needs a recording, or --frames with ready-made frames");
        if (options.frames.empty()) {
            input.opened = options.analysis.opened(input.settings, context);
        } else {
            input.opened = openStack(options.frames, options.grid, input.settings.pings, context);
            tellGuess(*input.opened.frames, options.frames, common);
            input.opened.pingTruth = pingTruthBeside(options.frames, input.opened.frames->grid());
        }
        if (options.annotations.empty())
            return input;
        if (input.opened.frames && !input.opened.frames->grid().isSpectrum())
            throw Error("--annotations", "requires frames on frequency only; these frames have more than one axis");
        AnnotatedRecording of(input.opened.recording ? input.opened.recording->info() : RecordingInfo());
        if (options.analysis.asTimeline)
            of.files = options.analysis.names();
        std::vector<std::string> notes;
        input.boxes = readAnnotations(options.annotations, of, &notes);
        for (const std::string &note : notes)
            tellNote(oneLine(note), common);
        return input;
    }

    /// Frames, then the cells of each axis.
    std::vector<Index> shapeOf(const NormalisedFrames &frames)
    {
        std::vector<Index> shape{frames.time().count};
        for (const Axis &axis : frames.grid().axes)
            shape.push_back(axis.count);
        return shape;
    }

    /// `writer`: where the statistic goes, if it is asked for.
    std::shared_ptr<const Analysis> run(const DetectInput &input, const DetectOptions &options,
                                        const RunContext &context, std::optional<NumPyWriter> &writer)
    {
        AnalysisSettings settings = input.settings;
        AnalysisRequest request{.depth = AnalysisDepth::Tracks};
        if (!options.model.empty() && !input.opened.frames)
            throw Error("--model", "requires ready-made frames; a recording's model is in its settings");
        if (!options.model.empty())
            request.model = modelFor(options.model, *input.opened.frames, settings);
        if (!options.statistic.empty()) {
            request.statisticBegins = [&](const NormalisedFrames &frames) {
                writer.emplace(options.statistic, shapeOf(frames));
            };
            request.statistic = [&](Index, std::span<const float> values) { writer->write(values); };
        }
        return options.analysis.numbered(analyse(input.opened, settings, request, context));
    }

    void annotate(const std::string &sigmf, const DetectOptions &options)
    {
        const std::string path = options.analysis.source().path;
        const int count = annotateRecording(path, sigmf);
        if (options.summary)
            std::printf("%d annotation(s) added to %s\n", count, oneLine(SigmfRecording::metaPath(path)).c_str());
    }

    /// The session's, then those of the annotations.
    Annotations reviewsOf(const Analysis &analysis, const std::vector<Event> &found, const DetectInput &input,
                          const DetectOptions &options)
    {
        Annotations reviewed = input.reviewed;
        if (options.annotations.empty())
            return reviewed;
        const JudgedByBoxes judged = judgeByBoxes(std::move(reviewed.reviews), analysis, found, input.boxes);
        reviewed.reviews = judged.reviews;
        if (options.summary)
            std::printf("%zu annotation(s), %d event(s) reviewed by them\n", input.boxes.size(), judged.judged);
        return reviewed;
    }

    void writeEventsOf(const Analysis &analysis, const DetectInput &input, const DetectOptions &options)
    {
        if (!writesReviews(options) && options.annotate)
            return annotate(eventsSigmf(analysis), options);
        if (!writesReviews(options))
            return writeEvents(analysis, options.events);
        const std::vector<Event> found = events(analysis);
        const Annotations reviewed = reviewsOf(analysis, found, input, options);
        if (options.annotate)
            return annotate(reviewedSigmf(analysis, found, reviewed), options);
        writeReviewed(analysis, found, reviewed, options.events);
    }

    /// What a file .json of --events would contain.
    void printEventsJson(const Analysis &analysis, const DetectInput &input, const DetectOptions &options)
    {
        const std::vector<Event> found = events(analysis);
        const std::string text = writesReviews(options)
                                     ? reviewedJson(analysis, found, reviewsOf(analysis, found, input, options))
                                     : eventsJson(analysis, found, areaEvents(analysis));
        std::fputs(text.c_str(), stdout);
    }

    void write(const Analysis &analysis, const DetectInput &input, const DetectOptions &options, const Common &common,
               std::optional<NumPyWriter> &writer)
    {
        std::vector<std::string> inputs = options.analysis.inputs();
        inputs.insert(inputs.end(), {options.frames, options.grid, options.model, options.annotations});
        CommitTogether files;
        writeProvenance(common, inputs, outputsOf(options));
        if (!options.events.empty() || options.annotate)
            writeEventsOf(analysis, input, options);
        if (!options.tracks.empty())
            writeTracks(analysis, options.tracks);
        if (!options.conventional.empty())
            writeEvents(conventionally(analysis), options.conventional);
        if (!options.hits.empty())
            writeTextFile(options.hits,
                          topHitsText(topHits(analysis, observationOf(input, options), options.leastSnr)));
        if (writer)
            writer->finish();
        files.commit();
    }

    /// As `info` words them. Only recordings with samples that are not finite are read again, to count these.
    std::vector<std::string> notesOn(const DetectInput &input, const DetectOptions &options)
    {
        const RecordingPointer &recording = input.opened.recording;
        if (recording)
            return recording->nonFiniteCount() > 0 ? notesOf(*recording) : recording->info().notes;
        const auto power = input.opened.isPower ? openPower(options.analysis.source().path) : nullptr;
        return power ? power->info().notes : std::vector<std::string>();
    }

    void tell(const std::vector<std::string> &notes, const DetectOptions &options, const Common &common)
    {
        for (const std::string &note : notes)
            tellNote(oneLine(options.analysis.source().path) + ": " + oneLine(note), common);
    }

    void printResult(const Analysis &analysis, const DetectInput &input, const std::vector<std::string> &notes,
                     bool areFramesGiven)
    {
        printSummary(analysis, notes);
        if (areFramesGiven)
            if (const std::string warning = noiseMeanWarning(*input.opened.frames); !warning.empty())
                std::printf("%s\n", warning.c_str());
        if (!input.opened.pingTruth.targets.empty())
            printScore(analysis, input.opened.pingTruth);
        if (analysis.grid().isSpectrum())
            return;
        std::printf("conventional detector: %zu track(s)\n", analysis.conventional.size());
        if (!input.opened.pingTruth.targets.empty())
            printScore(conventionally(analysis), input.opened.pingTruth);
    }

    void detect(DetectOptions options, const Common &common)
    {
        if (std::ranges::all_of(outputsOf(options), &std::string::empty) && !options.annotate && !options.json)
            options.summary = true; // without another output, print a summary
        checkOptions(options);
        const RunContext context = common.context();
        if (options.annotate)
            checkAnnotate(options, common);
        const DetectInput input = open(options, common, context);
        std::optional<NumPyWriter> writer;
        const auto analysis = run(input, options, context, writer);
        context.checkpoint(1.0, "done");
        write(*analysis, input, options, common, writer);
        if (options.json)
            printEventsJson(*analysis, input, options);
        std::vector<std::string> notes = notesOn(input, options);
        if (options.summary)
            return printResult(*analysis, input, notes, !options.frames.empty());
        if (const std::optional<Advice> silence = adviceOnSilence(*analysis, context))
            notes.push_back(silence->sentence);
        tell(notes, options, common);
    }

} // namespace

void addDetect(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<DetectOptions>();
    CLI::App *command = app.add_subcommand("detect", "Find lines in a recording, or signals in ready-made frames");
    options->analysis.addTo(*command, common);
    command->get_option("FILE")->required(false);
    options->analysis.addMoreTo(*command, common);
    addInput(*command, common, "--frames", options->frames,
             "Ready-made normalised frames, .npy of shape (frames, cells…), noise mean 1");
    addInput(*command, common, "--grid", options->grid, "JSON that describes the axes of the frames");
    addInput(*command, common, "--model", options->model, "JSON of a model for the frames");
    addOutput(*command, common, "--events", options->events,
              "Write the events: .csv, .json, .txt (Audacity) or .sigmf-meta");
    command->add_flag(
        "--annotate", options->annotate,
        "Add the events to the annotations in a SigMF recording's own metadata, in which all else is kept");
    addInput(
        *command, common, "--annotations", options->annotations,
        "Boxes with reviews (Raven, Audacity, SigMF, CSV, JSON); events that match a box are written with its review "
        "and note");
    addOutput(*command, common, "--tracks", options->tracks, "Write the tracks: .csv or .json");
    addOutput(*command, common, "--conventional", options->conventional,
              "For pings, also write the events of the conventional detector (threshold per ping, then M of "
              "N in a gate), like --events");
    addOutput(*command, common, "--statistic", options->statistic,
              "Write the statistic: .npy, float32, shape (frames, cells…)");
    addOutput(*command, common, "--hits", options->hits,
              "Write a table of drifting signals in turboSETI's columns: .dat");
    command->add_option("--least-snr", options->leastSnr, "The smallest SNR of such a table")
        ->check(inRange(0.0, 1e12));
    command->add_flag("--json", options->json, "Print the events as JSON, as --events writes them");
    command->add_flag("--summary", options->summary, "Print a summary of the result; default if no output is written");
    command->callback([options, &common] { detect(*options, common); });
}

} // namespace faintline::cli
