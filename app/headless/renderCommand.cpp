#include "app/headless/renderCommand.h"

#include "app/base/filePath.h"
#include "app/document/OutputLayers.h"
#include "app/document/Provenance.h"
#include "app/document/scanScenario.h"
#include "app/features/evaluate/ExperimentsPanel.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/ShownAxes.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/features/survey/SurveyPanel.h"
#include "app/headless/openAndSettle.h"
#include "app/headless/settleViews.h"
#include "app/lessons/Lesson.h"
#include "app/views/ReportWriter.h"
#include "app/views/WindowViews.h"
#include "app/window/MainWindow.h"
#include "base/files/AtomicFile.h"
#include "base/files/InputFiles.h"
#include "base/files/fileName.h"
#include "base/json.h"
#include "exchange/Session.h"
#include "widgets/pings/PingMap.h"

#include <QApplication>
#include <QBuffer>

#include <algorithm>

namespace faintline {

namespace {

    bool isOf(WindowView::Of kind, const std::string &view)
    {
        const auto &table = windowViews();
        return std::any_of(table.begin(), table.end(), [&](const WindowView &each) {
            return each.name == QString::fromStdString(view) && each.of == kind;
        });
    }

    bool has(const std::vector<std::string> &views, const char *name)
    {
        return std::find(views.begin(), views.end(), name) != views.end();
    }

    void testSelection(MainWindow &window, const std::vector<std::string> &views)
    {
        for (const char *view : {"stopping", "scan", "asn", "prior", "sectors"})
            if (std::find(views.begin(), views.end(), view) != views.end())
                throw Error(std::string("--view ") + view, "requires radar scans; the source must be a scenario of "
                                                           "kind \"scans\"");
        testAndSettle(window, [&] { window.panel<SequentialPanel>().startOnSelection(); });
    }

    void showLayer(MainWindow &window, const RenderOptions &options)
    {
        const auto found = std::find(outputLayerNames.begin(), outputLayerNames.end(), options.layer);
        if (found == outputLayerNames.end())
            throw Error("--layer " + options.layer,
                        "unknown; choose one of statistic, rate, bearing-rate, age, reset, inhibited, presence");
        OutputLayers &layers = window.workbench().layers();
        const auto layer = static_cast<OutputLayer>(found - outputLayerNames.begin());
        if (!layers.isOffered(layer))
            throw Error("--layer " + options.layer,
                        layer == OutputLayer::Presence
                            ? "requires lines over frequency; the source has pings on range and bearing"
                            : "requires pings on range and bearing; the source has lines over frequency");
        runAndSettle(layers, [&] {
            layers.setOverlay(options.isLayerOver);
            layers.setLayer(layer);
        });
    }

    void prepare(MainWindow &window, const std::vector<std::string> &views)
    {
        const auto has = [&](const char *name) { return faintline::has(views, name); };
        if (has("pd"))
            measureCurves(window);
        if (has("sweep"))
            sweepThreshold(window);
        for (const std::string &view : views)
            if (isOf(WindowView::Of::Pings, view) && !window.pingBench().isInUse())
                throw Error("--view " + view, "requires pings or scans");
            else if (isOf(WindowView::Of::Survey, view))
                throw Error("--view " + view, "requires a survey (.sqlite)");
        if (has("latency"))
            measureLatency(window);
        for (const char *name : {"why", "slice", "spectrum", "channels", "doppler", "noisefit"})
            if (has(name))
                showAndSettle(window, QString::fromLatin1(name));
        if (has("noise") || has("window"))
            settle(window.recordingCheck());
        if (std::any_of(views.begin(), views.end(), [](const auto &view) { return isOf(WindowView::Of::Scans, view); }))
            testSelection(window, views);
    }

    void placeCursor(MainWindow &window, const RenderOptions &options)
    {
        PingBench &pings = window.pingBench();
        const Grid grid = pings.isInUse() ? window.document().analysis()->grid() : Grid{{Axis()}};
        if (!options.position.empty() && !grid.fits(options.position))
            throw Error("--position", "has " + std::to_string(options.position.size()) + " numbers; the frames have "
                                          + grid.axisCountWords());
        if ((!options.axes.empty() || options.isSliced) && !frameKindOf(grid).hasHiddenAxes)
            throw Error(options.axes.empty() ? "--slice" : "--axes", "requires frames on more than two axes");
        if (!options.axes.empty())
            pings.axes().set(options.axes);
        window.bench().setPlace({options.seconds, options.hz, options.range, options.bearing, options.position});
        if (options.isSliced)
            pings.axes().setSliced(true);
    }

    /// Provenance of what the window shows; for a radar's scans, the settings of their test.
    Json provenanceOf(MainWindow &window, const RenderOptions &options)
    {
        const Document &document = window.document();
        if (SurveyPanel::isSurvey(pathText(options.source)))
            return {{"version", FAINTLINE_VERSION}, {"survey", textFromFileName(options.source)}};
        if (!window.experiments().entries().empty() && document.isEmpty())
            return {{"version", FAINTLINE_VERSION}, {"experiment", textFromFileName(options.source)}};
        if (document.isEmpty())
            return {{"version", FAINTLINE_VERSION},
                    {"sequential", writeFields(window.sequentialTests().test(), ScanTest::fields())}};
        return parseJson(faintline::provenanceOf(document.session()), "provenance");
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

    /// Rendering a view removes it from the widget that contains it, so the window is rendered before its parts, and
    /// the maps together before each of them.
    std::vector<std::string> wholesFirst(std::vector<std::string> views)
    {
        const auto rank = [](const std::string &view) {
            return view == "window" ? 0 : view == "map" || view == "polar" || view == "sequential" ? 1 : 2;
        };
        std::stable_sort(views.begin(), views.end(), [&](const auto &a, const auto &b) { return rank(a) < rank(b); });
        return views;
    }

    std::string sizeWords(QSize size)
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
            throw Error("--size " + sizeWords(size), "is too small for this view; it needs " + sizeWords(view.size()));
        QCoreApplication::sendPostedEvents();
        QCoreApplication::processEvents();
        if (QWidget *focused = QApplication::focusWidget(); focused && !isFocused)
            focused->clearFocus();
        return view.grab().toImage().convertToFormat(QImage::Format_RGB32);
    }

    /// A window without a user: it asks nothing and shows no provisional estimates.
    void showUnattended(MainWindow &window, QSize size)
    {
        window.setAsking(false);
        window.controller().setShowsFirstEstimates(false);
        window.show();
        QCoreApplication::processEvents(); // its smallest size depends on fonts that it has only when shown
        window.resize(size);
        QCoreApplication::processEvents();
    }

} // namespace

void render(const RenderOptions &options)
{
    checkEnding(options.out, {".png"});
    for (const std::string &view : options.views)
        if (!WindowViews::names().contains(QString::fromStdString(view)))
            throw Error("--view " + view,
                        "unknown; choose one of " + WindowViews::names().join(QStringLiteral(", ")).toStdString());
    const InputFiles inputs(filesReadFor(options.source));
    for (const std::string &view : options.views)
        checkReplacesNoInput(pictureName(options, view));

    Theme::apply(Theme::named(QString::fromStdString(options.theme)));
    MainWindow window;
    showUnattended(window, options.size);
    if (isLesson(pathText(options.source))) {
        goThroughLesson(window, options);
    } else if (options.step) {
        throw Error("--step " + std::to_string(*options.step), "requires a lesson; " + options.source + " is not one");
    } else if (isScanScenario(pathText(options.source))) {
        testScans(window, options);
    } else if (SurveyPanel::isSurvey(pathText(options.source))) {
        openSurvey(window, options);
    } else if (ExperimentsPanel::isExperiment(pathText(options.source))) {
        openExperiment(window, options);
    } else {
        const AnalysisSettings settings = openAndSettle(window, options);
        if (has(options.views, "compare") || !options.presetA.empty() || !options.settingsA.empty())
            compareWithA(window, settings);
        placeCursor(window, options);
        prepare(window, options.views);
        showLayer(window, options);
    }
    Json provenance = provenanceOf(window, options);
    const bool wasPolar = window.pingBench().output()->isPolar();
    for (const std::string &view : wholesFirst(options.views)) {
        window.pingBench().setPolar(view == "polar" || (view != "map" && wasPolar));
        QWidget &widget = *window.views().named(QString::fromStdString(view));
        // At that size a layer may have more pixels to fill, and a picture smaller ones.
        pictureOf(widget, options.size, options.isFocused);
        settle(window.workbench());
        provenance["render"] = toJson(options, view);
        write(pictureOf(widget, options.size, options.isFocused), pictureName(options, view), provenance);
    }
}

void report(const RenderOptions &options)
{
    checkEnding(options.out, {".html"});
    const QString source = pathText(options.source);
    if (isScanScenario(source) || isLesson(source))
        throw Error(options.source, std::string(isLesson(source) ? "is a lesson" : "is a radar's scenario")
                                        + "; a report requires a recording, pings or a session");
    const InputFiles inputs(filesReadFor(options.source));
    checkReplacesNoInput(options.out);
    Theme::apply(Theme::named(QString::fromStdString(options.theme)));
    MainWindow window;
    showUnattended(window, options.size);
    openAndSettle(window, options);
    ReportWriter writer(window.document(), window.views());
    runAndSettle(writer, [&] { writer.write(pathText(options.out)); });
}

} // namespace faintline
