#include "app/headless/openAndSettle.h"

#include "app/base/VisibilityWatcher.h"
#include "app/base/filePath.h"
#include "app/document/scanScenario.h"
#include "app/features/evaluate/ExperimentsPanel.h"
#include "app/features/evaluate/SweepPanel.h"
#include "app/features/events/ComparePanel.h"
#include "app/features/events/Comparer.h"
#include "app/features/survey/SurveyPanel.h"
#include "app/headless/settleViews.h"
#include "app/lessons/LessonGuide.h"
#include "app/views/WindowViews.h"
#include "app/window/MainWindow.h"
#include "base/oneLine.h"

#include <QEventLoop>

#include <algorithm>
#include <memory>

namespace faintline {

namespace {

    void adjust(AnalysisSettings &settings, const RenderOptions &options)
    {
        if (!options.preset.empty())
            settings = preset(options.preset).settings;
        if (options.channel)
            setSetting(settings, "selection.channel", std::to_string(*options.channel));
        std::vector<std::string> all = options.part.assignments();
        all.insert(all.end(), options.settings.begin(), options.settings.end());
        for (const std::string &assignment : all) {
            const std::size_t equals = assignment.find('=');
            if (equals == std::string::npos)
                throw Error("--set " + assignment, "must be name=value");
            setSetting(settings, assignment.substr(0, equals), assignment.substr(equals + 1));
        }
        checkSettings(settings);
    }

    /// Settings of A: the common ones and A's own.
    RenderOptions optionsOfA(RenderOptions options)
    {
        if (!options.presetA.empty())
            options.preset = options.presetA;
        options.settings.insert(options.settings.end(), options.settingsA.begin(), options.settingsA.end());
        return options;
    }

    /// A source that is no recording has few views; throws Error if another one is requested.
    void offerOnly(const std::vector<std::string> &offered, const char *ofWhat, const std::vector<std::string> &views)
    {
        for (const std::string &view : views)
            if (std::find(offered.begin(), offered.end(), view) == offered.end())
                throw Error("--view " + view,
                            std::string("requires a recording; views of ") + ofWhat + " are " + listed(offered));
    }

} // namespace

AnalysisSettings openAndSettle(MainWindow &window, const RenderOptions &options)
{
    const auto settingsOfB = std::make_shared<AnalysisSettings>();
    const auto adjustBoth = [options, settingsOfB](AnalysisSettings &settings) {
        *settingsOfB = settings;
        adjust(*settingsOfB, options);
        adjust(settings, optionsOfA(options));
    };
    runAndSettle(window.controller(), [&] { window.open(pathText(options.source), options.opening, adjustBoth); });
    return *settingsOfB;
}

void compareWithA(MainWindow &window, const AnalysisSettings &settings)
{
    window.comparer().setMeasuringCost(false);
    window.panel<ComparePanel>().keep();
    runAndSettle(window.controller(), [&] { window.controller().setSettings(settings, QStringLiteral("B")); });
    window.showView(QStringLiteral("compare"));
    window.comparer().setActive(true);
    settle(window.comparer());
}

void testScans(MainWindow &window, const RenderOptions &options)
{
    offerOnly({"window", "sequential", "walk", "stopping", "posterior", "scan", "asn", "prior", "sectors"},
              "radar scans", options.views);
    if (!options.part.assignments().empty())
        throw Error("--from … --high", "require a recording; radar scans are simulated");
    ScanTest test = readScanTest(pathText(options.source));
    for (const std::string &assignment : options.settings)
        setScanTestField(test, assignment);
    checkScanTest(test);
    testAndSettle(window, [&] { window.openScans(test); });
    if (!options.seconds)
        return;
    const double before = std::clamp(*options.seconds / test.scene.secondsPerStage, 0.0, double(stageLimit(test)));
    testAndSettle(window, [&] { window.sequentialTests().setStage(Index(before) + 1); });
}

void goThroughLesson(MainWindow &window, const RenderOptions &options)
{
    const Lesson lesson = readLesson(pathText(options.source));
    const int step = options.step.value_or(1);
    if (!options.settings.empty() || !options.preset.empty() || !options.part.assignments().empty())
        throw Error("--set", "cannot be combined with a lesson, which has its own settings");
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
    for (const QString &view : {QStringLiteral("why"), QStringLiteral("noisefit")})
        if (isInSight(*window.views().named(view)))
            showAndSettle(window, view);
}

void openSurvey(MainWindow &window, const RenderOptions &options)
{
    offerOnly({"window", "survey"}, "surveys", options.views);
    runAndSettle(window.panel<SurveyPanel>(), [&] { window.open(pathText(options.source)); });
}

void openExperiment(MainWindow &window, const RenderOptions &options)
{
    offerOnly({"window", "pd", "sweep"}, "experiments", options.views);
    if (!options.settings.empty() || !options.preset.empty() || !options.part.assignments().empty())
        throw Error("--set", "cannot be combined with an experiment, which has its own settings");
    window.panel<SweepPanel>().setMeasuringCost(false);
    runAndSettle(window.panel<ExperimentsPanel>(), [&] { window.open(pathText(options.source)); });
    settleExperiments(window);
}

} // namespace faintline
