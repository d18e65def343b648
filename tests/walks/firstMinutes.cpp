// The first five minutes, from an empty home: from the start page to a recording, its lines, and what can be asked.

#include "app/document/OutputLayers.h"
#include "app/features/inspect/WhyPanel.h"
#include "app/features/pictures/PlainInput.h"
#include "app/features/pictures/Workbench.h"
#include "support/test.h"
#include "walks/Walk.h"
#include "widgets/events/EventCard.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/StripPlot.h"

#include <QAction>
#include <QElapsedTimer>

#include <cstdio>

using namespace faintline;
using namespace faintline::test;

namespace {

/// Opens a recording of the start page; prints the seconds to its pictures and events.
void openFirst(Walk &walk)
{
    walk.start();
    walk.waitForText("Click a picture to open it.");
    walk.takePicture("first-0-start");
    const QPoint card = walk.placeOf("Song of a humpback whale");
    QElapsedTimer since;
    since.start();
    walk.hand.click(card);
    const auto seconds = [&](const char *what, const std::function<bool()> &isSo) {
        walk.waitUntil(what, isSo);
        std::printf("%s after %.1f s\n", what, 1e-3 * double(since.elapsed()));
        std::fflush(stdout);
    };
    Workbench &bench = walk.window().workbench();
    seconds("picture", [&] { return bench.isVisible() && bench.input()->picture() != nullptr; });
    walk.takePicture("first-1-picture");
    seconds("statistic", [&] { return bench.output()->picture() != nullptr; });
    seconds("lines", [&] { return walk.window().document().shownEvents().size() > 20; });
    walk.waitForResults();
    walk.takePicture("first-2-lines");
}

/// What is in view without being asked for.
void lookAround(Walk &walk)
{
    walk.waitUntil("what was found, above each other on one time axis", [&] {
        const Workbench &bench = walk.window().workbench();
        return bench.layers().layer() == OutputLayer::Presence && !bench.output()->isTimeVertical()
               && bench.input()->mapToGlobal(QPoint()).y() < bench.output()->mapToGlobal(QPoint()).y()
               && !bench.regulationPlot()->isVisible();
    });
    walk.waitUntil("a window within the screen",
                   [&] { return walk.window().screen()->availableGeometry().contains(walk.window().frameGeometry()); });
}

void askOfALine(Walk &walk)
{
    EventTable &table = walk.window().eventTable();
    walk.hand.click(walk.placeIn(*walk.window().workbench().input(), 28.0, 2600.0));
    walk.hand.press("n");
    walk.waitUntil("the card of the event", [&] {
        return table.selectedEvent() != 0 && table.card().isVisible() && table.card().text().contains("Hz");
    });
    walk.takePicture("first-3-card");
    walk.click("Why", "QToolButton");
    walk.waitUntil("why", [&] { return walk.window().panel<WhyPanel>().explanation() != nullptr; });
    walk.takePicture("first-4-why");
}

void lookAtTheLevels(Walk &walk)
{
    Workbench &bench = walk.window().workbench();
    walk.hand.press("f");
    walk.waitUntil("the statistic", [&] { return bench.layers().layer() == OutputLayer::Statistic; });
    walk.takePicture("first-5-statistic");
    walk.hand.press("f");
    walk.hand.press("shift+d");
    walk.waitUntil("plain dB", [&] { return bench.input()->isPlain(); });
    walk.takePicture("first-6-plain");
    walk.hand.press("shift+d");
    walk.waitUntil("dB over noise", [&] { return !bench.input()->isPlain(); });
}

/// Zooms to a call, analyses it alone, and takes that back.
void analyseWhatIsSeen(Walk &walk)
{
    WaterfallView &input = *walk.window().workbench().input();
    Document &document = walk.window().document();
    walk.hand.drag(walk.placeIn(input, 3.0, 2600.0), walk.placeIn(input, 8.0, 1500.0), "shift");
    walk.waitUntil("a part", [&] { return !document.viewport().showsAll(); });
    walk.hand.press("alt+Return");
    walk.waitUntil("its analysis", [&] { return document.settings().selection.highHz > 0.0; });
    walk.waitForResults();
    walk.takePicture("first-7-part");
    walk.hand.press("ctrl+z");
    walk.waitForResults();
    walk.waitUntil("the whole again", [&] { return document.viewport().full().time.high > 30.0; });
}

void present(Walk &walk)
{
    walk.hand.press("F6");
    walk.hand.press("F5");
    walk.waitUntil("the pictures alone",
                   [&] { return walk.window().isFullScreen() && !walk.window().eventTable().isVisible(); });
    walk.takePicture("first-8-presentation");
    walk.hand.press("Escape");
    walk.waitUntil("the window again", [&] { return walk.window().eventTable().isVisible(); });
    walk.takePicture("first-9-light");
}

void goThrough(Walk &walk)
{
    openFirst(walk);
    lookAround(walk);
    askOfALine(walk);
    lookAtTheLevels(walk);
    analyseWhatIsSeen(walk);
    present(walk);
}

} // namespace

static const Registration registered("firstMinutes", [](int argc, char **argv) {
    return Walk::run("firstMinutes", argc, argv, goThrough);
});
