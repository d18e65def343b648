// A teacher's lesson: from the welcome page through all steps, shown to a class, with the law changed by hand.

#include "app/features/inspect/LawPanel.h"
#include "app/features/inspect/StateSlicePanel.h"
#include "app/features/inspect/WhyPanel.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/settings/PipelinePanel.h"
#include "app/lessons/LessonGuide.h"
#include "app/lessons/LessonPanel.h"
#include "support/find.h"
#include "support/test.h"
#include "walks/Walk.h"
#include "widgets/plot/LawPlot.h"

#include <qwt_plot_canvas.h>

#include <QDockWidget>

using namespace faintline;
using namespace faintline::test;

namespace {

LessonGuide &guide(Walk &walk)
{
    return walk.window().lessonGuide();
}

void waitForStep(Walk &walk, int step)
{
    walk.waitUntil(QStringLiteral("step %1").arg(step + 1),
                   [&] { return guide(walk).step() == step && isReady(guide(walk)); });
    walk.waitForResults();
}

void waitForTask(Walk &walk)
{
    walk.waitUntil("a task that is done", [&] { return guide(walk).panel().isDone(); });
}

void goOn(Walk &walk, int step)
{
    walk.click("Next");
    waitForStep(walk, step);
}

void answer(Walk &walk, const QString &choice)
{
    walk.click(choice, "QRadioButton");
    walk.waitForText("Right. ");
}

/// Only the lesson and the pictures, for a class; Escape ends it.
void present(Walk &walk)
{
    walk.hand.press("F5");
    walk.waitUntil("a full screen",
                   [&] { return walk.window().isFullScreen() && walk.window().size() == QSize(1280, 800); });
    walk.waitUntil("wide pictures", [&] {
        const Workbench &bench = walk.window().workbench();
        return bench.input()->width() >= 350 && bench.output()->width() >= 350;
    });
    walk.takePicture("teacher-presentation");
    walk.hand.press("Escape");
    walk.waitUntil("the window again", [&] {
        return !walk.window().isFullScreen() && guide(walk).dock()->isVisible()
               && walk.window().panel<PipelinePanel>().isVisible();
    });
    walk.takePicture("teacher-after-presentation");
}

/// The lesson's law is dragged by its bar in the panel of the state space.
void dragLaw(Walk &walk)
{
    walk.hand.click(walk.placeIn(*walk.window().workbench().output(), 60.0, 250.0));
    walk.hand.press("s");
    walk.waitUntil("the states", [&] { return walk.window().panel<StateSlicePanel>().isVisible(); });
    walk.clickTab("Law");
    const auto before = walk.see([&] { return walk.window().document().settings().model.slopeChange; });
    const auto plot = [&] { return walk.window().panel<StateSlicePanel>().law().findChild<LawPlot *>(); };
    const auto bar = [&](double height) {
        return walk.placeIn([&]() -> QWidget * { return plot() ? plot()->canvas() : nullptr; },
                            [&] { return plot()->canvasPosition(0.0, height); });
    };
    walk.hand.drag(bar(before.front() - 0.02), bar(before.front() - 0.22));
    walk.waitUntil("another law", [&] {
        return walk.window().document().settings().model.slopeChange.front() < before.front() - 0.1;
    });
    walk.waitForResults();
    walk.takePicture("teacher-law");
}

void goThrough(Walk &walk)
{
    walk.start();
    walk.takePicture("teacher-welcome");
    walk.click("4  Choosing h");
    waitForStep(walk, 0);
    walk.takePicture("teacher-step-1");
    answer(walk, "The faint one that stays");
    present(walk);
    goOn(walk, 1);
    walk.fillIn("Slope change law", "0.34, 0.33");
    waitForTask(walk);
    goOn(walk, 2);
    walk.hand.click(walk.placeIn(*walk.window().workbench().output(), 48.0, 250.0));
    waitForTask(walk);
    walk.takePicture("teacher-why");
    goOn(walk, 3);
    dragLaw(walk);
    walk.click("Finish");
    walk.waitUntil("the results", [&] { return guide(walk).panel().text().contains("Tasks done: 2 of 2"); });
    walk.takePicture("teacher-end");
    walk.click("Next lesson");
    walk.click("Discard"); // the law that was dragged
    walk.waitUntil("the next lesson",
                   [&] { return isReady(guide(walk)) && guide(walk).panel().text().contains("An assumption"); });
    walk.click("Leave");
    walk.waitUntil("no lesson", [&] { return !guide(walk).isRunning() && !guide(walk).dock()->isVisible(); });
}

} // namespace

static const Registration registered("teacher",
                                     [](int argc, char **argv) { return Walk::run("teacher", argc, argv, goThrough); });
