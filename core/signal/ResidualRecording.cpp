#include "signal/ResidualRecording.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <utility>

namespace faintline {

namespace {

    constexpr double neighbourCells = 8.0; ///< lines further apart do not affect each other's amplitude
    constexpr Index silentRun = LineFit::silentSamples;
    constexpr std::string_view subtracting = "subtracting lines";

    using Complex = std::complex<double>;

    constexpr Index fitRun = LineFit::silentSamples;
    constexpr Index readSamples = 256 * fitRun; ///< samples per read
    constexpr double beyondWindows = 2.0;       ///< search range for the line's ends beyond the path's ends, T_FT
    constexpr double insideWindows = 4.0;       ///< distance inside the path's ends where the line is certainly present
    constexpr double slopeWindows = 8.0;        ///< over which its slope is extrapolated
    constexpr double stepWindows = 12.0;        ///< over which its phase is known beyond a fitted segment
    constexpr int mostSteps = 8;                ///< steps outward from there
    constexpr double shortestSegment = 0.25;    ///< minimum length of a fitted segment, T_FT
    constexpr std::size_t order = 4;            ///< order of the spline: coefficients per place

    Complex turned(double cycles)
    {
        return std::polar(1.0, 2.0 * std::numbers::pi * (cycles - std::floor(cycles)));
    }

    /// e^(iφ) of a run, where φ is the parabola with the curve's initial frequency and its phase at both ends.
    std::array<Complex, std::size_t(fitRun)> phasors(const FrequencyCurve &curve, double rate, Index first)
    {
        const double begin = double(first) / rate;
        const double step = curve.at(begin) / rate;
        const double change = (curve.at(double(first + fitRun) / rate) / rate - step) / double(fitRun);
        std::array<Complex, std::size_t(fitRun)> result;
        Complex factor = turned(curve.cyclesAt(begin));
        Complex rotation = turned(step + 0.5 * change);
        const Complex faster = turned(change);
        for (Complex &value : result) {
            value = factor;
            factor *= rotation;
            rotation *= faster;
        }
        return result;
    }

    /// The cubic B-splines that are non-zero at a place, and the index of the first.
    struct Basis {
        std::size_t first;
        std::array<double, order> weights;
    };

    Basis basisAt(double position, double intervals)
    {
        const double interval = std::clamp(std::floor(position), 0.0, intervals - 1.0);
        const double t = position - interval;
        const double s = 1.0 - t;
        return {std::size_t(interval),
                {s * s * s / 6.0, (t * t * (3.0 * t - 6.0) + 4.0) / 6.0, (s * s * (3.0 * s - 6.0) + 4.0) / 6.0,
                 t * t * t / 6.0}};
    }

    bool isSilent(std::span<const float> samples)
    {
        return std::all_of(samples.begin(), samples.end(), [](float value) { return value == 0.0f; });
    }

    Index runBefore(Index sample)
    {
        return sample - (sample % fitRun + fitRun) % fitRun;
    }

    /// Calls `each(first, samples)` for each run between two samples that is not silent; runs begin at multiples.
    template <class Each>
    void forRuns(const LineFit::FitSamples &samples, Index begin, Index end, Each each)
    {
        const Index floats = samples.info.floatsPerSample();
        std::vector<float> block;
        for (Index first = runBefore(begin); first < end; first += readSamples) {
            const Index count = std::min(readSamples, runBefore(end - first + fitRun - 1));
            block.resize(std::size_t(count * floats));
            samples.read(first, block);
            for (Index at = 0; at < count; at += fitRun)
                if (const auto one =
                        std::span<const float>(block).subspan(std::size_t(at * floats), std::size_t(fitRun * floats));
                    !isSilent(one))
                    each(first + at, one);
        }
    }

    Complex amplitudeAt(const std::vector<double> &coefficients, double position, double intervals)
    {
        const Basis basis = basisAt(position, intervals);
        double real = 0.0;
        double imaginary = 0.0;
        for (std::size_t i = 0; i < order; ++i) {
            real += basis.weights[i] * coefficients[2 * (basis.first + i)];
            imaginary += basis.weights[i] * coefficients[2 * (basis.first + i) + 1];
        }
        return {real, imaginary};
    }

} // namespace

ResidualRecording::ResidualRecording(RecordingPointer base, int channel, std::vector<LinePath> paths,
                                     const Recording *noise, const RunContext &context)
    : DerivedRecording(std::move(base)), m_channel(channel)
{
    std::vector<float> simulated;
    for (LinePath &path : paths) {
        const double done = double(m_lines.size()) / double(paths.size());
        std::vector<const LineFit *> near;
        for (const LineFit &line : m_lines)
            if (line.comesNear(path, neighbourCells))
                near.push_back(&line);
        const auto read = [&](Index first, std::span<float> out) {
            context.checkpoint(done, subtracting);
            const Index samples = std::ssize(out) / m_info.floatsPerSample();
            m_base->read(channel, first, samples, out);
            if (noise) {
                simulated.resize(out.size());
                noise->read(0, first, samples, simulated);
                std::transform(out.begin(), out.end(), simulated.begin(), out.begin(), std::minus<>());
            }
            for (const LineFit *line : near)
                line->subtractFrom(first, out);
        };
        m_lines.emplace_back(LineFit::FitSamples{m_info, read}, std::move(path));
    }
    m_info.notes.push_back(std::to_string(m_lines.size()) + " line(s) were subtracted from channel "
                           + std::to_string(channel) + ".");
}

void ResidualRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    if (channel != m_channel)
        return m_base->read(channel, first, count, out);
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        const Index floats = m_info.floatsPerSample();
        const Index begin = from / silentRun * silentRun;
        const Index end = (from + std::ssize(inside) / floats + silentRun - 1) / silentRun * silentRun;
        std::vector<float> runs(std::size_t((end - begin) * floats));
        m_base->read(channel, begin, end - begin, runs);
        for (const LineFit &line : m_lines)
            if (line.beginSample() < end && line.endSample() > begin)
                line.subtractFrom(begin, runs);
        std::copy_n(runs.begin() + (from - begin) * floats, inside.size(), inside.begin());
    });
}

double LineFit::AmplitudeSegment::intervals() const
{
    return double(coefficients.size() / 2 - (order - 1));
}

/// Normal equations of the coefficients, with real and imaginary parts alternating: a band matrix of width 2·order.
class LineFit::Equations
{
public:
    explicit Equations(std::size_t unknowns) : m_band(unknowns), m_right(Eigen::VectorXd::Zero(Eigen::Index(unknowns)))
    {
    }

    /// Adds a sample modelled as Re{ a·factor }.
    void add(const Basis &basis, Complex factor, double value)
    {
        std::array<double, width> row;
        for (std::size_t i = 0; i < order; ++i) {
            row[2 * i] = basis.weights[i] * factor.real();
            row[2 * i + 1] = -basis.weights[i] * factor.imag();
        }
        const std::size_t first = 2 * basis.first;
        for (std::size_t i = 0; i < width; ++i) {
            for (std::size_t j = i; j < width; ++j)
                m_band[first + i][j - i] += row[i] * row[j];
            m_right[Eigen::Index(first + i)] += row[i] * value;
        }
    }

    /// Undetermined coefficients, for instance in a silent stretch, are 0.
    std::vector<double> solution() const
    {
        constexpr double negligible = 1e-9;
        double largest = 0.0;
        for (const auto &row : m_band)
            largest = std::max(largest, row[0]);
        std::vector<Eigen::Triplet<double>> entries;
        for (std::size_t i = 0; i < m_band.size(); ++i)
            for (std::size_t d = 0; d < width && i + d < m_band.size(); ++d)
                entries.emplace_back(Eigen::Index(i + d), Eigen::Index(i),
                                     m_band[i][d] + (d == 0 ? negligible * largest : 0.0));
        const auto size = Eigen::Index(m_band.size());
        Eigen::SparseMatrix<double> lower(size, size);
        lower.setFromTriplets(entries.begin(), entries.end());
        using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>;
        if (largest == 0.0)
            return std::vector<double>(m_band.size(), 0.0);
        const Eigen::VectorXd found = Solver(lower).solve(m_right);
        return {found.begin(), found.end()};
    }

private:
    static constexpr std::size_t width = 2 * order;
    std::vector<std::array<double, width>> m_band; ///< each unknown with itself and the following ones
    Eigen::VectorXd m_right;
};

LineFit::LineFit(const FitSamples &samples, LinePath path)
    : m_path(std::move(path)), m_rate(samples.info.sampleRateHz), m_isComplex(samples.info.isComplex)
{
    const auto sampleAt = [&](double seconds) {
        return std::clamp<Index>(Index(std::llround(seconds * m_rate)), 0, samples.info.sampleCount);
    };
    const double window = m_path.windowSeconds;
    const AmplitudeSegment sure{
        sampleAt(m_path.fromSeconds + insideWindows * window), sampleAt(m_path.toSeconds - insideWindows * window), {}};
    if (double(sure.end - sure.begin) < 2.0 * window * m_rate) { // too short to extrapolate
        const AmplitudeSegment all{
            sampleAt(m_path.fromSeconds - 0.5 * window), sampleAt(m_path.toSeconds + 0.5 * window), {}};
        add(fitted(samples, all));
        return;
    }
    const Index first = sampleAt(m_path.fromSeconds - beyondWindows * window);
    const Index last = sampleAt(m_path.toSeconds + beyondWindows * window);
    follow(fitted(samples, sure), true, true);
    const AmplitudeSegment line{goOn(samples, sure, first), goOn(samples, sure, last), {}};
    follow(fitted(samples, line), true, true);
    add(fitted(samples, {first, line.begin, {}}));
    add(fitted(samples, line));
    add(fitted(samples, {line.end, last, {}}));
}

/// Extends the line outward step by step, because its phase is only known over a short distance.
Index LineFit::goOn(const FitSamples &samples, const AmplitudeSegment &sure, Index farthest)
{
    const bool isBegin = farthest < sure.begin;
    const auto reach = Index(stepWindows * m_path.windowSeconds * m_rate);
    Index known = isBegin ? sure.begin : sure.end;
    for (int step = 0; step < mostSteps; ++step) {
        const AmplitudeSegment end = isBegin ? AmplitudeSegment{known, std::min(sure.end, known + reach), {}}
                                             : AmplitudeSegment{std::max(sure.begin, known - reach), known, {}};
        if (step > 0)
            follow(fitted(samples, end), isBegin, !isBegin);
        const Index next = lineEnd(samples, fitted(samples, end), isBegin, farthest);
        if (next == known)
            break;
        known = next;
    }
    return known;
}

/// Corrects the path's curve by the amplitude's phase, and extends it straight beyond a segment at its beginning or end.
void LineFit::follow(const AmplitudeSegment &segment, bool isBegin, bool isEnd)
{
    const Axis &time = m_path.curve.time();
    const double intervals = segment.intervals();
    const double perSample = intervals / double(segment.end - segment.begin);
    const auto knotAt = [&](Index sample) {
        return std::clamp<Index>(Index(std::llround(time.position(double(sample) / m_rate))), 0, time.count - 1);
    };
    const Index from = knotAt(segment.begin);
    const Index to = knotAt(segment.end);
    std::vector<double> hz = m_path.curve.hz();
    for (Index knot = from; knot <= to; ++knot) {
        const double position = (time.value(double(knot)) * m_rate - double(segment.begin)) * perSample;
        const double middle = std::clamp(position, 0.5, intervals - 0.5);
        const Complex turn = amplitudeAt(segment.coefficients, middle + 0.5, intervals)
                             * std::conj(amplitudeAt(segment.coefficients, middle - 0.5, intervals));
        hz[std::size_t(knot)] += std::arg(turn) / (2.0 * std::numbers::pi) * perSample * m_rate;
    }
    const auto slope = [&](Index first, Index last) { // Hz per knot
        return (hz[std::size_t(last)] - hz[std::size_t(first)]) / double(std::max<Index>(1, last - first));
    };
    const auto reach = Index(std::lround(slopeWindows * m_path.windowSeconds / time.step));
    const double rise = slope(from, std::min(to, from + reach));
    const double fall = slope(std::max(from, to - reach), to);
    for (Index knot = 0; knot < from && isBegin; ++knot)
        hz[std::size_t(knot)] = hz[std::size_t(from)] + rise * double(knot - from);
    for (Index knot = to + 1; knot < time.count && isEnd; ++knot)
        hz[std::size_t(knot)] = hz[std::size_t(to)] + fall * double(knot - to);
    m_path.curve = FrequencyCurve(time, std::move(hz));
}

void LineFit::add(AmplitudeSegment segment)
{
    if (!segment.coefficients.empty())
        m_segments.push_back(std::move(segment));
}

LineFit::AmplitudeSegment LineFit::fitted(const FitSamples &samples, AmplitudeSegment segment) const
{
    const double length = double(segment.end - segment.begin) / (m_path.windowSeconds * m_rate);
    if (length < shortestSegment)
        return segment;
    const auto intervals = std::size_t(std::max(1.0, std::round(length)));
    const double perSample = double(intervals) / double(segment.end - segment.begin);
    Equations equations(2 * (intervals + order - 1));
    forRuns(samples, segment.begin, segment.end, [&](Index first, std::span<const float> values) {
        const auto factors = phasors(m_path.curve, m_rate, first);
        for (Index n = std::max(first, segment.begin); n < std::min(first + fitRun, segment.end); ++n) {
            const auto i = std::size_t(n - first);
            const Basis basis = basisAt(double(n - segment.begin) * perSample, double(intervals));
            equations.add(basis, factors[i], double(values[m_isComplex ? 2 * i : i]));
            if (m_isComplex)
                equations.add(basis, factors[i] * Complex(0.0, -1.0), double(values[2 * i + 1]));
        }
    });
    segment.coefficients = equations.solution();
    return segment;
}

/// Extrapolates the line beyond an end of the known part and finds where the energy that it explains, Σ 2·x·s - s², is
/// largest.
Index LineFit::lineEnd(const FitSamples &samples, const AmplitudeSegment &inner, bool isBegin, Index farthest) const
{
    const double intervals = inner.intervals();
    const double perSample = intervals / double(inner.end - inner.begin);
    const double edge = isBegin ? 0.0 : intervals;
    const double inward = isBegin ? 1.0 : -1.0;
    const Complex amplitude = amplitudeAt(inner.coefficients, edge, intervals);
    const Complex before = amplitudeAt(inner.coefficients, edge + inward, intervals);
    const double turns = std::arg(amplitude * std::conj(before)) / (2.0 * std::numbers::pi) * perSample;
    const Index known = isBegin ? inner.begin : inner.end;
    std::vector<double> gains(std::size_t(std::abs(known - farthest)), 0.0); // from the known end outward
    forRuns(samples, std::min(known, farthest), std::max(known, farthest),
            [&](Index first, std::span<const float> values) {
                const auto factors = phasors(m_path.curve, m_rate, first);
                for (Index n = first; n < first + fitRun; ++n) {
                    const Index outwards = isBegin ? known - 1 - n : n - known;
                    if (outwards < 0 || outwards >= std::ssize(gains))
                        continue;
                    const auto i = std::size_t(n - first);
                    const Complex s = amplitude * turned(turns * double(outwards)) * factors[i];
                    double gain = (2.0 * double(values[m_isComplex ? 2 * i : i]) - s.real()) * s.real();
                    if (m_isComplex)
                        gain += (2.0 * double(values[2 * i + 1]) - s.imag()) * s.imag();
                    gains[std::size_t(outwards)] = gain;
                }
            });
    double sum = 0.0;
    double most = 0.0;
    Index reach = 0;
    for (Index i = 0; i < std::ssize(gains); ++i)
        if (sum += gains[std::size_t(i)]; sum > most) {
            most = sum;
            reach = i + 1;
        }
    return isBegin ? known - reach : known + reach;
}

bool LineFit::comesNear(const LinePath &other, double cells) const
{
    const Axis &time = other.curve.time();
    for (Index i = 0; i < time.count; ++i) {
        const double seconds = time.value(double(i));
        const auto sample = Index(seconds * m_rate);
        if (sample >= beginSample() && sample < endSample()
            && std::abs(m_path.curve.at(seconds) - other.curve.hz()[std::size_t(i)]) * m_path.windowSeconds <= cells)
            return true;
    }
    return false;
}

void LineFit::subtractFrom(Index first, std::span<float> samples) const
{
    const Index floats = m_isComplex ? 2 : 1;
    const Index end = first + std::ssize(samples) / floats;
    for (const AmplitudeSegment &segment : m_segments) {
        const double intervals = segment.intervals();
        const double perSample = intervals / double(segment.end - segment.begin);
        for (Index at = std::max(first, runBefore(segment.begin)); at < std::min(end, segment.end); at += fitRun) {
            const auto values = samples.subspan(std::size_t((at - first) * floats), std::size_t(fitRun * floats));
            if (isSilent(values))
                continue;
            const auto factors = phasors(m_path.curve, m_rate, at);
            for (Index n = std::max(at, segment.begin); n < std::min(at + fitRun, segment.end); ++n) {
                const auto i = std::size_t(n - at);
                const Complex s =
                    amplitudeAt(segment.coefficients, double(n - segment.begin) * perSample, intervals) * factors[i];
                if (!m_isComplex) {
                    values[i] -= float(s.real());
                    continue;
                }
                values[2 * i] -= float(s.real());
                values[2 * i + 1] -= float(s.imag());
            }
        }
    }
}

} // namespace faintline
