#include "app/cli/commands.h"
#include "app/cli/provenance.h"

#include "analysis/advice.h"
#include "analysis/analyse.h"
#include "analysis/chooseWindow.h"
#include "analysis/explain.h"
#include "analysis/falseAlarmWords.h"
#include "analysis/judgeByBoxes.h"
#include "analysis/noiseLaw.h"
#include "analysis/regulation.h"
#include "base/AtomicFile.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "detect/SumDetector.h"
#include "detect/statisticDecimals.h"
#include "evaluate/comparison/trackScore.h"
#include "exchange/ModelFile.h"
#include "exchange/NumPy.h"
#include "exchange/readAnnotations.h"
#include "exchange/writeEvents.h"
#include "exchange/writeReviewed.h"
#include "spectrum/noiseMean.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
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
        bool summary = false;
    };

    /// The analysis as if the conventional detector had made it.
    Analysis conventionally(const Analysis &analysis)
    {
        if (analysis.grid().axes.size() < 2)
            throw Error("--conventional", "requires frames on several axes, such as sonar pings; for lines choose "
                                          "detector.kind = energy or pOfN");
        Analysis other = analysis;
        other.tracks = analysis.conventional;
        return other;
    }

    void printSummary(const Analysis &analysis)
    {
        const Axis &time = analysis.time();
        const std::vector<Event> found = events(analysis);
        std::printf("%td frames of %td cells, %s s per frame\n", time.count, analysis.grid().size(),
                    formatNumber(time.step).c_str());
        if (analysis.choice)
            std::printf("%s\n", windowChoiceWords(*analysis.choice).c_str());
        const DetectorSettings &detector = analysis.settings.detector;
        const std::string unit(statisticUnit(detector));
        std::printf("ln K %.4f (%.1f %% of noise states continued%s), threshold %.2f %s", analysis.calibration->lnK,
                    100.0 * analysis.calibration->continuedFraction,
                    isScoreOfPaths(detector) ? "" : ", of the detector that guides the tracks", analysis.threshold,
                    unit.c_str());
        const double perHour = analysis.calibration->eventRateAt(analysis.threshold) * analysis.cellFramesPerHour;
        std::printf(": %.3g false alarms per hour on noise, %s\n", perHour,
                    falseAlarmWords(perHour, analysis.calibration->rateUncertaintyAt(analysis.threshold)).c_str());
        if (const std::vector<Index> dragged = draggedFrames(analysis); !dragged.empty())
            std::printf("warning: ln K left its noise band %.3f … %.3f in %zu frame(s), the first at %.6g s; strong "
                        "signals lower it\n",
                        analysis.lnKBand.low(), analysis.lnKBand.high(), dragged.size(),
                        time.value(double(dragged.front())));
        if (const auto law = checkNoiseLaw(analysis); law && !law->isFollowed())
            std::printf("warning: %s\n", law->warning().c_str());
        for (const Advice &advice : advise(analysis))
            std::printf("note: %s%s%s\n", advice.sentence.c_str(), advice.remedy.empty() ? "" : "; ",
                        advice.remedy.c_str());
        std::printf("%zu event(s)\n", found.size());
        for (const Event &e : found) {
            std::printf("%5d  %.6g … %.6g s, detected at %.6g s, at", e.id, e.onsetSeconds, e.endSeconds,
                        e.detectSeconds);
            for (std::size_t axis = 0; axis < e.position.size(); ++axis)
                std::printf(" %.8g %s", e.position[axis], oneLine(analysis.grid().axes[axis].unit).c_str());
            for (std::size_t axis = 0; axis < e.position.size(); ++axis)
                std::printf(", %s%.3g %s/s", axis == 0 ? "drift " : "", e.ratesPerSecond[axis],
                            oneLine(analysis.grid().axes[axis].unit).c_str());
            std::printf(", %.*f %s%s%s%s", statisticDecimals(detector), e.statistic, unit.c_str(),
                        e.isConfirmed ? "" : ", not confirmed", e.isOpen ? ", present at the end" : "",
                        analysis.isBank() ? (e.model == 0 ? ", non-manoeuvring" : ", manoeuvring") : "");
            if (analysis.longer && trackOfId(analysis.tracks, e.id)->windowSeconds > 0.0)
                std::printf(", found with a window of %.4g s", e.windowSeconds);
            std::printf("\n");
        }
        if (!analysis.explainedByNoise.empty())
            std::printf("%zu path(s) above the threshold not reported: cells as strong are common in this recording's "
                        "noise\n",
                        analysis.explainedByNoise.size());
        const std::vector<AreaEvent> areas = areaEvents(analysis);
        if (areas.empty())
            return;
        std::printf("%zu area(s) of raised level without a line\n", areas.size());
        const std::string cellUnit = oneLine(analysis.grid().axes.back().unit);
        for (const AreaEvent &area : areas)
            std::printf("       %.6g … %.6g s, %.8g … %.8g %s, %.1f dB or more above the noise\n", area.onsetSeconds,
                        area.endSeconds, area.low, area.high, cellUnit.c_str(), area.levelDb);
    }

    /// Simulated pings know their targets: what was found of them.
    void printScore(const Analysis &analysis, const SimulatedPings &pings)
    {
        const TrackScore score = scoreTracks(analysis.tracks, pings.truth(), pings.grid(), {3, 1});
        for (std::size_t i = 0; i < score.targets.size(); ++i) {
            const TargetScore &own = score.targets[i];
            std::printf("target %zu: ", i + 1);
            if (!own.isDetected()) {
                std::printf("not found\n");
                continue;
            }
            std::printf("detected in its ping %td, %s, %d track(s), RMS error %.2f range cells and %.2f beams, "
                        "followed in %td of %td pings\n",
                        own.detectLatency,
                        own.isConfirmed() ? ("confirmed in " + std::to_string(own.confirmLatency)).c_str()
                                          : "not confirmed",
                        own.tracks, own.rmsCells[0], own.rmsCells[1], own.matchedPoints, own.presentPings);
        }
        std::printf("false tracks: %d, of them confirmed: %d\n", score.falseTracks, score.falseConfirmed);
    }

    std::shared_ptr<const Analysis> detectInFrames(const DetectOptions &options, const RunContext &context,
                                                   const StatisticSink &sink, const NormalisedFramesPointer &frames,
                                                   AnalysisSettings settings)
    {
        if (options.model.empty())
            return analyse(frames, settings, context, nullptr, sink);
        MarkovModel model;
        {
            const ModelFile file = readModelFile(options.model);
            model = file.model;
            for (const KinematicAxis &axis : model.space.axes())
                if (axis.isPlaceDependent())
                    throw Error(options.model, "has an axis whose law differs from cell to cell; trackers need one law "
                                               "for the whole axis, \"rates\" or a list of \"step\" probabilities");
            if (model.space.cellCount() != frames->grid().size())
                throw Error(options.model, "has " + std::to_string(model.space.cellCount())
                                               + " cells, but the frames have "
                                               + std::to_string(frames->grid().size()));
            auto &smd = std::get<SmdSettings>(settings.detector);
            smd.lnK = file.reset.lnK;
            smd.reset = file.reset.law == ResetLaw::Mean   ? SmdSettings::Reset::Mean
                        : file.reset.law == ResetLaw::Half ? SmdSettings::Reset::Half
                                                           : SmdSettings::Reset::Fixed;
        }
        return analyse(frames, model, settings, context, sink);
    }

    /// The events, each with what the annotations say of it.
    void writeJudged(const Analysis &analysis, const std::vector<Annotation> &boxes, const DetectOptions &options)
    {
        const std::vector<Event> found = events(analysis);
        const JudgedByBoxes judged = judgeByBoxes({}, analysis, found, boxes);
        writeReviewed(analysis, found, {judged.reviews, {}}, options.events);
        if (options.summary)
            std::printf("%zu annotation(s), %d event(s) reviewed by them\n", boxes.size(), judged.judged);
    }

    void detect(DetectOptions options, const Common &common)
    {
        if (options.events.empty() && options.tracks.empty() && options.statistic.empty()
            && options.conventional.empty())
            options.summary = true; // who asks for nothing else wants to know what there is
        if (!options.annotations.empty() && options.events.empty())
            throw Error("--annotations", "requires --events");
        if (!options.events.empty())
            options.annotations.empty() ? checkEventsPath(options.events) : checkReviewedPath(options.events);
        if (!options.tracks.empty())
            checkTracksPath(options.tracks);
        if (!options.conventional.empty())
            checkEventsPath(options.conventional);
        checkOutputs({options.events, options.tracks, options.statistic, options.conventional});
        if (!options.frames.empty() && !options.analysis.file.empty())
            throw Error("detect", "accepts either a recording or --frames");
        const RunContext context = common.context();
        std::optional<NumPyWriter> writer;
        NormalisedFramesPointer frames;
        RecordingPointer recording;
        std::vector<Index> shape;
        AnalysisSettings settings = options.analysis.settings();
        if (!options.frames.empty())
            frames = readFrames(options.frames, options.grid);
        else
            frames = options.analysis.frames(settings, context);
        if (frames) {
            shape.push_back(frames->time().count);
            for (const Axis &axis : frames->grid().axes)
                shape.push_back(axis.count);
        } else {
            if (options.analysis.file.empty())
                throw Error("detect", "needs a recording, or --frames with ready-made frames");
            recording = options.analysis.recording();
        }
        std::vector<Annotation> annotations;
        if (!options.annotations.empty()) {
            if (!recording && frames->grid().axes.size() != 1)
                throw Error("--annotations", "requires frames on frequency only; these frames have more than one axis");
            annotations = readAnnotations(options.annotations, recording ? recording->info() : RecordingInfo());
        }
        StatisticSink sink;
        std::shared_ptr<const Analysis> inChosenWindow;
        if (!options.statistic.empty()) {
            if (recording) {
                if (leavesWindowToRecording(settings)) {
                    inChosenWindow = analyseInChosenWindow(recording, settings, context.part(0.0, 0.7));
                    settings = inChosenWindow->settings;
                }
                const Spectrogram geometry(recording, settings.spectrogram, settings.selection);
                shape = {geometry.time().count, familyAxis(settings.family, geometry.frequency()).count};
            }
            writer.emplace(options.statistic, shape);
            sink = [&writer](Index, std::span<const float> values) { writer->write(values); };
        }
        std::shared_ptr<const Analysis> analysis;
        if (frames)
            analysis = detectInFrames(options, context, sink, frames, settings);
        else if (sink)
            analysis =
                analyse(recording, settings, context.part(inChosenWindow ? 0.7 : 0.0, 1.0), inChosenWindow.get(), sink);
        else
            analysis = analyseInChosenWindow(recording, settings, context);
        if (inChosenWindow)
            analysis = inChosenWindow; // its tracks are more than those of the statistic
        context.checkpoint(1.0, "done");
        std::vector<std::string> inputs = options.analysis.inputs();
        inputs.insert(inputs.end(), {options.frames, options.grid, options.model, options.annotations});
        CommitTogether files;
        writeProvenance(common, inputs, {options.events, options.tracks, options.statistic, options.conventional});
        if (!options.annotations.empty())
            writeJudged(*analysis, annotations, options);
        else if (!options.events.empty())
            writeEvents(*analysis, options.events);
        if (!options.tracks.empty())
            writeTracks(*analysis, options.tracks);
        if (!options.conventional.empty())
            writeEvents(conventionally(*analysis), options.conventional);
        if (writer)
            writer->finish();
        files.commit();
        if (options.summary)
            printSummary(*analysis);
        if (options.summary && recording && recording->nonFiniteCount() > 0)
            std::printf("some samples are not finite; they are read as 0\n");
        if (options.summary && !options.frames.empty())
            if (const std::string warning = noiseMeanWarning(*frames); !warning.empty())
                std::printf("%s\n", warning.c_str());
        if (const auto *pings = dynamic_cast<const SimulatedPings *>(frames.get()); pings && options.summary)
            printScore(*analysis, *pings);
        if (options.summary && analysis->grid().axes.size() > 1) {
            std::printf("conventional detector: %zu track(s)\n", analysis->conventional.size());
            if (const auto *pings = dynamic_cast<const SimulatedPings *>(frames.get()))
                printScore(conventionally(*analysis), *pings);
        }
    }

    constexpr const char *resetNames[]{"beginning", "background", "forgotten"};

    void printExplanation(const Explanation &explanation, const Analysis &analysis, bool asJson)
    {
        const StateSpace &space = analysis.modelAt(explanation.model).space;
        const std::vector<Axis> &axes = analysis.grid().axes;
        // What is held against the threshold: the path's score, or the statistic of a detector that has no paths, in
        // its own unit.
        const bool isScore = isScoreOfPaths(analysis.settings.detector);
        const double decided = isScore ? explanation.statistic : explanation.displayed;
        const std::string unit(statisticUnit(analysis.settings.detector));
        Json json;
        json["time"] = explanation.seconds;
        json["position"] = explanation.position;
        json["statistic"] = explanation.statistic;
        json["displayed"] = explanation.displayed;
        json["threshold"] = explanation.threshold;
        json["unit"] = unit;
        json["margin"] = decided - explanation.threshold;
        json["tracked"] = explanation.isTracked;
        json["explained_by_noise"] = explanation.isExplainedByNoise;
        json["offset"] = explanation.offset;
        json["reset"]["cause"] = resetNames[std::size_t(explanation.reset.kind)];
        json["reset"]["lost"] = explanation.reset.lost;
        if (explanation.reset.track > 0)
            json["reset"]["track"] = explanation.reset.track;
        if (explanation.otherState && std::isfinite(explanation.otherMargin))
            json["runner_up"] = {{"rates", space.ratesOfPlane(space.planeOf(*explanation.otherState))},
                                 {"margin", explanation.otherMargin}};
        if (analysis.isBank())
            json["model"] = explanation.model == 0 ? "nonManoeuvring" : "manoeuvring";
        json["steps"] = Json::array();
        for (const PathStep &step : explanation.steps) {
            const std::vector<Index> c = analysis.grid().coordinates(space.cellOf(step.state));
            std::vector<double> at;
            for (std::size_t axis = 0; axis < c.size(); ++axis)
                at.push_back(analysis.grid().axes[axis].value(double(c[axis])));
            json["steps"].push_back({{"t", analysis.time().value(double(step.frame))},
                                     {"position", at},
                                     {"rates", space.ratesOfPlane(space.planeOf(step.state))},
                                     {"llr", step.logLikelihoodRatio},
                                     {"ln_transition", step.lnTransition},
                                     {"lnK", step.lnK},
                                     {"sum", step.score}});
            if (std::isfinite(step.runnerUp))
                json["steps"].back()["runner_up_margin"] = step.runnerUp;
        }
        if (asJson) {
            std::printf("%s\n", json.dump(2, ' ', true).c_str());
            return;
        }
        std::printf("statistic %.4f %s, threshold %.4f %s: %s by %.4f %s%s\n", decided, unit.c_str(),
                    explanation.threshold, unit.c_str(), decided > explanation.threshold ? "above" : "below",
                    std::abs(decided - explanation.threshold), unit.c_str(),
                    explanation.isTracked ? ", followed by a tracker" : "");
        if (!isScore)
            std::printf(
                "a sequential Markov detector guides its tracks; the path of that detector has %.4f nat here:\n",
                explanation.statistic);
        if (explanation.isExplainedByNoise)
            std::printf("its path is not reported: cells as strong are common in this recording's noise\n");
        std::printf("the best path began %zu frame(s) ago, when it was reset\n", explanation.steps.size() - 1);
        if (axes.size() == 1)
            std::printf("%12s %14s %8s %10s %10s %10s %12s\n", "t (s)", "f", "rate", "llr", "ln P", "ln K", "sum");
        else {
            std::printf("%12s", "t (s)");
            for (const Axis &axis : axes)
                std::printf(" %14s %8s", oneLine(axis.name + " (" + axis.unit + ")").c_str(), "rate");
            std::printf(" %10s %10s %10s %12s\n", "llr", "ln P", "ln K", "sum");
        }
        for (const Json &step : json["steps"]) {
            std::printf("%12.6g", step["t"].get<double>());
            for (std::size_t axis = 0; axis < axes.size(); ++axis)
                std::printf(" %14.8g %8d", step["position"][axis].get<double>(), step["rates"][axis].get<int>());
            std::printf(" %10.4f %10.4f %10.4f %12.4f\n", step["llr"].get<double>(),
                        step["ln_transition"].get<double>(), step["lnK"].get<double>(), step["sum"].get<double>());
        }
        if (explanation.offset != 0.0)
            std::printf("and %.4f nat common to all states: K of the frame and the offset of the model\n",
                        explanation.offset);
    }

    struct StatisticOptions {
        std::string frames;
        std::string model;
        std::string out;
        std::string projected;
        std::string log;
    };

    void statistic(const StatisticOptions &options, const Common &common)
    {
        checkOutputs({options.out, options.projected, options.log});
        const NormalisedFramesPointer frames = readFrames(options.frames, "");
        const ModelFile file = readModelFile(options.model);
        const StateSpace &space = file.model.space;
        for (std::size_t axis = 0; axis < std::max(space.axes().size(), frames->grid().axes.size()); ++axis)
            if (space.axes().size() != frames->grid().axes.size()
                || space.axes()[axis].cells != frames->grid().axes[axis].count)
                throw Error(options.model, "the cells of its axes do not match the frames of " + options.frames);
        std::vector<Index> shape{frames->time().count};
        std::vector<Index> projectedShape = shape;
        for (const KinematicAxis &axis : space.axes())
            shape.push_back(axis.rateCount);
        for (const KinematicAxis &axis : space.axes()) {
            shape.push_back(axis.cells);
            projectedShape.push_back(axis.cells);
        }
        const std::unique_ptr<PathDetector> detector = makePathDetector(file);
        NumPyWriter out(options.out, shape);
        std::optional<NumPyWriter> projected;
        if (!options.projected.empty())
            projected.emplace(options.projected, projectedShape);
        std::string log = "frame,lnK,reset_fraction,max_statistic\n";
        const RunContext context = common.context();
        std::vector<float> y(std::size_t(space.cellCount()));
        std::vector<float> D(y.size());
        std::vector<float> scores;
        for (Index frame = 0; frame < frames->time().count; ++frame) {
            context.checkpoint(double(frame) / double(frames->time().count), "recursion");
            frames->read(frame, 1, y);
            detector->update(y, D);
            scores.assign(detector->scores().begin(), detector->scores().end());
            if (const auto offset = float(detector->offset()); offset != 0.0f)
                for (float &score : scores)
                    score += offset;
            out.write(scores);
            if (projected)
                projected->write(D);
            const PathDetector::Regulation regulation = detector->regulation();
            log += std::to_string(frame) + "," + formatNumber(regulation.lnK) + ","
                   + formatNumber(1.0 - regulation.continuedFraction) + ","
                   + formatNumber(double(*std::max_element(D.begin(), D.end()))) + "\n";
        }
        if (!options.log.empty())
            writeTextFile(options.log, log);
        out.finish();
        if (projected)
            projected->finish();
    }

} // namespace

void addDetect(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<DetectOptions>();
    CLI::App *command = app.add_subcommand("detect", "Find lines in a recording, or signals in ready-made frames");
    options->analysis.addTo(*command, common);
    command->get_option("FILE")->required(false);
    addInput(*command, common, "--frames", options->frames,
             "Ready-made normalised frames, .npy of shape (frames, cells…), noise mean 1");
    addInput(*command, common, "--grid", options->grid, "JSON that describes the axes of the frames");
    addInput(*command, common, "--model", options->model, "JSON of a model for the frames");
    addOutput(*command, common, "--events", options->events,
              "Write the events: .csv, .json, .txt (Audacity) or .sigmf-meta");
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
    command->add_flag("--summary", options->summary, "Print a summary of the result; default if no output is written");
    command->callback([options, &common] { detect(*options, common); });
}

void addStatistic(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<StatisticOptions>();
    CLI::App *command = app.add_subcommand("statistic", "Compute ln Λ of the recursion for every frame and state, "
                                                        "without decisions");
    addInput(*command, common, "--frames", options->frames, "Normalised frames, .npy of shape (frames, cells…)")
        ->required();
    addInput(*command, common, "--model", options->model, "JSON of the model")->required();
    addOutput(*command, common, "--out", options->out, "Write the statistic of all states, .npy")->required();
    addOutput(*command, common, "--projected", options->projected, "Write its maximum over the rates, .npy");
    addOutput(*command, common, "--log", options->log, "Write K and reset fraction per frame, .csv");
    command->callback([options, &common] { statistic(*options, common); });
}

void addExplain(CLI::App &app, Common &common)
{
    struct Options {
        AnalysisOptions analysis;
        double seconds = 0.0;
        std::optional<double> hz;
        std::optional<double> range;
        std::optional<double> bearing;
        std::string grid;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CLI::App *command = app.add_subcommand("explain", "Explain the statistic of a cell by the terms of the best path "
                                                      "that ends there");
    options->analysis.addTo(*command, common);
    command->add_option("--time", options->seconds, "Time, s")->required();
    command->add_option("--frequency", options->hz, "Frequency, Hz");
    command->add_option("--range", options->range, "For pings: range, in the unit of its axis");
    command->add_option("--bearing", options->bearing, "For pings: bearing, degrees");
    addInput(*command, common, "--grid", options->grid,
             "For a stack of frames (FILE.npy): JSON that describes its axes");
    command->add_flag("--json", options->json, "Print as JSON");
    command->callback([options, &common] {
        const RunContext context = common.context();
        AnalysisSettings settings = options->analysis.settings();
        const NormalisedFramesPointer frames = !options->grid.empty()
                                                   ? readFrames(options->analysis.file, options->grid)
                                                   : options->analysis.frames(settings, context);
        std::vector<double> position;
        if (frames && frames->grid().axes.size() > 1) {
            if (!options->range || !options->bearing)
                throw Error("explain", "a cell of pings requires --range and --bearing");
            position = {*options->range, *options->bearing};
        } else {
            if (!options->hz)
                throw Error("explain", "needs --frequency; for pings, give --range and --bearing");
            position = {*options->hz};
        }
        const auto analysis =
            frames ? analyse(frames, settings, context.part(0.0, 0.5))
                   : analyseInChosenWindow(options->analysis.recording(), settings, context.part(0.0, 0.5));
        printExplanation(explain(*analysis, options->seconds, position, context.part(0.5, 1.0)), *analysis,
                         options->json);
    });
}

} // namespace faintline::cli
