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

} // namespace

QString Source::name() const
{
    return QFileInfo(path).fileName();
}

Source sourceOf(const QString &path, const OpenOptions &options)
{
    Source source{path, options, {}};
    if (path.endsWith(QLatin1String(".json"), Qt::CaseInsensitive))
        source.scene = readScene(path);
    return source;
}

OpenedSource openSource(const Source &source)
{
    if (!source.scene)
        return {source, openRecording(source.path.toStdString(), source.options), {}};
    const auto recording = std::make_shared<SimulatedRecording>(*source.scene);
    return {source, recording, recording->truth()};
}

bool needsRawOptions(const QString &path, const OpenOptions &options)
{
    const std::string name = path.toStdString();
    return options.rawType.empty() && !(options.rawRateHz > 0.0) && QFileInfo(path).isFile() && rawTypeOfExtension(name)
           && !AudioRecording::recognises(name);
}

} // namespace faintline
