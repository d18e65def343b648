// An analyst's hour: a recording from a file to judged events and back, by mouse and keys.

#include "app/features/pictures/Workbench.h"
#include "base/files/AtomicFile.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/writeRecording.h"
#include "support/find.h"
#include "support/lines.h"
#include "support/test.h"
#include "walks/Walk.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"

#include <qwt_plot_canvas.h>
#include <qwt_scale_map.h>

#include <QAbstractButton>
#include <QApplication>
#include <QDockWidget>
#include <QTableView>

#include <algorithm>
#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

/// Two lines that drift, and a strong one that stays.
void writeRecordingTo(const QString &path)
{
    LineScene lines = scene(1000.0, 180.0, 5);
    lines.lines = {line(120.0, 0.3, 20.0, 60.0, 7.0, 1.0), line(330.0, -0.25, 90.0, 60.0, 7.0, 1.0),
                   line(220.0, 0.0, 5.0, 160.0, 25.0, 1.0)};
    writeRecording(SimulatedRecording(lines), path.toStdString());
}

std::size_t eventCount(Walk &walk)
{
    return walk.window().document().shownEvents().size();
}

void waitForEvents(Walk &walk, std::size_t count)
{
    walk.waitForResults();
    walk.waitUntil(QStringLiteral("%1 events").arg(count), [&] { return eventCount(walk) == count; });
}

double threshold(Walk &walk)
{
    return walk.window().document().shownThreshold();
}

/// Opens the recording as the welcome page offers, and sets a window that suits lines that drift.
void open(Walk &walk)
{
    walk.start();
    walk.waitForText("Click a picture to open it.");
    walk.takePicture("analyst-welcome");
    walk.click("Open recording");
    walk.answerFileDialog("Open", walk.path("lines.wav"));
    walk.waitForText("lines.wav");
    walk.waitForResults();
    walk.takePicture("analyst-first");
    walk.choose({"View", "Layout", "Researcher"}); // for all of the settings
    walk.clickTab("All settings");
    walk.click("Section Selection"); // closes the section above
    walk.fillIn("Window length in s", "1");
    waitForEvents(walk, 3);
}

/// Keys and the mouse move the threshold; both are steps to undo.
void tuneThreshold(Walk &walk)
{
    walk.clickTab("Threshold");
    const double before = walk.see([&] { return threshold(walk); });
    walk.hand.click(walk.placeIn(*walk.window().workbench().output(), 170.0, 450.0));
    walk.hand.press("period");
    walk.waitUntil("a higher threshold", [&] { return threshold(walk) > before + 0.1; });
    walk.hand.press("comma");
    walk.waitUntil("the threshold of before", [&] { return threshold(walk) < before + 0.1; });
    walk.waitForResults();
    ExceedancePlot &plot = walk.window().thresholdPlot();
    const auto at = [&](double nats) {
        return walk.placeIn(
            [&] { return plot.canvas(); },
            [&] { return QPointF(plot.canvasMap(QwtAxis::XBottom).transform(nats), plot.canvas()->height() / 2); });
    };
    walk.hand.drag(at(before), at(before + 4.0));
    walk.waitForResults();
    walk.waitUntil("the dragged threshold", [&] { return std::abs(threshold(walk) - before - 4.0) < 0.5; });
    waitForEvents(walk, 3);
}

/// From event to event, where each is visible and marked.
void visitEvents(Walk &walk)
{
    EventTable &table = walk.window().eventTable();
    std::vector<int> visited;
    for (int i = 0; i < 3; ++i) {
        walk.hand.press("n");
        walk.waitUntil("the next event", [&] {
            return table.selectedEvent() != 0 && std::count(visited.begin(), visited.end(), table.selectedEvent()) == 0;
        });
        visited.push_back(walk.see([&] { return table.selectedEvent(); }));
    }
}

/// Chooses the event at a frequency by a click on its row.
void chooseEventAt(Walk &walk, double hz)
{
    EventTable &table = walk.window().eventTable();
    if (!walk.see([&] { return table.isVisible() && !table.visibleRegion().isEmpty(); }))
        walk.clickTab("Events");
    walk.hand.click(
        walk.placeIn([&] { return table.table()->viewport(); },
                     [&]() -> QPointF {
                         for (const Event &event : walk.window().document().shownEvents())
                             if (std::abs(event.position.front() - hz) < 10.0) {
                                 const std::vector<int> ids = shownIds(table);
                                 const auto row = std::find(ids.begin(), ids.end(), event.id) - ids.begin();
                                 return table.table()->visualRect(table.table()->model()->index(int(row), 0)).center();
                             }
                         return {-1, -1};
                     }));
    walk.waitUntil("a chosen event", [&] { return table.selectedEvent() != 0; });
}

/// Zooms with Shift and the mouse, and back.
void zoom(Walk &walk)
{
    WaterfallView &output = *walk.window().workbench().output();
    walk.hand.press("0");
    walk.hand.drag(walk.placeIn(output, 15.0, 100.0), walk.placeIn(output, 85.0, 160.0), "shift");
    walk.waitUntil("a zoomed picture", [&] {
        const Span hz = walk.window().document().viewport().frequency();
        return std::abs(hz.low - 100.0) < 5.0 && std::abs(hz.high - 160.0) < 5.0;
    });
    walk.takePicture("analyst-zoom");
    walk.hand.press("BackSpace");
    walk.waitUntil("the whole", [&] { return walk.window().document().viewport().showsAll(); });
}

/// Measures a box, and analyses it alone, from the picture's own menu.
void analyseBox(Walk &walk)
{
    WaterfallView &output = *walk.window().workbench().output();
    walk.hand.press("m");
    walk.waitUntil("measuring", [&] { return output.display().isMeasuring(); });
    walk.hand.drag(walk.placeIn(output, 80.0, 290.0), walk.placeIn(output, 160.0, 350.0));
    walk.waitUntil("a measured box", [&] { return walk.window().document().box().has_value(); });
    walk.takePicture("analyst-box");
    walk.hand.clickRight(walk.placeIn(output, 100.0, 340.0));
    walk.pick("Analyse this box");
    waitForEvents(walk, 1);
    walk.takePicture("analyst-in-box");
    walk.choose({"Analyse", "Analyse the whole recording"});
    waitForEvents(walk, 3);
    walk.hand.press("m");
    walk.waitUntil("no more measuring", [&] { return !output.display().isMeasuring(); });
}

/// Accepts, rejects and classifies events: in the table as in the picture.
void judge(Walk &walk)
{
    const auto reviewOf = [&](auto holds) {
        const std::vector<Review> &reviews = walk.window().document().annotations().reviews;
        return std::any_of(reviews.begin(), reviews.end(), holds);
    };
    chooseEventAt(walk, 120.0);
    walk.hand.press("y");
    walk.waitUntil("an accepted event",
                   [&] { return reviewOf([](const Review &one) { return one.verdict == Verdict::Accepted; }); });
    chooseEventAt(walk, 220.0);
    walk.hand.press("x");
    walk.waitUntil("a rejected event",
                   [&] { return reviewOf([](const Review &one) { return one.verdict == Verdict::Rejected; }); });
    chooseEventAt(walk, 329.0);
    walk.hand.press("2");
    walk.waitUntil("a classified event",
                   [&] { return reviewOf([](const Review &one) { return one.label == "class 2"; }); });
    walk.takePicture("analyst-judged");
}

/// What was found goes to a file; then keys reach the picture again.
void exportEvents(Walk &walk)
{
    walk.hand.press("ctrl+shift+e");
    walk.answerFileDialog("Export events and annotations", walk.path("found.csv"));
    walk.waitUntil("a table in a file", [&] {
        QFile file(walk.path("found.csv"));
        return file.open(QIODevice::ReadOnly) && file.readAll().contains("class 2");
    });
    walk.waitForText("Written");
    walk.hand.press("n"); // keys still reach the window
    walk.waitUntil("an event after the dialog", [&] { return walk.window().eventTable().selectedEvent() != 0; });
}

/// Quitting offers to save; what was saved is there again.
void saveAndReturn(Walk &walk)
{
    walk.hand.press("ctrl+s");
    walk.answerFileDialog("Save session", walk.path("day"));
    walk.waitUntil("a session", [&] { return QFileInfo::exists(walk.path("day.faintline")); });
    walk.waitUntil("nothing to save", [&] { return !walk.window().isWindowModified(); });
    const double before = walk.see([&] { return threshold(walk); });
    walk.hand.press("ctrl+q");
    walk.waitUntil("no window", [&] { return !walk.window().isVisible(); });
    walk.start({walk.path("day.faintline").toStdString()});
    waitForEvents(walk, 3);
    walk.waitUntil("settings and reviews of before", [&] {
        return std::abs(threshold(walk) - before) < 1e-6 && walk.window().document().annotations().reviews.size() == 3;
    });
    walk.waitForText("day.faintline");
    walk.takePicture("analyst-again");
}

/// A command by its name; the focus is in the table before.
void findCommand(Walk &walk)
{
    walk.clickTab("Events");
    walk.hand.press("ctrl+k");
    walk.waitUntil("the palette", [&] { return walk.window().findChild<QWidget *>("commandPalette")->isVisible(); });
    walk.takePicture("analyst-palette");
    walk.hand.type("show all");
    walk.hand.press("Return");
    walk.waitUntil("no palette", [&] { return !walk.window().findChild<QWidget *>("commandPalette")->isVisible(); });
}

/// The events in a window of their own, where keys work, and as large as the window, below the palette; and back.
void floatEvents(Walk &walk)
{
    EventTable &table = walk.window().eventTable();
    auto *dock = walk.window().findChild<QDockWidget *>("eventsDock");
    auto *palette = walk.window().findChild<QWidget *>("commandPalette");
    const auto clickFloat = [&] {
        auto *button = dock->findChild<QAbstractButton *>("qt_dockwidget_floatbutton");
        walk.hand.click(walk.placeIn([&]() -> QWidget * { return button; }, [&] { return button->rect().center(); }));
    };
    walk.clickTab("Events");
    clickFloat();
    walk.waitUntil("a floating panel", [&] { return dock->isFloating(); });
    chooseEventAt(walk, 120.0);
    walk.takePicture("analyst-floating");
    const int before = walk.see([&] { return table.selectedEvent(); });
    walk.hand.press("n");
    walk.waitUntil("the next event", [&] { return table.selectedEvent() != before; });
    clickFloat();
    walk.waitUntil("the panel in its place", [&] { return !dock->isFloating() && !dock->visibleRegion().isEmpty(); });
    chooseEventAt(walk, 120.0);
    walk.hand.press("F11");
    walk.waitUntil("a panel as large as the window",
                   [&] { return dock->isFloating() && dock->size() == walk.window().size(); });
    walk.hand.press("ctrl+k");
    walk.waitUntil("the palette above it", [&] {
        const QWidget *top = QApplication::widgetAt(palette->mapToGlobal(palette->rect().center()));
        return palette->isVisible() && top && palette->isAncestorOf(top);
    });
    walk.takePicture("analyst-palette-above");
    walk.hand.press("Escape");
    walk.waitUntil("no palette", [&] { return !palette->isVisible(); });
    walk.hand.press("F11");
    walk.waitUntil("the panel in its place", [&] { return !dock->isFloating() && !dock->visibleRegion().isEmpty(); });
}

/// Quitting asks where something is lost: Cancel stays, Save keeps it, Discard does not.
void leaveUnsaved(Walk &walk)
{
    const auto isAsked = [&] {
        QWidget *dialog = QApplication::activeModalWidget();
        return dialog && dialog->windowTitle() == "Unsaved settings" && dialog->isActiveWindow();
    };
    const auto change = [&] {
        const double before = walk.see([&] { return threshold(walk); });
        walk.hand.click(walk.placeIn(*walk.window().workbench().output(), 170.0, 450.0));
        walk.hand.press("period");
        walk.waitUntil("a higher threshold", [&] { return threshold(walk) > before + 0.1; });
        walk.waitForResults();
    };
    const auto quit = [&](const QString &answer) {
        walk.hand.press("ctrl+q");
        walk.waitUntil("the question", isAsked);
        walk.takePicture("analyst-question");
        walk.click(answer, "QPushButton");
        walk.waitUntil("the answer", [&] { return !QApplication::activeModalWidget(); });
    };
    change();
    const double saved = walk.see([&] { return threshold(walk); });
    quit("Cancel");
    walk.waitUntil("the window still", [&] { return walk.window().isVisible() && walk.window().isWindowModified(); });
    quit("Save");
    walk.waitUntil("no window", [&] { return !walk.window().isVisible(); });
    walk.start({walk.path("day.faintline").toStdString()});
    waitForEvents(walk, 3);
    walk.waitUntil("what was saved", [&] { return std::abs(threshold(walk) - saved) < 1e-6; });
    change();
    quit("Discard");
    walk.waitUntil("no window", [&] { return !walk.window().isVisible(); });
    walk.start({walk.path("day.faintline").toStdString()});
    waitForEvents(walk, 3);
    walk.waitUntil("what was saved before", [&] { return std::abs(threshold(walk) - saved) < 1e-6; });
}

void goThrough(Walk &walk)
{
    writeRecordingTo(walk.path("lines.wav"));
    open(walk);
    tuneThreshold(walk);
    visitEvents(walk);
    zoom(walk);
    analyseBox(walk);
    judge(walk);
    exportEvents(walk);
    findCommand(walk);
    floatEvents(walk);
    saveAndReturn(walk);
    leaveUnsaved(walk);
}

} // namespace

static const Registration registered("analyst",
                                     [](int argc, char **argv) { return Walk::run("analyst", argc, argv, goThrough); });
