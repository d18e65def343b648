#include "app/document/sourceAt.h"

#include "app/base/filePath.h"
#include "base/json.h"
#include "exchange/Session.h"
#include "plan/firstSettings.h"

namespace faintline {

namespace {

    constexpr qint64 largestFile = 1 << 20;

    bool isInResources(const QString &path)
    {
        return path.startsWith(QLatin1String(":/"));
    }

    Json readResource(const QString &path)
    {
        return parseJson(readBeginning(path, largestFile).toStdString(), pathBytes(path));
    }

} // namespace

Source sourceAt(const QString &path, const OpenOptions &options)
{
    const std::string name = pathBytes(path);
    return isInResources(path) ? sourceOfScene(readResource(path), name) : sourceOf(name, options);
}

Session sessionAt(const QString &path)
{
    const std::string name = pathBytes(path);
    if (!isInResources(path))
        return readSession(name);
    Session session = sessionOf(readResource(path), name);
    session.source.path = name;
    return session;
}

QString nameOf(const Source &source)
{
    return fileLabel(pathText(source.path));
}

const FrameKind &kindOf(const OpenedSource &opened)
{
    return opened.frames ? frameKindOf(opened.frames->grid()) : lineFrames();
}

AnalysisSettings firstSettings(const OpenedSource &opened)
{
    return opened.frames      ? firstSettings(opened.frames->grid())
           : opened.recording ? firstSettings(opened.recording->info())
                              : AnalysisSettings();
}

bool needsRawOptions(const QString &path, const OpenOptions &options)
{
    return options.rawType.empty() && !(options.rawRateHz > 0.0) && isRegularFile(path) && isNamedRaw(pathBytes(path));
}

} // namespace faintline
