#include "inspect/advice.h"

#include "analyse/usable.h"

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

std::vector<Advice> advise(const Analysis &analysis, const RunContext &context)
{
    if (std::optional<Advice> silence = adviceOnSilence(analysis, context))
        return {*silence};
    std::vector<Advice> all;
    for (std::optional<Advice> one : {adviceOnConstantCells(analysis, context), adviceOnChannels(analysis, context),
                                      adviceOnSlopes(analysis), adviceOnCloseLines(analysis)})
        if (one)
            all.push_back(std::move(*one));
    return all;
}

} // namespace faintline
