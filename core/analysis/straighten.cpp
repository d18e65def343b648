#include "analysis/straighten.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/logmath.h"
#include "recording/Recording.h"
#include "spectrum/Fft.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace faintline {

namespace {

    constexpr double usualFrames = 32.0;    ///< of the period that is halved
    constexpr double leastCells = 0.1;      ///< standard deviation of a position, so that none counts for all
    constexpr double bandDeviations = 3.29; ///< 5 to 95 % of a normal law

    double weightOf(const Track &track, std::size_t point)
    {
        if (track.smoothed.empty())
            return 1.0;
        const SmoothedPoint &p = track.smoothed[point];
        const double deviation = std::max(leastCells, static_cast<double>(p.high - p.low) / bandDeviations);
        return static_cast<double>(p.presence) / (deviation * deviation);
    }

    /// Whittaker's smoother; `stiffness` in units of the mean weight.
    std::vector<double> whittaker(const std::vector<double> &values, const std::vector<double> &weights,
                                  double stiffness)
    {
        const auto n = static_cast<Eigen::Index>(values.size());
        if (n < 3)
            return values;
        const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / static_cast<double>(n);
        std::vector<Eigen::Triplet<double>> entries;
        Eigen::VectorXd right(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const double weight = weights[static_cast<std::size_t>(i)] / mean;
            entries.emplace_back(i, i, weight);
            right[i] = weight * values[static_cast<std::size_t>(i)];
        }
        constexpr std::array<double, 3> difference{1.0, -2.0, 1.0};
        for (Eigen::Index i = 0; i + 2 < n; ++i)
            for (Eigen::Index a = 0; a < 3; ++a)
                for (Eigen::Index b = 0; b < 3; ++b)
                    entries.emplace_back(i + a, i + b,
                                         stiffness * difference[static_cast<std::size_t>(a)]
                                             * difference[static_cast<std::size_t>(b)]);
        Eigen::SparseMatrix<double> matrix(n, n);
        matrix.setFromTriplets(entries.begin(), entries.end());
        const Eigen::VectorXd solution = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
        return {solution.begin(), solution.end()};
    }

} // namespace

FrequencyCurve smoothFrequency(const AnalysisPlan &plan, const Track &track, double smoothingSeconds)
{
    const Axis &time = plan.time();
    const Axis &frequency = plan.grid().axes.back();
    const double period = smoothingSeconds > 0.0 ? smoothingSeconds / time.step : usualFrames;
    if (!(period >= 2.0))
        throw Error("smoothing over " + formatNumber(smoothingSeconds) + " s",
                    "must be at least two frames, " + formatNumber(2.0 * time.step) + " s");
    std::vector<double> hz;
    std::vector<double> weights;
    for (std::size_t i = 0; i < track.points.size(); ++i) {
        hz.push_back(frequency.value(track.lastPosition(i, frequency)));
        weights.push_back(weightOf(track, i));
    }
    const double half = 2.0 * std::sin(std::numbers::pi / period);
    hz = whittaker(hz, weights, 1.0 / (half * half * half * half));
    // As it begins and ends, for a while.
    const auto beyond = static_cast<Index>(std::lround(0.5 * period));
    const std::size_t count = hz.size();
    const double rise = count > 1 ? hz[1] - hz[0] : 0.0;
    const double fall = count > 1 ? hz[count - 1] - hz[count - 2] : 0.0;
    std::vector<double> longer;
    for (Index i = beyond; i > 0; --i)
        longer.push_back(hz.front() - rise * static_cast<double>(i));
    longer.insert(longer.end(), hz.begin(), hz.end());
    for (Index i = 1; i <= beyond; ++i)
        longer.push_back(hz.back() + fall * static_cast<double>(i));
    Axis knots = time;
    knots.first = time.value(static_cast<double>(track.points.front().frame - beyond));
    knots.count = std::ssize(longer);
    return {knots, std::move(longer)};
}

namespace {

    /// A band of the recording around a frequency, mixed down and averaged over so many samples.
    std::vector<std::complex<double>> mixedDown(const Recording &recording, int channel, Index first, Index count,
                                                double cyclesPerSample, Index averaged)
    {
        const bool isComplex = recording.info().isComplex;
        std::vector<std::complex<double>> result;
        std::vector<float> samples(static_cast<std::size_t>(averaged * recording.info().floatsPerSample()));
        for (Index at = 0; at + averaged <= count; at += averaged) {
            recording.read(channel, first + at, averaged, samples);
            std::complex<double> sum = 0.0;
            for (Index n = 0; n < averaged; ++n) {
                const double cycles = cyclesPerSample * static_cast<double>(at + n);
                const auto i = static_cast<std::size_t>(n);
                const std::complex<double> x =
                    isComplex ? std::complex<double>(samples[2 * i], samples[2 * i + 1]) : samples[i];
                sum += x * std::polar(1.0, -2.0 * std::numbers::pi * (cycles - std::floor(cycles)));
            }
            result.push_back(sum);
        }
        return result;
    }

} // namespace

LineHeight heightInOneTransform(const Recording &recording, int channel, double fromSeconds, double toSeconds,
                                double hz, double halfBandHz)
{
    constexpr double oversampling = 4.0; // of the band, so that the average's own response is flat over it
    const double rate = recording.info().sampleRateHz;
    const auto averaged = std::max<Index>(1, static_cast<Index>(rate / (2.0 * oversampling * halfBandHz)));
    const auto first = static_cast<Index>(std::llround(fromSeconds * rate));
    const auto count = static_cast<Index>(std::llround((toSeconds - fromSeconds) * rate));
    const std::vector<std::complex<double>> band = mixedDown(recording, channel, first, count, hz / rate, averaged);
    constexpr std::size_t fewest = 16;
    if (band.size() < fewest)
        throw Error("one transform of " + formatNumber(toSeconds - fromSeconds) + " s",
                    "is too short for a band of ±" + formatNumber(halfBandHz) + " Hz");
    double largest = 0.0;
    for (const std::complex<double> &value : band)
        largest = std::max(largest, std::abs(value));
    const Fft fft(Fft::fastLength(2 * static_cast<int>(band.size())), Fft::Input::Complex);
    const auto buffer = fft.buffer();
    std::fill(buffer->input().begin(), buffer->input().end(), 0.0f);
    for (std::size_t n = 0; n < band.size(); ++n) {
        const double window =
            std::pow(std::sin(std::numbers::pi * (static_cast<double>(n) + 0.5) / static_cast<double>(band.size())), 2);
        const std::complex<double> value = largest > 0.0 ? window * band[n] / largest : 0.0;
        buffer->input()[2 * n] = static_cast<float>(value.real());
        buffer->input()[2 * n + 1] = static_cast<float>(value.imag());
    }
    fft.run(*buffer);
    const double step = rate / static_cast<double>(averaged) / fft.length();
    const auto reach = static_cast<Index>(halfBandHz / step);
    std::vector<float> powers;
    for (Index bin = -reach; bin <= reach; ++bin)
        powers.push_back(std::norm(buffer->output()[static_cast<std::size_t>((bin + fft.length()) % fft.length())]));
    const auto highest = std::max_element(powers.begin(), powers.end());
    const LineHeight height{hz + step * static_cast<double>(highest - powers.begin() - reach), 0.0};
    const auto power = static_cast<double>(*highest);
    const auto middle = powers.begin() + std::ssize(powers) / 2;
    std::nth_element(powers.begin(), middle, powers.end());
    return {height.hz, dbFromRatio(power / std::max(static_cast<double>(*middle), 1e-300))};
}

} // namespace faintline
