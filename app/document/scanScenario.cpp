#include "app/document/scanScenario.h"

#include "app/base/filePath.h"
#include "base/Error.h"
#include "base/json.h"

namespace faintline {

namespace {

    constexpr qint64 largestScenario = 1 << 20;

    Json read(const QString &path)
    {
        return parseJson(readBeginning(path, largestScenario).toStdString(), pathBytes(path));
    }

} // namespace

QString radarScenarioPath()
{
    return QStringLiteral(":/scenarios/radar-surveillance.json");
}

bool isScanScenario(const QString &path)
{
    if (!path.endsWith(QLatin1String(".json"), Qt::CaseInsensitive))
        return false;
    try {
        const Json json = read(path);
        const auto kind = json.is_object() ? json.find("kind") : json.end();
        return kind != json.end() && *kind == "scans";
    } catch (const Error &) {
        return false; // reported when it is opened
    }
}

ScanTest readScanTest(const QString &path)
{
    const std::string where = pathBytes(path);
    const Json json = read(path);
    try {
        const ScanTest test = scanTestOf(scanSceneFromJson(json));
        checkScanTest(test);
        return test;
    } catch (const Error &error) {
        throw error.in(where);
    }
}

} // namespace faintline
