#include "app/renderCommand.h"

#include "app/Closeup.h"
#include "app/ComparePanel.h"
#include "app/EvaluatePanel.h"
#include "app/ExperimentForm.h"
#include "app/LatencyPanel.h"
#include "app/LessonGuide.h"
#include "app/MainWindow.h"
#include "app/NoiseFitPanel.h"
#include "app/OutputLayers.h"
#include "app/PingBench.h"
#include "app/Provenance.h"
#include "app/ReportWriter.h"
#include "app/SequentialPanel.h"
#include "app/SequentialTests.h"
#include "app/Session.h"
#include "app/StateSlicePanel.h"
#include "app/SweepForm.h"
#include "app/SweepPanel.h"
#include "app/WhyPanel.h"
#include "app/Workbench.h"
#include "app/readPicture.h"
#include "app/scanScenario.h"
#include "base/AtomicFile.h"
#include "base/readingJson.h"
#include "recording/openRecording.h"
#include "widgets/PingMap.h"

#include <QApplication>
#include <QBuffer>
#include <QEventLoop>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QPixmap>
#include <QTemporaryDir>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>

namespace faintline {

namespace {

    constexpr const char *sequentialViews[]{"sequential", "walk", "stopping", "posterior", "scan", "asn", "prior", "sectors"};

    void adjust(AnalysisSettings &settings, const RenderOptions &options)
    {
        if (!options.preset.empty())
            settings = preset(options.preset).settings;
        settings.selection.channel = options.channel.value_or(settings.selection.channel);
        for (const std::string &assignment : options.settings) {
            const std::size_t equals = assignment.find('=');
            if (equals == std::string::npos)
                throw Error("--set " + assignment, "must be name=value");
            setSetting(settings, assignment.substr(0, equals), assignment.substr(equals + 1));
        }
        checkSettings(settings);
    }

    /// What A is made with: the same, and A's own.
    RenderOptions optionsOfA(RenderOptions options)
    {
        if (!options.presetA.empty())
            options.preset = options.presetA;
        options.settings.insert(options.settings.end(), options.settingsA.begin(), options.settingsA.end());
        return options;
    }

    bool has(const std::vector<std::string> &views, const char *name)
    {
        return std::find(views.begin(), views.end(), name) != views.end();
    }

    /// Opens and waits until nothing is left to do. The answer is what the settings would be without A's own.
    AnalysisSettings openAndSettle(MainWindow &window, const RenderOptions &options)
    {
        const auto settingsOfB = std::make_shared<AnalysisSettings>();
        QEventLoop loop;
        std::optional<Error> failure;
        QObject::connect(&window.controller(), &AnalysisController::failed, &loop,
                         [&](const Error &error) { failure = error; });
        QObject::connect(&window.controller(), &AnalysisController::settled, &loop, &QEventLoop::quit);
        window.open(QString::fromStdString(options.source), options.opening,
                    [options, settingsOfB](AnalysisSettings &settings) {
                        *settingsOfB = settings;
                        adjust(*settingsOfB, options);
                        adjust(settings, optionsOfA(options));
                    });
        loop.exec();
        if (failure)
            throw *failure;
        return *settingsOfB;
    }

    /// What a picture of the curves shows: a small experiment on lines such as the papers', the same from run to run.
    void measureCurves(MainWindow &window)
    {
        constexpr int runs = 2;
        window.evaluation().form().setQuick(runs, {QStringLiteral("SMD 5 slopes"), QStringLiteral("3 of 4"), QStringLiteral("integrator")}, -5, 3, 2);
        QEventLoop loop;
        QObject::connect(&window.experiments(), &Experiments::busyChanged, &loop, [&](bool isBusy) {
            if (!isBusy)
                loop.quit();
        });
        window.evaluation().start();
        loop.exec();
        const Experiments::Entry *entry = window.experiments().entry(window.evaluation().shown());
        if (entry->state == Experiments::State::Failed)
            throw Error("experiment", entry->failure.toStdString(), Error::Kind::Failure);
    }

    /// What a picture of a sweep shows: a small one of the threshold, the same from run to run.
    void sweepThreshold(MainWindow &window)
    {
        constexpr int trials = 24;
        SweepPanel &panel = window.sweep();
        panel.setMeasuringCost(false);
        panel.form().setParameter(QStringLiteral("decide.thresholdNats"));
        panel.form().setRange(4.0, 16.0, 7, false);
        panel.form().setLines(0.0, 30.0, trials);
        QEventLoop loop;
        QObject::connect(&window.experiments(), &Experiments::busyChanged, &loop, [&](bool isBusy) {
            if (!isBusy)
                loop.quit();
        });
        window.showSweep();
        panel.start();
        if (window.experiments().isBusy())
            loop.exec();
        const Experiments::Entry *entry = window.experiments().entry(panel.shown());
        if (!entry || entry->state == Experiments::State::Failed)
            throw Error("--view sweep", entry ? entry->failure.toStdString() : "cannot be made of this source", Error::Kind::Failure);
    }

    void explainCursor(MainWindow &window)
    {
        QEventLoop loop;
        QObject::connect(&window.why(), &WhyPanel::settled, &loop, &QEventLoop::quit);
        window.showWhy();
        loop.exec();
    }

    void measureNoise(MainWindow &window)
    {
        QEventLoop loop;
        QObject::connect(&window.noiseFit(), &NoiseFitPanel::settled, &loop, &QEventLoop::quit);
        window.showNoiseFit();
        if (window.noiseFit().isBusy())
            loop.exec();
    }

    /// Calls what starts something in the sequential panel, and waits until nothing is left to do.
    void testAndSettle(MainWindow &window, const std::function<void()> &start)
    {
        QEventLoop loop;
        std::optional<Error> failure;
        QObject::connect(&window.sequential(), &SequentialPanel::failed, &loop, [&](const Error &error) {
            failure = error;
            loop.quit();
        });
        QObject::connect(&window.sequentialTests(), &SequentialTests::settled, &loop, &QEventLoop::quit);
        start();
        if (!failure && window.sequentialTests().isBusy())
            loop.exec();
        if (failure)
            throw *failure;
    }

    void testScans(MainWindow &window, const RenderOptions &options)
    {
        ScanTest test = readScanTest(QString::fromStdString(options.source));
        for (const std::string &assignment : options.settings)
            setScanTestField(test, assignment);
        checkScanTest(test);
        testAndSettle(window, [&] { window.openScans(test); });
        if (!options.seconds)
            return;
        const double before = std::clamp(*options.seconds / test.scene.secondsPerStage, 0.0, static_cast<double>(stageLimit(test)));
        testAndSettle(window, [&] { window.sequentialTests().setStage(static_cast<Index>(before) + 1); });
    }

    /// The window as a lesson's step sets it up.
    void goThroughLesson(MainWindow &window, const RenderOptions &options)
    {
        const Lesson lesson = readLesson(QString::fromStdString(options.source));
        const int step = options.step.value_or(1);
        if (!options.settings.empty() || !options.preset.empty())
            throw Error("--set", "does not go with a lesson, which has settings of its own");
        if (const auto count = std::ssize(lesson.steps); step < 1 || step > count)
            throw Error("--step " + std::to_string(step), "must lie in 1 … " + std::to_string(count) + " of this lesson");
        QEventLoop loop;
        std::optional<Error> failure;
        QObject::connect(&window.controller(), &AnalysisController::failed, &loop, [&](const Error &error) {
            failure = error;
            loop.quit();
        });
        QObject::connect(&window.lessonGuide(), &LessonGuide::ready, &loop, &QEventLoop::quit);
        window.lessonGuide().start(lesson, step - 1);
        loop.exec();
        if (failure)
            throw *failure;
        if (!window.why().visibleRegion().isEmpty())
            explainCursor(window);
    }

    void checkViewsOfScans(const std::vector<std::string> &views)
    {
        for (const std::string &view : views)
            if (const auto known = std::find(std::begin(sequentialViews), std::end(sequentialViews), view);
                known == std::end(sequentialViews) && view != "window")
                throw Error("--view " + view, "is of a recording; a radar's scans have window, sequential, walk, stopping, posterior, "
                                              "scan, asn, prior, sectors");
    }

    void testSelection(MainWindow &window, const std::vector<std::string> &views)
    {
        for (const char *view : {"stopping", "scan", "asn", "prior", "sectors"})
            if (std::find(views.begin(), views.end(), view) != views.end())
                throw Error(std::string("--view ") + view, "is of a radar's scans; the source must be a scenario of kind \"scans\"");
        testAndSettle(window, [&] { window.sequential().startOnSelection(); });
    }

    void settleLayers(MainWindow &window)
    {
        QEventLoop loop;
        QObject::connect(&window.workbench().layers(), &OutputLayers::settled, &loop, &QEventLoop::quit);
        if (window.workbench().layers().isBusy())
            loop.exec();
    }

    void settleCloseup(MainWindow &window)
    {
        QEventLoop loop;
        QObject::connect(&window.workbench().closeup(), &Closeup::settled, &loop, [&] {
            if (!window.workbench().closeup().isBusy())
                loop.quit();
        });
        if (window.workbench().closeup().isBusy())
            loop.exec();
    }

    void showLayer(MainWindow &window, const RenderOptions &options)
    {
        const auto found = std::find(outputLayerNames.begin(), outputLayerNames.end(), options.layer);
        if (found == outputLayerNames.end())
            throw Error("--layer " + options.layer, "is not known; there are statistic, rate, bearing-rate, age, reset, inhibited");
        OutputLayers &layers = window.workbench().layers();
        const auto layer = static_cast<OutputLayer>(found - outputLayerNames.begin());
        if (!layers.isOffered(layer))
            throw Error("--layer " + options.layer, "is of pings on range and bearing; these are lines over frequency");
        std::optional<Error> failure;
        QObject::connect(&layers, &OutputLayers::failed, &window, [&](const Error &error) { failure = error; });
        layers.setOverlay(options.isLayerOver);
        layers.setLayer(layer);
        settleLayers(window);
        if (failure)
            throw *failure;
    }

    void cutStates(MainWindow &window)
    {
        QEventLoop loop;
        QObject::connect(&window.states(), &StateSlicePanel::settled, &loop, &QEventLoop::quit);
        window.showStates();
        if (window.states().isBusy())
            loop.exec();
        settleLayers(window); // the read-out tells of the state, too
    }

    void measureLatency(MainWindow &window)
    {
        constexpr int runs = 4;
        if (const QString why = window.latency().obstacle(); !why.isEmpty())
            throw Error("--view latency", why.toStdString());
        QEventLoop loop;
        QObject::connect(&window.latency(), &LatencyPanel::settled, &loop, &QEventLoop::quit);
        window.showLatency();
        window.latency().start(runs);
        loop.exec();
    }

    /// What was opened with A's settings becomes A; the settings then become B's.
    void compareWithA(MainWindow &window, const AnalysisSettings &settings)
    {
        window.comparer().setMeasuringCost(false);
        window.comparePanel().keep();
        QEventLoop loop;
        std::optional<Error> failure;
        QObject::connect(&window.controller(), &AnalysisController::failed, &loop, [&](const Error &error) { failure = error; });
        QObject::connect(&window.controller(), &AnalysisController::settled, &loop, &QEventLoop::quit);
        window.controller().setSettings(settings, QStringLiteral("B"));
        if (window.controller().isBusy())
            loop.exec();
        if (failure)
            throw *failure;
        QEventLoop comparing;
        QObject::connect(&window.comparer(), &Comparer::settled, &comparing, &QEventLoop::quit);
        window.showCompare();
        window.comparer().setActive(true);
        if (window.comparer().isBusy())
            comparing.exec();
    }

    void prepare(MainWindow &window, const std::vector<std::string> &views)
    {
        const auto has = [&](const char *name) { return faintline::has(views, name); };
        if (has("pd"))
            measureCurves(window);
        if (has("sweep"))
            sweepThreshold(window);
        if (has("why"))
            explainCursor(window);
        for (const char *view : {"map", "polar", "histories", "latency"})
            if (has(view) && !window.document().hasPings())
                throw Error(std::string("--view ") + view, "is a picture of pings on range and bearing; these are no such frames");
        if (has("latency"))
            measureLatency(window);
        if (has("slice"))
            cutStates(window);
        if (has("noisefit"))
            measureNoise(window);
        for (const char *view : sequentialViews)
            if (has(view))
                return testSelection(window, views);
    }

    void placeCursor(MainWindow &window, const RenderOptions &options)
    {
        Viewport &viewport = window.document().viewport();
        if (window.document().hasPings()) {
            PingViewports &viewports = window.pingBench().viewports();
            PingViewports::Place place = viewports.place();
            place.seconds = options.seconds.value_or(place.seconds);
            place.range = options.range.value_or(place.range);
            place.bearing = options.bearing.value_or(place.bearing);
            viewports.setPlace(place);
            return;
        }
        Viewport::Point point = viewport.cursor().value_or(Viewport::Point());
        point.seconds = options.seconds.value_or(point.seconds);
        point.hz = options.hz.value_or(point.hz);
        viewport.setCursor(point);
        viewport.reveal({{point.seconds, point.seconds}, {point.hz, point.hz}});
    }

    /// `name` put before the extension where there is more than one picture.
    std::string fileName(const RenderOptions &options, const std::string &view)
    {
        if (options.views.size() == 1)
            return options.out;
        const QFileInfo out(QString::fromStdString(options.out));
        return (out.path() + QLatin1Char('/') + out.completeBaseName() + QLatin1Char('-') + QString::fromStdString(view)
                + QLatin1Char('.') + out.suffix())
            .toStdString();
    }

    /// What a picture was asked for, beside what it was made from.
    Json toJson(const RenderOptions &options, const std::string &view)
    {
        Json json = {{"view", view}, {"size", {options.size.width(), options.size.height()}}, {"theme", options.theme}};
        const auto tell = [&json](const char *name, const auto &value) {
            if (value)
                json[name] = *value;
        };
        if (options.views.size() > 1) // one after the other in the same window, where automatic ranges may remember
            json["views"] = options.views;
        tell("time", options.seconds);
        tell("frequency", options.hz);
        tell("range", options.range);
        tell("bearing", options.bearing);
        tell("step", options.step);
        if (options.scale != 1.0)
            json["scale"] = options.scale;
        if (options.layer != "statistic")
            json["layer"] = options.layer;
        if (options.isLayerOver)
            json["overlay"] = true;
        if (!options.presetA.empty()) {
            json["presetA"] = options.presetA;
            json["set"] = options.settings; // A's as well, on top of its own preset
        }
        if (!options.settingsA.empty())
            json["setA"] = options.settingsA;
        return json;
    }

    RenderOptions optionsFromJson(const Json &json)
    {
        RenderOptions options;
        options.views = json.value("views", std::vector{json.at("view").get<std::string>()});
        options.size = {json.at("size").at(0).get<int>(), json.at("size").at(1).get<int>()};
        options.theme = json.at("theme").get<std::string>();
        options.scale = json.value("scale", 1.0);
        const auto take = [&json](const char *name, std::optional<double> &value) {
            if (json.contains(name))
                value = json[name].get<double>();
        };
        take("time", options.seconds);
        take("frequency", options.hz);
        take("range", options.range);
        take("bearing", options.bearing);
        options.layer = json.value("layer", options.layer);
        options.isLayerOver = json.value("overlay", false);
        options.isFocused = json.value("focused", true);
        options.presetA = json.value("presetA", std::string());
        options.settings = json.value("set", std::vector<std::string>());
        options.settingsA = json.value("setA", std::vector<std::string>());
        return options;
    }

    /// Of what the window shows; a radar's scans are known by their test.
    Json provenanceOf(MainWindow &window)
    {
        const Document &document = window.document();
        if (document.isEmpty())
            return {{"version", FAINTLINE_VERSION}, {"sequential", writeFields(window.sequentialTests().test(), ScanTest::fields())}};
        return parseJson(faintline::provenanceOf(document.source(), document.settings(), document.annotations()), "provenance");
    }

    void write(QImage image, const std::string &path, const Json &provenance)
    {
        image.setText(pictureProvenanceKey(), pictureProvenance(provenance.dump()));
        QByteArray bytes;
        QBuffer buffer(&bytes);
        buffer.open(QIODevice::WriteOnly);
        if (!image.save(&buffer, "PNG"))
            throw Error(path, "cannot be written as PNG", Error::Kind::Failure);
        writeTextFile(path, bytes.toStdString());
    }

    /// A view is taken out of what it is a part of, so the window comes before its parts, and the maps before each of them.
    std::vector<std::string> wholesFirst(std::vector<std::string> views)
    {
        const auto rank = [](const std::string &view) { return view == "window" ? 0 : view == "map" || view == "polar" || view == "sequential" ? 1 : 2; };
        std::stable_sort(views.begin(), views.end(), [&](const auto &a, const auto &b) { return rank(a) < rank(b); });
        return views;
    }

    std::string sizeText(QSize size)
    {
        return std::to_string(size.width()) + "x" + std::to_string(size.height());
    }

    QImage pictureOf(QWidget &view, QSize size, bool isFocused)
    {
        if (!view.isWindow())
            view.setParent(nullptr);
        view.resize(size);
        view.show();
        if (view.size() != size)
            throw Error("--size " + sizeText(size), "is too small for this view; it needs " + sizeText(view.size()));
        QCoreApplication::sendPostedEvents();
        QCoreApplication::processEvents();
        if (QWidget *focused = QApplication::focusWidget(); focused && !isFocused)
            focused->clearFocus();
        return view.grab().toImage().convertToFormat(QImage::Format_RGB32);
    }

} // namespace

void render(const RenderOptions &options)
{
    for (const std::string &view : options.views)
        if (!MainWindow::viewNames().contains(QString::fromStdString(view)))
            throw Error("--view " + view,
                        "is not known; there are " + MainWindow::viewNames().join(QStringLiteral(", ")).toStdString());

    Theme::apply(Theme::named(QString::fromStdString(options.theme)));
    MainWindow window;
    window.setAsking(false);
    window.resize(options.size);
    window.show();
    if (isLesson(QString::fromStdString(options.source))) {
        goThroughLesson(window, options);
    } else if (options.step) {
        throw Error("--step " + std::to_string(*options.step), "is of a lesson; " + options.source + " is none");
    } else if (isScanScenario(QString::fromStdString(options.source))) {
        checkViewsOfScans(options.views);
        testScans(window, options);
    } else {
        const AnalysisSettings settings = openAndSettle(window, options);
        if (has(options.views, "compare") || !options.presetA.empty() || !options.settingsA.empty())
            compareWithA(window, settings);
        placeCursor(window, options);
        prepare(window, options.views);
        showLayer(window, options);
    }
    Json provenance = provenanceOf(window);
    const bool wasPolar = window.pingBench().output()->isPolar();
    for (const std::string &view : wholesFirst(options.views)) {
        window.pingBench().setPolar(view == "polar" || (view != "map" && wasPolar));
        QWidget &widget = *window.view(QString::fromStdString(view));
        pictureOf(widget, options.size, options.isFocused); // at that size a layer may have more pixels to fill, and a picture smaller ones
        settleLayers(window);
        settleCloseup(window);
        provenance["render"] = toJson(options, view);
        write(pictureOf(widget, options.size, options.isFocused), fileName(options, view), provenance);
    }
}

bool isChart(const ReplayOptions &options)
{
    return QString::fromStdString(options.picture).endsWith(QLatin1String(".csv"), Qt::CaseInsensitive);
}

double scaleOf(const QImage &picture)
{
    const Json provenance = Json::parse(picture.text(pictureProvenanceKey()).toStdString(), nullptr, false);
    const Json::json_pointer place("/render/scale");
    const bool tells = provenance.is_object() && provenance.contains(place) && provenance[place].is_number();
    return tells ? std::clamp(provenance[place].get<double>(), 1.0, 4.0) : 1.0;
}

namespace {

    /// A chart's numbers of a test on a radar's scans.
    void replayChart(const ReplayOptions &options)
    {
        const Json provenance = readJsonFile(options.picture + ".provenance.json");
        try {
            if (!provenance.contains("chart") || provenance.contains("recording"))
                throw Error(options.picture, "is no chart of a test on a radar's scans; faintline-cli replay makes other tables again");
            ScanTest test;
            readFields(provenance.at("sequential"), ScanTest::fields(), test, "sequential");
            checkScanTest(test);
            MainWindow window;
            window.setAsking(false);
            window.show();
            testAndSettle(window, [&] { window.openScans(test); });
            testAndSettle(window, [&] { window.sequentialTests().select(provenance.at("walk").get<int>()); });
            testAndSettle(window, [&] { window.sequentialTests().setStage(provenance.at("stage").get<Index>()); });
            window.sequential().showAxis(provenance.at("axis").get<int>());
            const auto &views = window.sequential().views();
            const auto view = std::find_if(views.begin(), views.end(), [name = provenance.at("chart").get<std::string>()](const auto &one) {
                return one.title.toStdString() == name;
            });
            if (view == views.end())
                throw Error(options.picture, "is of a chart that this version does not have");
            QFile kept(QString::fromStdString(options.picture));
            if (!kept.open(QIODevice::ReadOnly))
                throw Error(options.picture, "cannot be read: " + kept.errorString().toStdString());
            const bool isSame = kept.readAll().toStdString() == view->csv();
            std::printf("%s: %s\n", qPrintable(QFileInfo(kept).fileName()), isSame ? "the same bytes" : "differs");
            if (!isSame)
                throw Error(options.picture, "is not what its provenance makes", Error::Kind::Failure);
        } catch (const Json::exception &error) {
            throw Error(options.picture, "has a provenance that is broken: " + complaint(error));
        }
    }

} // namespace

void replay(const ReplayOptions &options)
{
    const QString path = QString::fromStdString(options.picture);
    if (isChart(options))
        return replayChart(options);
    const QImage kept = readPicture(path);
    const QString text = kept.text(pictureProvenanceKey());
    if (text.isEmpty())
        throw Error(options.picture, "tells nothing of what it was made from");
    const Json provenance = parseJson(text.toStdString(), options.picture);
    try {
        if (!provenance.contains("recording") || !provenance.contains("render") || provenance["render"].contains("step"))
            throw Error(options.picture,
                        "is of the whole window, of a radar's scans, or of a lesson: what it tells does not suffice to make it again");
        const QTemporaryDir folder;
        Json session = provenance;
        Json &source = session["recording"];
        if (source.contains("path")) {
            const QFileInfo beside(QFileInfo(path).absoluteDir().filePath(QString::fromStdString(source["path"].get<std::string>())));
            const QString recording = options.recording.empty() ? beside.absoluteFilePath()
                                                                : QFileInfo(QString::fromStdString(options.recording)).absoluteFilePath();
            if (!QFileInfo::exists(recording))
                throw Error(recording.toStdString(),
                            "is what " + options.picture + " was made from, and is not there; --recording says where it is");
            if (recordingHash(recording.toStdString()) != source["sha256"].get<std::string>())
                throw Error(recording.toStdString(), "is not what " + options.picture + " was made from");
            source["path"] = recording.toStdString();
        }
        session.erase("render");
        session.erase("version");
        RenderOptions again = optionsFromJson(provenance["render"]);
        if (again.size != (kept.size() / again.scale))
            throw Error(options.picture, "tells of another size than it has");
        again.source = folder.filePath(QStringLiteral("picture.faintline")).toStdString();
        again.out = folder.filePath(QStringLiteral("picture.png")).toStdString();
        writeTextFile(again.source, session.dump(2) + "\n");
        try {
            readSession(QString::fromStdString(again.source));
        } catch (const Error &error) { // of a file of which nobody knows
            throw Error(options.picture, "tells of its making in a broken way: " + std::string(error.what()).substr(again.source.size() + 2));
        }
        render(again);
        const std::string remade = fileName(again, provenance["render"].at("view").get<std::string>());
        const bool isSame = QImage(QString::fromStdString(remade)).convertToFormat(QImage::Format_RGB32)
                            == kept.convertToFormat(QImage::Format_RGB32);
        std::printf("%s: %s\n", qPrintable(QFileInfo(path).fileName()), isSame ? "the same pixels" : "differs");
        if (!isSame)
            throw Error(options.picture, "is not what its provenance makes", Error::Kind::Failure);
    } catch (const Json::exception &error) {
        throw Error(options.picture, "tells of its making in a broken way: " + complaint(error));
    }
}

void report(const RenderOptions &options)
{
    const QString source = QString::fromStdString(options.source);
    if (isScanScenario(source) || isLesson(source))
        throw Error(options.source, std::string(isLesson(source) ? "is a lesson" : "is a radar's scenario")
                                        + "; a report is of a recording, of pings, or of a session");
    Theme::apply(Theme::named(QString::fromStdString(options.theme)));
    MainWindow window;
    window.setAsking(false);
    window.resize(options.size);
    window.show();
    openAndSettle(window, options);
    ReportWriter writer(window);
    QEventLoop loop;
    std::optional<Error> failure;
    QObject::connect(&writer, &ReportWriter::failed, &loop, [&](const Error &error) { failure = error; });
    QObject::connect(&writer, &ReportWriter::busyChanged, &loop, [&](bool isBusy) {
        if (!isBusy)
            loop.quit();
    });
    writer.write(QString::fromStdString(options.out));
    loop.exec();
    if (failure)
        throw *failure;
}

} // namespace faintline
