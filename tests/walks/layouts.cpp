// A small screen: every named layout leaves the pictures room.

#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "app/window/Panels.h"
#include "support/test.h"
#include "walks/Walk.h"
#include "widgets/pings/PingMap.h"

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr int least = 350; // pixels, each way, or as large an area if the pictures lie above each other
constexpr int lowest = 120;

bool isLargeEnough(const QWidget &picture)
{
    return picture.isVisible() && !picture.visibleRegion().isEmpty() && picture.width() >= least
           && picture.height() >= lowest && picture.width() * picture.height() >= least * least;
}

/// `name`: of the picture that is taken.
void lookAtPictures(Walk &walk, const QString &name)
{
    walk.waitUntil("large pictures in " + name, [&] {
        if (walk.window().pingBench().isVisible()) {
            const PingBench &bench = walk.window().pingBench();
            return isLargeEnough(*bench.input()) && isLargeEnough(*bench.output());
        }
        const Workbench &bench = walk.window().workbench();
        return isLargeEnough(*bench.input()) && isLargeEnough(*bench.output());
    });
    walk.waitUntil("a window within the screen",
                   [&] { return walk.window().screen()->availableGeometry().contains(walk.window().frameGeometry()); });
    walk.takePicture("layout-" + name.toLower().replace(u' ', u'-'));
}

void lookAtLayouts(Walk &walk, const QString &scenario)
{
    walk.start({":/scenarios/" + scenario.toStdString() + ".json"});
    walk.waitForText(scenario);
    walk.waitForResults();
    lookAtPictures(walk, scenario);
    for (const QString &name : Panels::layoutNames()) {
        walk.choose({"View", "Layout", name});
        lookAtPictures(walk, scenario + " " + name);
    }
}

void goThrough(Walk &walk)
{
    lookAtLayouts(walk, "sonar-crossing-targets");
    lookAtLayouts(walk, "faint-drifting-line");
    walk.choose({"View", "Theme", "Light"});
    walk.choose({"View", "Layout", "Researcher"});
    lookAtPictures(walk, "lines in light");
}

} // namespace

static const Registration registered("layouts",
                                     [](int argc, char **argv) { return Walk::run("layouts", argc, argv, goThrough); });
