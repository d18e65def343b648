// An engineer of sonar and radar: pings one after the other, the tracks in them, and tests on radar scans.

#include "app/features/inspect/StateSlicePanel.h"
#include "app/features/inspect/WhyPanel.h"
#include "app/features/opening/WelcomePage.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/features/sequential/TrajectoryPage.h"
#include "app/ping.h"
#include "support/find.h"
#include "support/test.h"
#include "walks/Walk.h"
#include "widgets/events/EventTable.h"
#include "widgets/pings/PingMap.h"
#include "widgets/table/ColumnTable.h"

using namespace faintline;
using namespace faintline::test;

namespace {

Index ping(Walk &walk)
{
    return pingShown(walk.window());
}

void openSonar(Walk &walk)
{
    walk.start();
    walk.click("Sonar targets that cross");
    walk.waitForText("sonar-crossing-targets");
    walk.waitForResults();
    walk.waitUntil("tracks", [&] { return walk.window().document().shownEvents().size() >= 5; });
    walk.takePicture("sonar-map");
}

/// Keys step from ping to ping, the map follows, from above as well.
void stepThroughPings(Walk &walk)
{
    PingBench &bench = walk.window().pingBench();
    const Index before = walk.see([&] { return ping(walk); });
    for (int i = 1; i <= 2; ++i) {
        walk.hand.press("l");
        walk.waitUntil("a ping later", [&] { return ping(walk) == before + i; });
    }
    walk.hand.press("j");
    walk.waitUntil("a ping earlier", [&] { return ping(walk) == before + 1; });
    walk.hand.press("p");
    walk.waitUntil("the map from above", [&] { return bench.output()->isPolar() && bench.input()->isPolar(); });
    walk.takePicture("sonar-polar");
    walk.click("From above");
    walk.waitUntil("the plane", [&] { return !bench.output()->isPolar(); });
}

/// From the table to the target, and why it was found.
void explainTarget(Walk &walk)
{
    EventTable &table = walk.window().eventTable();
    walk.clickTab("Events");
    walk.hand.click(
        walk.placeIn([&] { return table.table()->viewport(); },
                     [&] { return QPointF(table.table()->visualRect(table.table()->model()->index(0, 0)).center()); }));
    walk.waitUntil("a chosen track", [&] { return table.selectedEvent() != 0; });
    walk.hand.press("w");
    walk.waitUntil("the steps of its path", [&] {
        const WhyPanel &why = walk.window().panel<WhyPanel>();
        return why.isVisible() && why.explanation()
               && childOf<ColumnTable>(why, "The best path, newest step first").model()->rowCount() > 0;
    });
    walk.takePicture("sonar-why");
}

/// Maps side by side stay wide enough in the layout that is named for them.
void takeLayout(Walk &walk)
{
    walk.choose({"View", "Layout", "Active sonar"});
    walk.waitUntil("wide maps", [&] {
        const PingBench &bench = walk.window().pingBench();
        return walk.window().panel<StateSlicePanel>().isVisible() && bench.input()->width() >= 350
               && bench.output()->width() >= 350;
    });
    walk.takePicture("sonar-layout");
}

/// The radar's tests, from the welcome page.
void testScans(Walk &walk)
{
    walk.choose({"File", "Welcome page"});
    walk.click("A radar that looks until it can decide");
    walk.waitUntil("tests", [&] { return !walk.window().sequentialTests().walks().empty(); });
    walk.waitForResults();
    walk.waitUntil("the tests alone", [&] { return !walk.window().welcome().isVisible(); });
    walk.takePicture("radar-walks");
    const Index stage = walk.see([&] { return walk.window().sequentialTests().stage(); });
    walk.hand.press("j");
    walk.waitUntil("a stage earlier", [&] { return walk.window().sequentialTests().stage() == stage - 1; });
    walk.clickTab("Trajectory and scan");
    walk.waitUntil("the scan", [&] { return walk.window().panel<SequentialPanel>().trajectory().isVisible(); });
    walk.takePicture("radar-scan");
    walk.hand.press("l");
    walk.waitUntil("a stage later", [&] { return walk.window().sequentialTests().stage() == stage; });
    walk.clickTab("Sectors");
    walk.waitUntil("sectors", [&] { return walk.window().panel<SequentialPanel>().sectorsPage()->isVisible(); });
}

void goThrough(Walk &walk)
{
    openSonar(walk);
    stepThroughPings(walk);
    explainTarget(walk);
    takeLayout(walk);
    testScans(walk);
}

} // namespace

static const Registration registered("sonar",
                                     [](int argc, char **argv) { return Walk::run("sonar", argc, argv, goThrough); });
