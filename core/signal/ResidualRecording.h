#pragma once

#include "base/RunContext.h"
#include "signal/FrequencyCurve.h"
#include "signal/Recording.h"

#include <functional>
#include <span>
#include <vector>

namespace faintline {

/// Path along which a strong line of a recording was followed.
struct LinePath {
    FrequencyCurve curve;     ///< frequency, Hz, relative to the centre for I/Q; accurate to 0.3/T
    double fromSeconds = 0.0; ///< middles of the first and last window with the line
    double toSeconds = 0.0;
    double windowSeconds = 0.0; ///< T_FT
};

/// Least-squares fit of a strong line to samples of one channel, as a function of the sample index:
///
///   s(n) = Re{ a(n)·e^(iφ(n)) },   φ' = 2π f(t);   for I/Q samples without Re
///
/// a is a complex cubic spline with knots about T_FT apart, so the fit captures components within ±0.4/T of the curve
/// and leaves the rest. Of a line at distance Δ, in cells 1/T, it captures the fraction of the amplitude
///
///   G(Δ) = sinc⁸(Δ) / Σ_k sinc⁸(Δ + k)            (1 - 2·10⁻⁵ at 0.2, ½ at ½, at most 2·10⁻⁴ from ¾ on)
///
/// The curve is first corrected by the phase of a. The line begins and ends, to a sample, where it explains most
/// energy, from 4T inside the path's ends to 2T beyond them. The spline breaks there, so that neither an abrupt nor a
/// gradual end leaves a residual. Silence (`silentSamples` zeros or more) stays silent and is ignored by the fit.
/// Source: Unser 1999 (splines as filters). Thread-safe; values are a pure function of the samples and the path.
class LineFit
{
public:
    static constexpr Index silentSamples = 32; ///< from multiples of it on

    /// The samples to fit: `read(first, out)` fills whole runs of silentSamples, interleaved if complex.
    struct FitSamples {
        const RecordingInfo &info;
        std::function<void(Index first, std::span<float> out)> read;
    };

    LineFit(const FitSamples &samples, LinePath path);

    /// The path with its curve corrected by the phase of the amplitude.
    const LinePath &path() const { return m_path; }
    Index beginSample() const { return m_segments.empty() ? 0 : m_segments.front().begin; }
    Index endSample() const { return m_segments.empty() ? 0 : m_segments.back().end; }

    /// Whether both lines come within `cells` resolution cells of each other at any time.
    bool comesNear(const LinePath &other, double cells) const;

    /// Subtracts the line from samples first …; both ends must be multiples of silentSamples.
    void subtractFrom(Index first, std::span<float> samples) const;

private:
    /// One stretch of the amplitude without a break.
    struct AmplitudeSegment {
        Index begin = 0;
        Index end = 0;
        std::vector<double> coefficients; ///< real and imaginary parts alternate

        double intervals() const;
    };
    class Equations;

    AmplitudeSegment fitted(const FitSamples &samples, AmplitudeSegment segment) const;
    void add(AmplitudeSegment segment);
    Index goOn(const FitSamples &samples, const AmplitudeSegment &sure, Index farthest);
    void follow(const AmplitudeSegment &segment, bool isBegin, bool isEnd);
    Index lineEnd(const FitSamples &samples, const AmplitudeSegment &inner, bool isBegin, Index farthest) const;

    LinePath m_path;
    double m_rate;
    bool m_isComplex;
    std::vector<AmplitudeSegment> m_segments;
};

/// A recording minus strong lines of one of its channels. Each line is fitted in amplitude and phase (LineFit) and
/// subtracted, the strongest first, to reveal weaker signals nearby. Other channels are unchanged.
///
/// A fit P also removes the noise within half a cell of its line. With noise w like the recording's own
/// (SurrogateRecording), the difference from it is fitted instead, x - P(x - w): the noise remains white, without a
/// notch that would lower the background nearby. Thread-safe; samples are a pure function of (recording, paths, noise,
/// index).
class ResidualRecording final : public DerivedRecording
{
public:
    /// `paths`: in order of decreasing strength; `noise`: as long as the recording, one channel; null: none. Reads the
    /// samples along each path. Throws Cancelled.
    ResidualRecording(RecordingPointer base, int channel, std::vector<LinePath> paths, const Recording *noise = nullptr,
                      const RunContext &context = {});

    const std::vector<LineFit> &lines() const { return m_lines; }

    void read(int channel, Index first, Index count, std::span<float> out) const override;

private:
    int m_channel;
    std::vector<LineFit> m_lines;
};

} // namespace faintline
