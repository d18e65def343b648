#include "app/document/Source.h"

#include "analysis/chooseWindow.h"
#include "analysis/slopeUnit.h"
#include "app/base/filePath.h"
#include "base/json.h"
#include "exchange/openFrames.h"
#include "recording/AudioRecording.h"
#include "recording/RawRecording.h"
#include "recording/SimulatedRecording.h"
#include "recording/truthBeside.h"
#include "spectrum/SimulatedPings.h"

namespace faintline {

namespace {

    constexpr qint64 largestScenario = 1 << 20;

    void readScene(const QString &path, Source &source)
    {
        const std::string where = pathBytes(path);
        const QByteArray text = readBeginning(path, largestScenario);
        try {
            const Json json = parseJson(text.toStdString(), where);
            if (isPingScene(json))
                source.pings = pingSceneFromJson(json);
            else
                source.scene = lineSceneFromJson(json);
        } catch (const Error &error) {
            throw error.where() == where ? error : error.in(where);
        }
    }

    NormalisedFramesPointer readStack(const QString &path)
    {
        auto frames = openFrames(pathBytes(path));
        frameKindOf(frames->grid(), pathBytes(path)); // throws if they cannot be displayed
        return frames;
    }

    /// Without the added lines.
    OpenedSource openBase(Source source)
    {
        source.injections.clear();
        OpenedSource opened;
        if (source.pings) {
            const auto pings = std::make_shared<SimulatedPings>(*source.pings);
            opened.pingTruth = pings->truth();
            opened.frames = pings;
        } else if (source.scene) {
            const auto recording = std::make_shared<SimulatedRecording>(*source.scene);
            opened.truth = recording->truth();
            opened.recording = recording;
        } else if (source.options.rawType.empty() && holdsFrames(pathBytes(source.path))) {
            opened.frames = readStack(source.path);
            opened.pingTruth = pingTruthBeside(pathBytes(source.path), opened.frames->grid());
            if (opened.frames->grid().isSpectrum())
                opened.truth = truthBeside(pathBytes(source.path));
        } else {
            opened.recording = openRecording(pathBytes(source.path), source.options);
            opened.truth = truthBeside(pathBytes(source.path));
        }
        opened.source = std::move(source);
        return opened;
    }

    std::vector<InjectedLine> linesOf(const std::vector<Source::Injection> &injections)
    {
        std::vector<InjectedLine> lines;
        for (const Source::Injection &injection : injections)
            lines.push_back(injection.line);
        return lines;
    }

} // namespace

QString Source::name() const
{
    return fileLabel(path);
}

bool Source::isStack() const
{
    return !isSimulated() && path.endsWith(QLatin1String(".npy"), Qt::CaseInsensitive);
}

Source sourceOf(const QString &path, const OpenOptions &options)
{
    Source source;
    source.path = path;
    source.options = options;
    if (path.endsWith(QLatin1String(".json"), Qt::CaseInsensitive))
        readScene(path, source);
    return source;
}

OpenedSource openSource(const Source &source)
{
    OpenedSource opened = openBase(source);
    if (source.injections.empty())
        return opened;
    if (!opened.recording)
        throw Error("recording.injected", "lines can be added to a recording only, not to frames");
    checkInjections(linesOf(source.injections), opened.recording->info(), "recording.injected");
    for (const Source::Injection &injection : source.injections)
        opened = withInjection(opened, injection);
    return opened;
}

AnalysisSettings firstSettings(const OpenedSource &opened)
{
    const std::string &name = opened.kind().preset;
    return name.empty() ? AnalysisSettings() : preset(name).settings;
}

std::shared_ptr<const Analysis> analyse(const OpenedSource &opened, const AnalysisSettings &settings,
                                        const RunContext &context, const Analysis *previous,
                                        const PictureSink &pictures, CalibrationDepth depth)
{
    return opened.frames ? analyse(opened.frames, withSlopesInBins(settings, *opened.frames), context, previous)
                         : analyseInChosenWindow(opened.recording, withSlopesInBins(settings, opened.recording->info()),
                                                 context, previous, pictures, depth);
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

bool needsRawOptions(const QString &path, const OpenOptions &options)
{
    const std::string name = pathBytes(path);
    return options.rawType.empty() && !(options.rawRateHz > 0.0) && isRegularFile(path) && rawTypeOfExtension(name)
           && !AudioRecording::recognises(name);
}

} // namespace faintline
