#include "app/Source.h"

#include "base/json.h"
#include "recording/AudioRecording.h"
#include "recording/RawRecording.h"
#include "recording/SimulatedRecording.h"

#include <QFile>
#include <QFileInfo>

namespace faintline {

namespace {

    constexpr qint64 largestScenario = 1 << 20;

    LineScene readScene(const QString &path)
    {
        const std::string where = path.toStdString();
        QFile file(path);
        if (!file.open(QIODevice::ReadOnly))
            throw Error(where, "cannot be read: " + file.errorString().toStdString());
        const QByteArray text = file.read(largestScenario);
        try {
            return lineSceneFromJson(parseJson(text.toStdString(), where));
        } catch (const Error &error) {
            throw error.where() == where ? error : Error(where + ": " + error.where(), error.why());
        }
    }

    /// Without the lines that were added.
    OpenedSource openBase(Source source)
    {
        source.injections.clear();
        if (!source.scene)
            return {source, openRecording(source.path.toStdString(), source.options), {}};
        const auto recording = std::make_shared<SimulatedRecording>(*source.scene);
        return {source, recording, recording->truth()};
    }

} // namespace

QString Source::name() const
{
    return QFileInfo(path).fileName();
}

Source sourceOf(const QString &path, const OpenOptions &options)
{
    Source source{path, options, {}, {}};
    if (path.endsWith(QLatin1String(".json"), Qt::CaseInsensitive))
        source.scene = readScene(path);
    return source;
}

OpenedSource openSource(const Source &source)
{
    OpenedSource opened = openBase(source);
    for (const Source::Injection &injection : source.injections)
        opened = withInjection(opened, injection);
    return opened;
}

OpenedSource withInjection(const OpenedSource &opened, const Source::Injection &injection)
{
    OpenedSource result = opened;
    const auto recording =
        std::make_shared<InjectedRecording>(opened.recording, std::vector{injection.line}, injection.channel, injection.seed);
    const Truth added = recording->truth();
    result.recording = recording;
    result.source.injections.push_back(injection);
    result.truth.lines.insert(result.truth.lines.end(), added.lines.begin(), added.lines.end());
    return result;
}

bool needsRawOptions(const QString &path, const OpenOptions &options)
{
    const std::string name = path.toStdString();
    return options.rawType.empty() && !(options.rawRateHz > 0.0) && QFileInfo(path).isFile() && rawTypeOfExtension(name)
           && !AudioRecording::recognises(name);
}

} // namespace faintline
