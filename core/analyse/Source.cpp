#include "analyse/Source.h"

#include "base/files/fileName.h"
#include "base/json.h"
#include "noise/openFrames.h"
#include "scene/SimulatedPings.h"
#include "scene/SimulatedRecording.h"
#include "scene/truthBeside.h"

namespace faintline {

namespace {

    /// Without the added lines and the truth beside the file.
    OpenedSource openBase(const Source &source, const FramesOptions &normalisation = {}, const RunContext &context = {})
    {
        OpenedSource opened;
        opened.source = source;
        opened.normalisation = normalisation;
        opened.source.injections.clear();
        if (source.pings) {
            const auto pings = std::make_shared<SimulatedPings>(*source.pings);
            opened.pingTruth = pings->truth();
            opened.frames = pings;
        } else if (source.scene) {
            const auto recording = std::make_shared<SimulatedRecording>(*source.scene);
            opened.truth = recording->truth();
            opened.recording = recording;
        } else if (source.hasSamples()) {
            opened.recording = openRecording(source.path, source.options);
        } else {
            opened.frames = openFrames(source.path, normalisation, context);
            opened.isPower = opened.frames && opened.frames->grid().isSpectrum() && openPower(source.path);
        }
        return opened;
    }

    void readTruthBeside(OpenedSource &opened)
    {
        const std::string &path = opened.source.path;
        if (opened.source.isSimulated())
            return;
        if (opened.frames)
            opened.pingTruth = pingTruthBeside(path, opened.frames->grid());
        if (!opened.frames || opened.frames->grid().isSpectrum())
            opened.truth = truthBeside(path);
    }

    OpenedSource withInjections(OpenedSource opened, const std::vector<Source::Injection> &injections)
    {
        if (injections.empty())
            return opened;
        if (!opened.recording)
            throw Error("recording.injected", "lines can be added to a recording only, not to frames");
        std::vector<InjectedLine> lines;
        for (const Source::Injection &injection : injections)
            lines.push_back(injection.line);
        checkInjections(lines, opened.recording->info(), "recording.injected");
        for (const Source::Injection &injection : injections)
            opened = withInjection(opened, injection);
        return opened;
    }

} // namespace

bool Source::isStack() const
{
    return !isSimulated() && hasEnding(path, ".npy");
}

bool Source::hasSamples() const
{
    return !pings && (scene || !options.rawType.empty() || !holdsFrames(path));
}

Source sourceOf(const std::string &path, const OpenOptions &options)
{
    if (hasEnding(path, ".json"))
        return sourceOfScene(readJsonFile(path), path);
    return {path, options, {}};
}

Source sourceOfScene(const Json &scene, const std::string &path)
{
    Source source{path, {}, {}};
    inFile(path, [&] {
        if (isPingScene(scene))
            source.pings = pingSceneFromJson(scene);
        else
            source.scene = lineSceneFromJson(scene);
    });
    return source;
}

FramesOptions normalisationBy(const AnalysisSettings &settings)
{
    return {settings.selection, settings.noise, settings.pings};
}

bool OpenedSource::isNormalisedFor(const AnalysisSettings &settings) const
{
    const FramesOptions wanted = normalisationBy(settings);
    if (isPower)
        return wanted.selection == normalisation.selection && wanted.noise == normalisation.noise;
    return !isRecordedPings() || wanted.pings == normalisation.pings;
}

NormalisedFramesPointer OpenedSource::framesFor(const AnalysisSettings &settings, const RunContext &context) const
{
    if (isNormalisedFor(settings))
        return frames;
    return openFrames(source.path, normalisationBy(settings), context);
}

OpenedSource openSource(const Source &source, const FramesOptions &normalisation, const RunContext &context)
{
    OpenedSource opened = openBase(source, normalisation, context);
    readTruthBeside(opened);
    return withInjections(std::move(opened), source.injections);
}

RecordingPointer openSamples(const Source &source)
{
    if (source.pings)
        throw Error(source.path,
                    "is a scene of sonar pings, not a recording; use it with 'detect', 'simulate' or 'info'");
    if (!source.hasSamples())
        throw Error(
            source.path,
            "holds frames (time and frequency), not samples; use it with 'detect', 'explain', 'compare' or 'info'");
    return withInjections(openBase(source), source.injections).recording;
}

OpenedSource withInjection(const OpenedSource &opened, const Source::Injection &injection)
{
    OpenedSource result = opened;
    const auto recording = std::make_shared<InjectedRecording>(opened.recording, std::vector{injection.line},
                                                               injection.channel, injection.seed);
    const Truth added = recording->truth();
    result.recording = recording;
    result.source.injections.push_back(injection);
    result.truth.lines.insert(result.truth.lines.end(), added.lines.begin(), added.lines.end());
    return result;
}

} // namespace faintline
