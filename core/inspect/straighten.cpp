#include "inspect/straighten.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/logmath.h"
#include "noise/levels.h"
#include "refine/smoothFrequency.h"
#include "signal/Fft.h"
#include "signal/StraightenedRecording.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <span>
#include <string>

namespace faintline {

namespace {

    /// Time and band in which an event's line, `multiple` times the curve, is examined.
    TimeBand stretchOf(const Analysis &analysis, const Event &event, const FrequencyCurve &curve, double multiple)
    {
        constexpr double leastCells = 40.0;
        const auto [least, most] = std::minmax_element(curve.hz().begin(), curve.hz().end());
        const double half = 0.5 * analysis.time().step;
        TimeBand stretch{analysis.settings.selection.channel, event.onsetSeconds - half, event.endSeconds + half,
                         0.5 * multiple * (*least + *most), 0.0};
        stretch.halfBandHz =
            std::max(2.0 * multiple * (*most - *least), leastCells / (stretch.toSeconds - stretch.fromSeconds));
        return stretch;
    }

    constexpr double oversampling = 4.0; ///< of the band, so that the averaging filter's response is flat over it
    constexpr Index averageMinimumSamples = 16;
    constexpr Index pathFrames = Index(1) << 22;
    constexpr Index runSamples = Index(1) << 18; ///< read at a time

    std::complex<double> turned(double cycles)
    {
        return std::polar(1.0, 2.0 * std::numbers::pi * (cycles - std::floor(cycles)));
    }

    struct SampleRange {
        int channel;
        Index first;
        Index count;
    };

    struct DownConversion {
        double cyclesPerSample; ///< of the mixer
        Index averaged;         ///< samples per value
    };

    /// Mixes the band around the mixer's frequency down to 0 Hz.
    std::vector<std::complex<double>> mixedDown(const Recording &recording, const SampleRange &range,
                                                const DownConversion &conversion, const RunContext &context)
    {
        const double cyclesPerSample = conversion.cyclesPerSample; // clang 14 captures no structured binding
        const Index averaged = conversion.averaged;
        constexpr Index exactEvery = 64; // samples; between them the mixer is advanced step by step
        const auto floats = std::size_t(recording.info().floatsPerSample());
        const std::complex<double> step = turned(-cyclesPerSample);
        const auto mixed = [&](std::span<const float> samples, Index at) {
            std::complex<double> sum = 0.0;
            std::complex<double> mixer;
            for (Index n = 0; n < averaged; ++n, mixer *= step) {
                if (n % exactEvery == 0)
                    mixer = turned(-cyclesPerSample * double(at + n));
                const auto i = std::size_t(n) * floats;
                sum += mixer * std::complex<double>(double(samples[i]), floats > 1 ? double(samples[i + 1]) : 0.0);
            }
            return sum / double(averaged);
        };
        // Reads long runs, because each read of a straightened recording computes blocks of its own.
        const Index run = averaged * std::max<Index>(1, runSamples / averaged);
        const Index end = range.count / averaged * averaged;
        std::vector<std::complex<double>> result;
        std::vector<float> samples;
        for (Index begin = 0; begin < end; begin += run) {
            context.checkpoint(double(begin) / double(range.count), "measuring the line");
            const Index count = std::min(run, end - begin);
            samples.resize(std::size_t(count) * floats);
            recording.read(range.channel, range.first + begin, count, samples);
            for (Index at = begin; at < begin + count; at += averaged)
                result.push_back(mixed(std::span(samples).subspan(std::size_t(at - begin) * floats), at));
        }
        return result;
    }

    /// |F{Hann·x}|² over twice the length, with x scaled to a maximum of 1, from the lowest frequency upward.
    std::vector<float> powerSpectrum(const std::vector<std::complex<double>> &x)
    {
        double largest = 0.0;
        for (const std::complex<double> &value : x)
            largest = std::max(largest, std::abs(value));
        const Fft fft(Fft::fastLength(2 * int(x.size())), Fft::Input::Complex);
        const auto buffer = fft.buffer();
        std::fill(buffer->input().begin(), buffer->input().end(), 0.0f);
        for (std::size_t n = 0; n < x.size() && largest > 0.0; ++n) {
            const double sine = std::sin(std::numbers::pi * (double(n) + 0.5) / double(x.size()));
            const std::complex<double> value = sine * sine * x[n] / largest;
            buffer->input()[2 * n] = float(value.real());
            buffer->input()[2 * n + 1] = float(value.imag());
        }
        fft.run(*buffer);
        std::vector<float> powers;
        for (const std::complex<float> &value : buffer->output())
            powers.push_back(std::norm(value));
        std::rotate(powers.begin(), powers.begin() + (std::ssize(powers) + 1) / 2, powers.end());
        return powers;
    }

    /// The middle of a stretch that is too long.
    TimeBand shortened(TimeBand stretch, double longest)
    {
        if (const double spare = stretch.toSeconds - stretch.fromSeconds - longest; spare > 0.0) {
            stretch.fromSeconds += 0.5 * spare;
            stretch.toSeconds -= 0.5 * spare;
        }
        return stretch;
    }

    struct PowerBand {
        std::vector<float> powers;
        double hz = 0.0;   ///< of the middle
        double step = 0.0; ///< Hz
        Index reach = 0;   ///< powers below the middle

        double hzAt(std::ptrdiff_t i) const { return hz + step * double(i - reach); }
        double median() const
        {
            std::vector<float> values = powers;
            return double(medianOf(values));
        }
    };

    PowerBand bandOf(const Recording &recording, const TimeBand &whole, const RunContext &context)
    {
        const double rate = recording.info().sampleRateHz;
        const auto refuse = [&whole] {
            throw Error("a spectrum of " + formatNumber(whole.toSeconds - whole.fromSeconds) + " s",
                        "is too short for a band of ±" + formatNumber(whole.halfBandHz) + " Hz");
        };
        if (!(whole.halfBandHz * (whole.toSeconds - whole.fromSeconds) > 1.0)) // a band of less than two cells
            refuse();
        const auto averaged = std::max<Index>(1, Index(rate / (2.0 * oversampling * whole.halfBandHz)));
        const TimeBand stretch = shortened(whole, double(pathFrames * averaged) / rate);
        const auto first = Index(std::llround(stretch.fromSeconds * rate));
        const auto count = Index(std::llround(stretch.toSeconds * rate)) - first;
        if (count / averaged < averageMinimumSamples)
            refuse();
        const std::vector<float> all = powerSpectrum(
            mixedDown(recording, {stretch.channel, first, count}, {stretch.hz / rate, averaged}, context));
        PowerBand band{{}, stretch.hz, rate / double(averaged * std::ssize(all)), 0};
        const Index middle = std::ssize(all) / 2; // of 0 Hz
        band.reach = std::min(middle, Index(stretch.halfBandHz / band.step));
        band.powers.assign(all.begin() + middle - band.reach,
                           all.begin() + std::min<Index>(std::ssize(all), middle + band.reach + 1));
        return band;
    }

} // namespace

Straightening straighteningOf(std::string_view name)
{
    const auto found = std::find(straighteningNames.begin(), straighteningNames.end(), name);
    if (found == straighteningNames.end())
        throw Error("method = " + std::string(name), "must be shift or resample");
    return Straightening(found - straighteningNames.begin());
}

Straightening usualStraightening(const AnalysisPlan &plan)
{
    return plan.settings.family.relation == FamilySettings::Relation::Harmonics ? Straightening::Resample
                                                                                : Straightening::Shift;
}

Straightened straightened(const Analysis &analysis, const Event &event, const StraightenChoice &choice)
{
    if (!analysis.recording)
        throw Error("straightening", "requires a recording; these are ready-made frames");
    const FamilySettings &family = analysis.settings.family;
    const int channel = analysis.settings.selection.channel;
    const FrequencyCurve curve =
        smoothFrequency(analysis, *trackOfId(analysis.tracks, event.id), choice.smoothingSeconds);
    const double target = choice.targetHz.value_or(curve.meanHz());
    const Straightening kind = choice.kind.value_or(usualStraightening(analysis));
    const bool isResampled = kind == Straightening::Resample;
    const double multiple =
        isResampled && family.relation == FamilySettings::Relation::Harmonics ? family.members.front() : 1.0;
    const TimeBand before = stretchOf(analysis, event, curve, multiple);
    TimeBand after = before;
    after.channel = 0;
    after.hz = multiple * target;
    if (!isResampled)
        return {std::make_shared<StraightenedRecording>(analysis.recording, channel, curve, target),
                curve,
                target,
                kind,
                before,
                after};
    const auto made = std::make_shared<ResampledRecording>(analysis.recording, channel, curve, target);
    after.fromSeconds = made->secondsOf(before.fromSeconds);
    after.toSeconds = made->secondsOf(before.toSeconds);
    return {made, curve, target, kind, before, after};
}

LineSpectrum lineSpectrum(const Recording &recording, const TimeBand &stretch, const RunContext &context)
{
    const PowerBand band = bandOf(recording, stretch, context);
    const double median = band.median();
    LineSpectrum spectrum;
    for (std::ptrdiff_t i = 0; i < std::ssize(band.powers); ++i) {
        spectrum.hz.push_back(band.hzAt(i));
        spectrum.db.push_back(dbFromRatio(double(band.powers[std::size_t(i)]) / median));
    }
    return spectrum;
}

LineHeight lineHeight(const Recording &recording, const TimeBand &stretch, const RunContext &context)
{
    const PowerBand band = bandOf(recording, stretch, context);
    const auto highest = std::max_element(band.powers.begin(), band.powers.end());
    return {band.hzAt(highest - band.powers.begin()), dbFromRatio(double(*highest) / band.median())};
}

} // namespace faintline
