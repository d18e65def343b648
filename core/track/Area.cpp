#include "track/Area.h"

#include "track/constants.h"

#include <algorithm>

namespace faintline {

namespace {

    double sizeOf(const Area &area)
    {
        return double(area.lastFrame - area.firstFrame + 1) * double(area.lastCell - area.firstCell + 1);
    }

    bool isBeside(const Area &a, const Area &b)
    {
        return a.firstFrame <= b.lastFrame + 1 && b.firstFrame <= a.lastFrame + 1 && a.firstCell <= b.lastCell + 1
               && b.firstCell <= a.lastCell + 1;
    }

    Area united(const Area &a, const Area &b)
    {
        const auto frames = [](const Area &of) { return double(of.lastFrame - of.firstFrame + 1); };
        return {std::min(a.firstFrame, b.firstFrame), std::max(a.lastFrame, b.lastFrame),
                std::min(a.firstCell, b.firstCell), std::max(a.lastCell, b.lastCell),
                (a.level * frames(a) + b.level * frames(b)) / (frames(a) + frames(b))};
    }

} // namespace

std::vector<Area> joinAreas(std::vector<Area> areas)
{
    std::vector<Area> joined;
    std::vector<double> taken; // size of the parts of each
    for (Area area : areas) {
        double size = sizeOf(area);
        for (std::size_t other = 0; other < joined.size();) {
            const Area both = united(area, joined[other]);
            if (!isBeside(area, joined[other]) || sizeOf(both) > joinedAreaRatio * (size + taken[other])) {
                ++other;
                continue;
            }
            area = both;
            size = std::min(size + taken[other], sizeOf(both));
            joined.erase(joined.begin() + std::ptrdiff_t(other));
            taken.erase(taken.begin() + std::ptrdiff_t(other));
            other = 0; // a grown area may touch others that it did not touch before
        }
        joined.push_back(area);
        taken.push_back(size);
    }
    std::sort(joined.begin(), joined.end(), [](const Area &a, const Area &b) {
        return a.firstFrame != b.firstFrame ? a.firstFrame < b.firstFrame : a.firstCell < b.firstCell;
    });
    return joined;
}

} // namespace faintline
