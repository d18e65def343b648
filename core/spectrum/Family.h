#pragma once

#include "base/Axis.h"
#include "base/Field.h"
#include "spectrum/NormalisedFrames.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace faintline {

/// Lines that belong together and are looked for as one signal.
struct FamilySettings {
    enum class Relation {
        None,      ///< every line by itself
        Harmonics, ///< members are multiples of a fundamental
        Offsets    ///< members lie at fixed distances: sidebands, tones
    };
    static constexpr std::array<std::string_view, 3> relationNames{"none", "harmonics", "offsets"};

    enum class Present {
        Together, ///< all members at a time
        InTurn    ///< one at a time: the tones of frequency-shift keying
    };
    static constexpr std::array<std::string_view, 2> presentNames{"together", "inTurn"};

    Relation relation = Relation::None;
    std::vector<double> members; ///< multiples (Harmonics) or distances in Hz (Offsets)
    Present present = Present::Together;

    bool isNone() const { return relation == Relation::None; }

    static const std::vector<Field<FamilySettings>> &fields();
    bool operator==(const FamilySettings &) const = default;
};

/// Checks what no single field can. Throws Error naming the field.
void checkFamily(const FamilySettings &settings);

/// The axis of a family over a band: of offsets, and of none, the band's; of harmonics fundamentals all of whose
/// members lie in it at least 3 bins apart, in steps of 1/max m_k bin, so that the highest member moves by a bin.
/// Throws Error where there is none, and where offsets lie less than a bin apart.
Axis familyAxis(const FamilySettings &settings, const Axis &band);

/// The same with distances of `factor` times as many Hz.
FamilySettings scaledFamily(FamilySettings settings, double factor);

/// How many cells of the family's axis a bin of the frames is: the largest multiple of harmonics, 1 of others.
double familyCellsPerBin(const FamilySettings &settings);

/// How many bands of a width, one beside the other, the members go through while the family goes through one; 1 of
/// none.
double ringBands(const FamilySettings &settings);

/// Where the members lie of a family at `hz`: multiples of it, or at their distances from it.
std::vector<double> memberFrequencies(const FamilySettings &settings, double hz);

/// From one frame of normalised power to the family's, again exponential of mean 1 on noise:
///
///   together  y(f) = -ln Q(K, Σ_k y(f_k))            Q: regularised upper incomplete gamma function
///   inTurn    y(f) = -ln(1 - (1 - e^(-max_k y(f_k)))^K)
///
/// f_k = m_k·f (harmonics), read off to the nearest bin, or f + m_k (offsets); K counts the members inside the band
/// that were observed, and without any y is NaN. The sum is sufficient for equal weak members, the maximum close to it
/// for one member at a time. Every detector works on this y as on any other, and is calibrated on it.
///
/// Oracle: direct sums; Boost.Math. Thread-safe.
class FamilyMap
{
public:
    /// On a bounded band. `innerOnly`: the first and last bins are nobody's (0 Hz and half the rate of real samples).
    /// Throws Error where the family does not fit into the band.
    FamilyMap(const FamilySettings &settings, const Axis &frequency, bool innerOnly);

    /// On a band of `bins` that closes on itself, all cells alike: for calibrations. `binsPerHz` converts distances.
    /// Offsets that the band has room for are kept; other members have a stretch of it each, and the family has
    /// bins/ringBands cells.
    static FamilyMap onRing(const FamilySettings &settings, Index bins, double binsPerHz);

    const Axis &frequency() const { return m_frequency; } ///< as familyAxis has it

    /// One frame: y of all bins of the band → y of frequency().count cells.
    void apply(std::span<const float> y, std::span<float> out) const;

private:
    FamilyMap() = default;
    FamilySettings m_settings;
    Axis m_frequency;
    Index m_bins = 0;
    std::vector<std::int32_t> m_places; ///< member by member, the bin of each cell; -1: outside the band
};

/// The frames of a family, over those of single lines.
class FamilyFrames final : public NormalisedFrames
{
public:
    /// Whether the band has two ends, or closes on itself as white complex noise does (calibrations).
    enum class Band { Open, Closed };

    FamilyFrames(NormalisedFramesPointer lines, const FamilySettings &settings, Band band = Band::Open);

    void read(Index first, Index count, std::span<float> out) const override;

    const Spectrogram *spectrogram() const override { return m_lines->spectrogram(); }

private:
    NormalisedFramesPointer m_lines;
    FamilyMap m_map;
};

/// The frames of a family over `lines`; the lines themselves where there is none.
NormalisedFramesPointer familyFrames(NormalisedFramesPointer lines, const FamilySettings &settings,
                                     FamilyFrames::Band band = FamilyFrames::Band::Open);

} // namespace faintline
