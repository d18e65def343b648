// A small screen: every named layout leaves the pictures room.

#include "app/window/Panels.h"
#include "app/workspace/Workbench.h"
#include "walks/Walk.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QScreen>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr int leastWidth = 350; // pixels

bool isWideEnough(const QWidget &picture)
{
    return picture.isVisible() && !picture.visibleRegion().isEmpty() && picture.width() >= leastWidth;
}

void lookAtPictures(Walk &walk, const QString &name)
{
    Workbench &bench = walk.window().workbench();
    walk.waitUntil("wide pictures in " + name,
                   [&] { return isWideEnough(*bench.input()) && isWideEnough(*bench.output()); });
    walk.waitUntil("a window within the screen",
                   [&] { return walk.window().screen()->availableGeometry().contains(walk.window().frameGeometry()); });
    walk.takePicture("layout-" + name.toLower().replace(u' ', u'-'));
}

void goThrough(Walk &walk)
{
    walk.start({":/scenarios/faint-drifting-line.json"});
    walk.waitForText("faint-drifting-line");
    walk.waitForResults();
    lookAtPictures(walk, "first start");
    for (const QString &name : Panels::layoutNames()) {
        walk.choose({"View", "Panels", "Layout: " + name});
        lookAtPictures(walk, name);
    }
    walk.choose({"View", "Theme", "Light"});
    walk.choose({"View", "Panels", "Layout: Lines"});
    lookAtPictures(walk, "lines in light");
}

} // namespace

int main(int argc, char **argv)
{
    return Walk::run(argc, argv, goThrough);
}
