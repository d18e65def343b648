#include "noise/noiseMean.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>
#include <vector>

namespace faintline {

double noiseMeanOf(const NormalisedFrames &frames)
{
    const Index count = frames.time().count;
    const Index some = std::min<Index>(count, 64);
    const auto cells = std::size_t(frames.grid().size());
    std::vector<float> frame(cells);
    std::vector<float> all;
    for (Index i = 0; i < some; ++i) {
        frames.read(i * count / some, 1, frame);
        std::copy_if(frame.begin(), frame.end(), std::back_inserter(all), [](float y) { return !std::isnan(y); });
    }
    if (all.empty())
        return 1.0;
    const auto middle = all.begin() + std::ssize(all) / 2;
    std::nth_element(all.begin(), middle, all.end());
    return double(*middle) / std::numbers::ln2;
}

std::string noiseMeanWarning(const NormalisedFrames &frames)
{
    const double mean = noiseMeanOf(frames);
    if (mean >= 0.5 && mean <= 2.0)
        return {};
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.2g", mean);
    return std::string("the mean of the noise is about ") + digits
           + ", not 1; threshold and false-alarm rate are "
             "valid for frames divided by it";
}

} // namespace faintline
