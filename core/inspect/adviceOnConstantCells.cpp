#include "inspect/advice.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr Index examinedFrames = 200;
    constexpr Index observedFrames = 16;
    constexpr double constantVariance = 0.05; ///< relative to that of noise
    constexpr double mostCells = 0.9;

} // namespace

std::optional<Advice> adviceOnConstantCells(const Analysis &analysis, const RunContext &context)
{
    const NormalisedFrames &frames = *analysis.frames;
    const auto cells = std::size_t(frames.grid().size());
    const Index count = std::min(frames.time().count, examinedFrames);
    if (count < observedFrames)
        return {};
    const Index first = (frames.time().count - count) / 2;
    std::vector<float> y(cells);
    std::vector<double> sum(cells), squares(cells), observed(cells);
    for (Index frame = first; frame < first + count; ++frame) {
        context.checkpoint(0.0, "checking for noise");
        frames.read(frame, 1, y);
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const auto value = double(y[cell]);
            if (!(value >= 0.0))
                continue;
            sum[cell] += value;
            squares[cell] += value * value;
            observed[cell] += 1.0;
        }
    }
    std::size_t known = 0;
    std::size_t constant = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        if (observed[cell] < double(observedFrames))
            continue;
        ++known;
        const double mean = sum[cell] / observed[cell];
        constant += squares[cell] / observed[cell] - mean * mean <= constantVariance * mean * mean;
    }
    if (known == 0 || double(constant) < mostCells * double(known))
        return {};
    return Advice{"constantCells",
                  "the power of nearly every cell is constant in time; this recording contains no noise, so "
                  "false-alarm rates and SNR are meaningless",
                  {},
                  analysis.settings};
}

} // namespace faintline
