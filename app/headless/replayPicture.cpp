#include "app/headless/replayPicture.h"

#include "app/base/filePath.h"
#include "app/document/Provenance.h"
#include "app/document/ViewState.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/features/sequential/TrajectoryPage.h"
#include "app/headless/readPicture.h"
#include "app/headless/renderCommand.h"
#include "app/headless/settleViews.h"
#include "app/window/MainWindow.h"
#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "base/wholeNumber.h"
#include "calibrate/CalibrationStore.h"
#include "exchange/Session.h"

#include <QDir>
#include <QFileInfo>
#include <QTemporaryDir>

#include <algorithm>
#include <cstdio>
#include <limits>

namespace faintline {

bool isChart(const ReplayOptions &options)
{
    return pathText(options.picture).endsWith(QLatin1String(".csv"), Qt::CaseInsensitive);
}

QImage pictureOf(const ReplayOptions &options)
{
    return readPicture(pathText(options.picture));
}

double scaleOf(const QImage &picture)
{
    const Json provenance = Json::parse(picture.text(pictureProvenanceKey()).toStdString(), nullptr, false);
    const Json::json_pointer place("/render/scale");
    const bool tells = provenance.is_object() && provenance.contains(place) && provenance[place].is_number();
    return tells ? std::clamp(provenance[place].get<double>(), 1.0, 4.0) : 1.0;
}

namespace {

    /// The numbers of a chart of a test on a radar's scans.
    void replayChart(const ReplayOptions &options)
    {
        const Json provenance = readJsonFile(options.picture + ".provenance.json");
        try {
            if (!provenance.contains("chart") || provenance.contains("recording"))
                throw Error(options.picture, "is not a chart of a test on radar scans; use faintline-cli replay for "
                                             "other tables");
            const ScanTest test = scanTestFromJson(provenance.at("sequential"), "sequential");
            checkScanTest(test);
            MainWindow window;
            window.setAsking(false);
            window.show();
            testAndSettle(window, [&] { window.openScans(test); });
            testAndSettle(window,
                          [&] { window.sequentialTests().select(wholeNumber<int>(provenance.at("walk"), "walk")); });
            testAndSettle(window, [&] {
                window.sequentialTests().setStage(wholeNumber<Index>(provenance.at("stage"), "stage"));
            });
            window.panel<SequentialPanel>().trajectory().showAxis(wholeNumber<int>(provenance.at("axis"), "axis"));
            const auto &views = window.panel<SequentialPanel>().views().all();
            const auto view = std::find_if(views.begin(), views.end(),
                                           [name = provenance.at("chart").get<std::string>()](const auto &one) {
                                               return one.title.toStdString() == name;
                                           });
            if (view == views.end())
                throw Error(options.picture, "belongs to a chart that this version does not have");
            const QString kept = pathText(options.picture);
            const bool isSame = readBeginning(kept, std::numeric_limits<qint64>::max()).toStdString() == view->csv();
            std::printf("%s: %s\n", oneLine(pathBytes(QFileInfo(kept).fileName())).c_str(),
                        isSame ? "the same bytes" : "differs");
            if (!isSame)
                throw Error(options.picture, "differs from the result of its provenance", Error::Kind::Failure);
        } catch (const Json::exception &error) {
            throw Error(options.picture, "has an invalid provenance: " + complaint(error));
        }
    }

} // namespace

PictureOrigin originOf(const QImage &picture, const ReplayOptions &options, const QString &folder)
{
    const QString text = picture.text(pictureProvenanceKey());
    if (text.isEmpty())
        throw Error(options.picture, "contains no provenance");
    const Json provenance = parseJson(text.toStdString(), options.picture);
    try {
        if (!provenance.contains("recording") || !provenance.contains("render")
            || provenance["render"].contains("step"))
            throw Error(options.picture,
                        "shows the whole window, radar scans or a lesson; such pictures cannot be reproduced from "
                        "their provenance");
        Json session = provenance;
        Json &source = session["recording"];
        if (source.contains("path")) {
            const QDir place = QFileInfo(absolutePath(pathText(options.picture))).dir();
            const QString named = QString::fromStdString(source["path"].get<std::string>());
            const QString beside =
                place.filePath(QFileInfo(named).fileName()); // a path elsewhere must not be read without permission
            const QString recording = absolutePath(options.recording.empty() ? beside : pathText(options.recording));
            if (!fileExists(recording))
                throw Error(pathBytes(recording),
                            "the input of " + options.picture + " was not found; give its path with --recording");
            if (recordingHash(pathBytes(recording)) != source["sha256"].get<std::string>())
                throw Error(pathBytes(recording), "is not the input of " + options.picture);
            source["path"] = recording.toStdString();
        }
        session.erase("render");
        session.erase("version");
        PictureOrigin origin{renderOptionsFromJson(provenance["render"]),
                             provenance["render"].at("view").get<std::string>()};
        if (!(origin.options.scale >= 1.0 && origin.options.scale <= 4.0))
            throw Error(options.picture, "names an invalid scale; it must lie in 1 … 4");
        if (origin.options.size != picture.size() / origin.options.scale)
            throw Error(options.picture, "names a different size than it has");
        origin.options.source = QDir(folder).filePath(QStringLiteral("picture.faintline")).toStdString();
        origin.options.out = QDir(folder).filePath(QStringLiteral("picture.png")).toStdString();
        writeTextFile(origin.options.source, session.dump(2) + "\n");
        try {
            viewFromJson(readSession(origin.options.source).view, origin.options.source);
        } catch (const Error &error) { // names the temporary file, which the user does not know
            throw Error(options.picture, "has an invalid provenance: "
                                             + std::string(error.what()).substr(origin.options.source.size() + 2));
        }
        return origin;
    } catch (const Json::exception &error) {
        throw Error(options.picture, "has an invalid provenance: " + complaint(error));
    }
}

void replay(const ReplayOptions &options)
{
    const QTemporaryDir folder;
    CalibrationStore::moveTo(pathBytes(folder.filePath(QStringLiteral("calibrations"))));
    if (isChart(options))
        return replayChart(options);
    const QImage kept = pictureOf(options);
    const PictureOrigin origin = originOf(kept, options, folder.path());
    render(origin.options);
    const std::string remade = pictureName(origin.options, origin.view);
    const bool isSame =
        QImage(pathText(remade)).convertToFormat(QImage::Format_RGB32) == kept.convertToFormat(QImage::Format_RGB32);
    std::printf("%s: %s\n", oneLine(pathBytes(QFileInfo(pathText(options.picture)).fileName())).c_str(),
                isSame ? "the same pixels" : "differs");
    if (!isSame)
        throw Error(options.picture, "differs from the result of its provenance", Error::Kind::Failure);
}

} // namespace faintline
