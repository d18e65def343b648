#include "spectrum/edgeCorrection.h"

#include "spectrum/FrameNormaliser.h"
#include "spectrum/levels.h"
#include "spectrum/medians.h"
#include "spectrum/observed.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr Index framesRead = 1024;
    constexpr Index mostValues = Index(1) << 24;
    constexpr float steep = 1.2f; ///< change of ln B between cells
    constexpr Index reach = 6;    ///< cells on either side of a steep place
    constexpr float mostNoise = 0.5f;

    /// Counts how often each cell's background changes steeply to the next cell.
    void countSteep(std::span<const float> ln, std::vector<Index> &counts)
    {
        for (std::size_t cell = 0; cell + 1 < ln.size(); ++cell)
            counts[cell] += std::abs(ln[cell + 1] - ln[cell]) > steep ? 1 : 0;
    }

    /// Cells near one that is steep in half of the frames.
    std::vector<bool> nearEdges(const std::vector<Index> &counts, Index frames)
    {
        const Index cells = std::ssize(counts);
        std::vector<bool> isNear(counts.size(), false);
        for (Index cell = 0; cell < cells; ++cell)
            if (2 * counts[std::size_t(cell)] >= frames)
                std::fill(isNear.begin() + std::max<Index>(0, cell - reach),
                          isNear.begin() + std::min(cells, cell + reach + 2), true);
        return isNear;
    }

} // namespace

std::vector<float> edgeCorrection(const Spectrogram &spectrogram, const NoiseBackground &background)
{
    const Index bins = spectrogram.frequency().count;
    const Index cells = background.frequency.count;
    const Index stride = spectrogram.time().count / framesRead;
    if (stride < spectrogram.settings().stepsPerWindow || bins * framesRead > mostValues)
        return {};
    std::vector<Index> observed; // frames outside gaps and digital silence
    std::vector<Index> counts(std::size_t(cells), 0);
    std::vector<float> ln(static_cast<std::size_t>(cells));
    for (Index frame = 0; frame < spectrogram.time().count; frame += stride) {
        if (!isObserved(spectrogram, frame))
            continue;
        background.readLnPower(spectrogram.time().value(double(frame)), ln);
        if (*std::max_element(ln.begin(), ln.end()) <= NoiseBackground::silence)
            continue;
        observed.push_back(frame);
        countSteep(ln, counts);
    }
    const std::vector<bool> isNear = nearEdges(counts, std::ssize(observed));
    if (std::ssize(observed) < framesRead / 2 || std::find(isNear.begin(), isNear.end(), true) == isNear.end())
        return {};

    FrameNormaliser normaliser(spectrogram, false);
    std::vector<float> ratios(observed.size() * std::size_t(bins));
    for (std::size_t i = 0; i < observed.size(); ++i) {
        const auto row = std::span(ratios).subspan(i * std::size_t(bins), std::size_t(bins));
        spectrogram.read(observed[i], 1, row);
        normaliser.normalise(row, background, spectrogram.time().value(double(observed[i])));
    }
    std::vector<float> correction(static_cast<std::size_t>(bins));
    columnMedians(ratios, correction);
    const double ofNoise = medianMean(int(observed.size()));
    for (Index bin = 0; bin < bins; ++bin) {
        float &value = correction[std::size_t(bin)];
        const Index cell = background.frequency.nearest(spectrogram.frequency().value(double(bin)));
        value = isNear[std::size_t(cell)] && value > 0.0f
                    ? std::clamp(float(std::log(double(value) / ofNoise)), -mostNoise, mostNoise)
                    : 0.0f;
    }
    return correction;
}

} // namespace faintline
