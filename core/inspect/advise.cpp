#include "inspect/advice.h"

#include "analyse/usable.h"
#include "base/logmath.h"
#include "base/numberText.h"

#include <algorithm>
#include <cmath>

namespace faintline {

void setWindow(Advice &advice, double seconds)
{
    const double decade = std::pow(10.0, std::floor(std::log10(seconds)) - 1.0);
    const double digits = std::round(seconds / decade);
    // 10⁻ⁿ has no exact double; an integer divided by 10ⁿ reads back as written
    const double rounded = decade < 1.0 ? digits / std::round(1.0 / decade) : digits * std::round(decade);
    advice.settings.spectrogram.windowSeconds = rounded;
    advice.remedy = "use a window of " + formatNumber(rounded) + " s";
}

bool isAsked(const Analysis &analysis, double windowSeconds)
{
    const double own = analysis.frames->geometry().windowSeconds;
    return std::ranges::any_of(analysis.others, [&](const auto &other) {
        const double seconds = other->frames->geometry().windowSeconds;
        return windowSeconds < own ? seconds <= windowSeconds : seconds >= windowSeconds;
    });
}

std::optional<Advice> adviceOnSilence(const Analysis &analysis, const RunContext &context)
{
    const Spectrogram *spectrogram = analysis.frames->spectrogram();
    if (!spectrogram || !analysis.background)
        return {};
    const std::string words = silenceWords(*spectrogram, *analysis.background, context);
    return words.empty() ? std::nullopt : std::optional(Advice{"silence", words, {}, analysis.settings});
}

std::optional<Advice> adviceOnStopBands(const Analysis &analysis)
{
    if (!analysis.recording || !analysis.background || analysis.background->stopBands.empty())
        return {};
    const std::vector<StopBand> &bands = analysis.background->stopBands;
    const Axis &axis = analysis.grid().axes.back();
    const auto words = [&](double hz) {
        return formatToStep(analysis.recording->info().centreHz + std::clamp(hz, axis.first, axis.last()),
                            10.0 * axis.step, 3);
    };
    const bool isOne = bands.size() == 1;
    Advice advice{
        "stopBand", words(bands.front().lowHz) + " … " + words(bands.front().highHz) + " Hz", {}, analysis.settings};
    if (!isOne)
        advice.sentence += " and " + words(bands.back().lowHz) + " … " + words(bands.back().highHz) + " Hz";
    advice.sentence += isOne ? " is not searched: it lies " : " are not searched: they lie ";
    advice.sentence += std::to_string(std::lround(dbFromRatio(std::exp(bands.front().natsBelow))))
                       + " dB below the band beside and follow" + (isOne ? "s" : "")
                       + " its level, as a filter's stop band does";
    advice.settings.selection.lowHz = std::max(bands.front().lowHz, axis.first);
    advice.settings.selection.highHz = std::min(bands.front().highHz, axis.last());
    advice.remedy = isOne ? "select that band to search it" : "select one of them to search it";
    return advice;
}

std::vector<Advice> advise(const Analysis &analysis, const RunContext &context)
{
    if (std::optional<Advice> silence = adviceOnSilence(analysis, context))
        return {*silence};
    std::vector<Advice> all;
    for (std::optional<Advice> one :
         {adviceOnConstantCells(analysis, context), adviceOnChannels(analysis, context), adviceOnSlopes(analysis),
          adviceOnCloseLines(analysis), adviceOnStopBands(analysis)})
        if (one)
            all.push_back(std::move(*one));
    return all;
}

} // namespace faintline
