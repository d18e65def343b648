#pragma once

#include "recording/Recording.h"
#include "spectrum/FrequencyCurve.h"

#include <functional>
#include <span>
#include <vector>

namespace faintline {

/// Where a strong line of a recording was followed.
struct LinePath {
    FrequencyCurve curve;     ///< its frequency, Hz, an offset from the centre for I/Q; known to 0.3/T
    double fromSeconds = 0.0; ///< middles of the first and of the last window with it
    double toSeconds = 0.0;
    double windowSeconds = 0.0; ///< T_FT
};

/// A strong line as a function of the sample index, fitted to samples of one channel by least squares:
///
///   s(n) = Re{ a(n)·e^(iφ(n)) },   φ' = 2π f(t);   of I/Q samples the same without Re
///
/// a is a complex cubic spline with knots about T_FT apart, so the fit takes what lies within ±0.4/T of the curve and
/// leaves the rest: of a line Δ away, in cells 1/T, it takes the share of the amplitude
///
///   G(Δ) = sinc⁸(Δ) / Σ_k sinc⁸(Δ + k)            (1 - 2·10⁻⁵ at 0.2, ½ at ½, at most 2·10⁻⁴ from ¾ on)
///
/// The curve is first corrected by how a turns. The line begins and ends where it explains most energy, to a sample,
/// from 4T inside the path's ends to 2T beyond them; the spline is broken there, so that neither an abrupt nor a
/// gradual end leaves anything behind. What is silent (`silentSamples` of them that are 0) stays silent and tells
/// nothing. Source: Unser 1999 (the filter that a spline is). Thread-safe; values are a pure function of the samples
/// and the path.
class LineFit
{
public:
    static constexpr Index silentSamples = 32; ///< from multiples of it on

    /// What the samples are of: `read(first, out)` fills whole runs of silentSamples, interleaved where complex.
    struct Samples {
        const RecordingInfo &info;
        std::function<void(Index first, std::span<float> out)> read;
    };

    LineFit(const Samples &samples, LinePath path);

    /// Its curve corrected by how the amplitude turns.
    const LinePath &path() const { return m_path; }
    Index beginSample() const { return m_pieces.empty() ? 0 : m_pieces.front().begin; }
    Index endSample() const { return m_pieces.empty() ? 0 : m_pieces.back().end; }

    /// Whether both come as near as so many cells to each other at a time.
    bool comesNear(const LinePath &other, double cells) const;

    /// Takes the line from samples first …, both ends multiples of silentSamples.
    void subtractFrom(Index first, std::span<float> samples) const;

private:
    /// One stretch of the amplitude without a break.
    struct Piece {
        Index begin = 0;
        Index end = 0;
        std::vector<double> coefficients; ///< real and imaginary parts in turn

        double intervals() const;
    };
    class Equations;

    Piece fitted(const Samples &samples, Piece piece) const;
    void add(Piece piece);
    Index goOn(const Samples &samples, const Piece &sure, Index farthest);
    void follow(const Piece &piece, bool isBegin, bool isEnd);
    Index brink(const Samples &samples, const Piece &inner, bool isBegin, Index farthest) const;

    LinePath m_path;
    double m_rate;
    bool m_isComplex;
    std::vector<Piece> m_pieces;
};

} // namespace faintline
