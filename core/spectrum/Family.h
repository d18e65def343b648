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

/// The same; where there is none, the line itself: one member at distance 0.
FamilySettings familyOrLine(const FamilySettings &settings);

/// How many bands of a width, one beside the other, the members go through while the family goes through one, in all
/// channels; of none, one a channel.
double ringBands(const FamilySettings &settings, int channels = 1);

/// Where the members lie of a family at `hz`: multiples of it, or at their distances from it.
std::vector<double> memberFrequencies(const FamilySettings &settings, double hz);

/// From one frame of normalised power, of one or several channels, to the family's, again exponential of mean 1 on noise:
///
///   together  y(f) = -ln Q(K, Σ_ck y_c(f_k))         Q: regularised upper incomplete gamma function
///   inTurn    y(f) = -ln(1 - (1 - e^(-max_k y(f_k)))^K),   y(f_k) = -ln Q(C, Σ_c y_c(f_k))
///
/// f_k = m_k·f (harmonics), read off to the nearest bin, or f + m_k (offsets), or f alone; c: channel. K and C count
/// what lies inside the band and was observed, and without any y is NaN. The sum is sufficient for equal weak members,
/// the maximum close to it for one member at a time. Noise is taken to be independent from channel to channel. Every
/// detector works on this y as on any other, and is calibrated on it.
///
/// Oracle: direct sums; Boost.Math. Thread-safe.
class FamilyMap
{
public:
    /// On a bounded band. `innerOnly`: the first and last bins are nobody's (0 Hz and half the rate of real samples).
    /// Throws Error where the family does not fit into the band.
    FamilyMap(const FamilySettings &settings, const Axis &frequency, bool innerOnly, int channels = 1);

    /// On a band of `bins` that closes on itself, all cells alike: for calibrations. `binsPerHz` converts distances.
    /// Every channel has a part of the band. Offsets that there is room for are kept; other members have a stretch of
    /// it each, and the family has bins/ringBands cells.
    static FamilyMap onRing(const FamilySettings &settings, Index bins, double binsPerHz, int channels = 1);

    const Axis &frequency() const { return m_frequency; } ///< as familyAxis has it

    /// One frame: y of all bins of the band, channel after channel, or of the ring → y of frequency().count cells.
    void apply(std::span<const float> y, std::span<float> out) const;

private:
    FamilyMap() = default;
    void applyInTurn(std::span<const float> y, std::span<float> out) const;

    FamilySettings m_settings;
    Axis m_frequency;
    int m_channels = 1;
    /// Member by member, and of each channel by channel, where in y each cell lies; -1: outside the band.
    std::vector<std::int32_t> m_places;
};

/// The frames of a family, over those of single lines.
class FamilyFrames final : public NormalisedFrames
{
public:
    /// `lines`: of each channel, or of a ring that holds them all.
    FamilyFrames(std::vector<NormalisedFramesPointer> lines, FamilyMap map);

    void read(Index first, Index count, std::span<float> out) const override;

    const Spectrogram *spectrogram() const override { return m_lines.front()->spectrogram(); }

private:
    std::vector<NormalisedFramesPointer> m_lines;
    FamilyMap m_map;
};

/// The frames of a family over the lines of one or several channels; of none, the lines of all channels together, and
/// those of a single one as they are.
NormalisedFramesPointer familyFrames(const std::vector<NormalisedFramesPointer> &channels,
                                     const FamilySettings &settings);

/// The same over noise whose band closes on itself, as that of white complex noise does, and holds all channels.
NormalisedFramesPointer familyFramesOnRing(const NormalisedFramesPointer &ring, const FamilySettings &settings,
                                           int channels);

} // namespace faintline
