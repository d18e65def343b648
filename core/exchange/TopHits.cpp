#include "exchange/TopHits.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/json.h"
#include "base/oneLine.h"

#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <sstream>

namespace faintline {

namespace {

    constexpr double unixDay = 40587.0; // MJD of 1970-01-01
    constexpr double daySeconds = 86400.0;
    constexpr double megahertz = 1e6;

    __attribute__((format(printf, 1, 2))) std::string print(const char *format, ...)
    {
        std::array<char, 512> text{};
        va_list values;
        va_start(values, format);
        std::vsnprintf(text.data(), text.size(), format, values);
        va_end(values);
        return text.data();
    }

    /// The straight line through a track.
    struct TrackLine {
        double startHz;
        double slope;
    };

    TrackLine lineThrough(const Track &track, const Axis &time, const Axis &frequency)
    {
        const std::vector<std::size_t> present = track.presentPoints();
        const auto n = double(present.size());
        double meanTime = 0.0;
        double meanHz = 0.0;
        for (const std::size_t i : present) {
            meanTime += time.value(double(track.points[i].frame)) / n;
            meanHz += frequency.value(track.lastPosition(i, frequency)) / n;
        }
        double squares = 0.0;
        double products = 0.0;
        for (const std::size_t i : present) {
            const double t = time.value(double(track.points[i].frame)) - meanTime;
            squares += t * t;
            products += t * (frequency.value(track.lastPosition(i, frequency)) - meanHz);
        }
        const double slope = squares > 0.0 ? products / squares : 0.0;
        return {meanHz + slope * (time.first - meanTime), slope};
    }

    double snrAlong(const Analysis &analysis, const Track &track)
    {
        const Axis &frequency = analysis.grid().axes.back();
        std::vector<float> y(std::size_t(analysis.grid().size()));
        double sum = 0.0;
        double frames = 0.0;
        for (const std::size_t i : track.presentPoints()) {
            analysis.frames->read(track.points[i].frame, 1, y);
            const Index cell = Index(std::lround(track.lastPosition(i, frequency)));
            float largest = -1.0f;
            for (Index c = std::max<Index>(0, cell - 1); c <= std::min(cell + 1, frequency.count - 1); ++c)
                largest = y[std::size_t(c)] > largest ? y[std::size_t(c)] : largest;
            if (largest < 0.0f)
                continue;
            sum += gaussianDeviate(double(largest));
            frames += 1.0;
        }
        return frames > 0.0 ? sum / std::sqrt(frames) : 0.0;
    }

    /// The number after "NAME:" in a comment of the table.
    std::optional<double> numberBehind(const std::string &line, const std::string &name)
    {
        const std::size_t at = line.find(name + ":");
        if (at == std::string::npos)
            return std::nullopt;
        std::istringstream rest(line.substr(at + name.size() + 1));
        std::string word;
        rest >> word;
        return parseNumber(word);
    }

    void readComment(const std::string &line, TopHits &table)
    {
        if (const std::size_t at = line.find("Source:"); at != std::string::npos)
            table.source = line.substr(at + 7);
        if (const auto mjd = numberBehind(line, "MJD"); mjd && *mjd > unixDay && *mjd < 1e6)
            table.startUnixSeconds = (*mjd - unixDay) * daySeconds;
        table.frameSeconds = numberBehind(line, "DELTAT").value_or(table.frameSeconds);
        table.channelHz = std::abs(numberBehind(line, "DELTAF(Hz)").value_or(table.channelHz));
        table.durationSeconds = numberBehind(line, "obs_length").value_or(table.durationSeconds);
    }

    TopHit hitFrom(const std::string &line, const std::string &where)
    {
        constexpr std::size_t columns = 12;
        std::istringstream words(line);
        std::vector<double> numbers;
        for (std::string word; words >> word;) {
            const auto number = parseNumber(word);
            numbers.push_back(number && std::isfinite(*number) ? *number : std::nan(""));
        }
        if (numbers.size() != columns || std::isnan(numbers[1]) || std::isnan(numbers[2]) || std::isnan(numbers[3])
            || !(numbers[5] >= 0.0 && numbers[5] < 1e15))
            throw Error(where, "is not a row of a table of hits: expected twelve numbers, with the drift second, the "
                               "SNR third and the frequency in MHz fourth");
        return {numbers[1],
                numbers[2],
                megahertz * numbers[3],
                Index(numbers[5]),
                megahertz * std::min(numbers[6], numbers[7]),
                megahertz * std::max(numbers[6], numbers[7])};
    }

    /// The strongest hit of `other` that is the same signal as one of `first`; null where there is none.
    const TopHit *sameSignal(const TopHit &hit, const TopHits &first, const TopHits &other, double slackHz)
    {
        const double seconds = *other.startUnixSeconds - *first.startUnixSeconds;
        const double expected = hit.startHz + hit.driftHzPerSecond * seconds;
        const double step = std::max(first.driftStep(), other.driftStep());
        const double reach =
            slackHz + 2.0 * std::max(first.channelHz, other.channelHz) + 0.5 * step * std::abs(seconds);
        const TopHit *best = nullptr;
        for (const TopHit &each : other.hits)
            if (std::abs(each.startHz - expected) <= reach
                && std::abs(each.driftHzPerSecond - hit.driftHzPerSecond) <= 2.0 * step
                && (!best || each.snr > best->snr))
                best = &each;
        return best;
    }

} // namespace

double gaussianDeviate(double y)
{
    constexpr double quantileReach = 600.0; // of e^-y as a double
    if (!(y > std::numbers::ln2))
        return 0.0;
    if (y < quantileReach)
        return boost::math::quantile(boost::math::complement(boost::math::normal(), std::exp(-y)));
    double z = std::sqrt(2.0 * y); // Q(z) ≈ e^(-z²/2)/(z √2π)
    for (int pass = 0; pass < 8; ++pass)
        z = std::sqrt(2.0 * (y - std::log(z * std::sqrt(2.0 * std::numbers::pi))));
    return z;
}

TopHits topHits(const Analysis &analysis, const Observation &observation, double leastSnr)
{
    if (!analysis.grid().isSpectrum())
        throw Error("a table of hits (.dat)",
                    "requires frames with a frequency axis only; these have more than one axis");
    const Axis &time = analysis.time();
    const Axis &frequency = analysis.grid().axes.back();
    TopHits table;
    table.source = observation.name;
    if (observation.startUnixSeconds)
        table.startUnixSeconds = *observation.startUnixSeconds + time.first;
    table.frameSeconds = time.step;
    table.channelHz = frequency.step;
    table.durationSeconds = time.step * double(time.count);
    for (const Track &track : analysis.tracks) {
        const TrackLine line = lineThrough(track, time, frequency);
        TopHit hit{line.slope,
                   snrAlong(analysis, track),
                   line.startHz + observation.centreHz,
                   frequency.nearest(line.startHz),
                   0.0,
                   0.0};
        hit.lowHz = hit.highHz = frequency.value(track.lastPosition(0, frequency)) + observation.centreHz;
        for (std::size_t i = 0; i < track.points.size(); ++i) {
            const double hz = frequency.value(track.lastPosition(i, frequency)) + observation.centreHz;
            hit.lowHz = std::min(hit.lowHz, hz);
            hit.highHz = std::max(hit.highHz, hz);
        }
        if (hit.snr >= leastSnr)
            table.hits.push_back(hit);
    }
    std::stable_sort(table.hits.begin(), table.hits.end(),
                     [](const TopHit &a, const TopHit &b) { return a.snr > b.snr; });
    return table;
}

std::string topHitsText(const TopHits &table)
{
    const std::string rule = "# -------------------------- o --------------------------\n";
    const double mjd = table.startUnixSeconds ? *table.startUnixSeconds / daySeconds + unixDay : 0.0;
    std::string text = rule + "# File ID: " + table.source + " \n" + rule + "# Source:" + table.source + "\n";
    text += print("# MJD: %18.12f\tRA: unknown\tDEC: unknown\n", mjd);
    text += print("# DELTAT: %10.6f\tDELTAF(Hz): %10.6f\tobs_length: %.6f\n", table.frameSeconds, table.channelHz,
                  table.durationSeconds);
    text += "# --------------------------\n# Top_Hit_# \tDrift_Rate \tSNR \tUncorrected_Frequency "
            "\tCorrected_Frequency \tIndex \tfreq_start \tfreq_end \tSEFD \tSEFD_freq \tCoarse_Channel_Number "
            "\tFull_number_of_hits \t\n# --------------------------\n";
    for (std::size_t i = 0; i < table.hits.size(); ++i) {
        const TopHit &hit = table.hits[i];
        text += print("%03zu\t%10.6f\t%10.6f\t%14.6f\t%14.6f\t%td\t%14.6f\t%14.6f\t0.0\t%14.6f\t0\t%zu\t\n", i + 1,
                      hit.driftHzPerSecond, hit.snr, hit.startHz / megahertz, hit.startHz / megahertz, hit.channel,
                      hit.lowHz / megahertz, hit.highHz / megahertz, 0.0, table.hits.size());
    }
    return text;
}

TopHits readTopHits(const std::string &path)
{
    constexpr std::size_t longestLine = 4096;
    constexpr std::size_t mostHits = 1'000'000;
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw Error(path, "cannot be read");
    TopHits table;
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        const std::string where = path + ", line " + std::to_string(number);
        if (line.size() > longestLine || table.hits.size() >= mostHits)
            throw Error(where, "is not a table of at most a million hits");
        if (line.starts_with('#'))
            readComment(line, table);
        else if (line.find_first_not_of(" \t\r") != std::string::npos)
            table.hits.push_back(hitFrom(line, where));
    }
    const auto isSound = [](double value) { return value > 0.0 && std::isfinite(value); };
    if (!isSound(table.frameSeconds) || !isSound(table.channelHz) || !isSound(table.durationSeconds))
        throw Error(path,
                    "is not a table of hits: its comments must give DELTAT, DELTAF(Hz) and obs_length, each above 0");
    return table;
}

std::vector<CadenceEvent> findCadence(const std::vector<TopHits> &observations, double slackHz,
                                      const RunContext &context)
{
    if (observations.size() < 2)
        throw Error("a cadence", "needs at least two observations, alternately on and off target");
    for (const TopHits &each : observations)
        if (!each.startUnixSeconds)
            throw Error(oneLine(each.source), "does not give its start time (MJD), which a cadence requires");
    const TopHits &first = observations.front();
    std::vector<CadenceEvent> events;
    for (const TopHit &hit : first.hits) {
        context.checkpoint(double(&hit - first.hits.data()) / double(first.hits.size()), "comparing observations");
        CadenceEvent event{{hit}};
        bool isOnTargetOnly = true;
        for (std::size_t i = 1; i < observations.size() && isOnTargetOnly; ++i) {
            const TopHit *same = sameSignal(hit, first, observations[i], slackHz);
            const bool isOn = i % 2 == 0;
            isOnTargetOnly = isOn == (same != nullptr);
            if (same && isOn)
                event.hits.push_back(*same);
        }
        if (isOnTargetOnly)
            events.push_back(std::move(event));
    }
    context.checkpoint(1.0, "comparing observations");
    return events;
}

std::string cadenceCsv(const std::vector<CadenceEvent> &events)
{
    std::string text = "event,observation,frequency_hz,drift_hz_per_s,snr\n";
    for (std::size_t number = 0; number < events.size(); ++number)
        for (std::size_t i = 0; i < events[number].hits.size(); ++i) {
            const TopHit &hit = events[number].hits[i];
            text += std::to_string(number + 1) + "," + std::to_string(2 * i + 1) + "," + formatNumber(hit.startHz) + ","
                    + formatNumber(hit.driftHzPerSecond) + "," + formatNumber(hit.snr) + "\n";
        }
    return text;
}

} // namespace faintline
