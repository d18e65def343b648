#include "frames/channelCount.h"

#include <algorithm>

namespace faintline {

int channelCount(const SelectionSettings &selection)
{
    if (!selection.channels.empty() && selection.channels.front() < 0.0)
        throw fieldError("selection.channels", "all", "requires a recording; give the channels, such as 0, 1");
    return std::max(1, int(selection.channels.size()));
}

} // namespace faintline
