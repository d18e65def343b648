#pragma once

#include "base/Axis.h"
#include "base/Field.h"
#include "frames/NormalisedFrames.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace faintline {

/// Lines that belong together and are detected as one signal.
struct FamilySettings {
    enum class Relation {
        None,      ///< every line by itself
        Harmonics, ///< members are multiples of a fundamental
        Offsets    ///< members lie at fixed offsets: sidebands, tones
    };
    static constexpr std::array<std::string_view, 3> relationNames{"none", "harmonics", "offsets"};

    enum class Present {
        Together, ///< all members at the same time
        InTurn    ///< one at a time: the tones of frequency-shift keying
    };
    static constexpr std::array<std::string_view, 2> presentNames{"together", "inTurn"};

    Relation relation = Relation::None;
    std::vector<double> members; ///< multiples (Harmonics) or offsets in Hz (Offsets)
    Present present = Present::Together;

    bool isNone() const { return relation == Relation::None; }
    /// The first bin of a band in which a member counts, and as far from its end the last one. At real ends (0 Hz and
    /// half the rate of real samples), where a line alone is excluded by the chain, members are left out.
    Index firstBin(bool hasRealEnds) const { return hasRealEnds && !isNone() ? 1 : 0; }
    /// Whether the evidence of several lines is added: of members, or of channels.
    bool isSum(int channels) const { return !isNone() || channels > 1; }

    static const std::vector<Field<FamilySettings>> &fields();
    bool operator==(const FamilySettings &) const = default;
};

/// Checks constraints between fields. Throws Error naming the field.
void checkFamily(const FamilySettings &settings);

/// The axis of a family over a band. For offsets and no family: the band's axis. For harmonics: the fundamentals whose
/// members all lie in the band at least 3 bins apart, in steps of 1/max m_k bin, so that the highest member moves by
/// one bin. Throws Error if there are none, or if offsets are less than a bin apart.
Axis familyAxis(const FamilySettings &settings, const Axis &band);

/// The same settings with the offsets in Hz multiplied by `factor`.
FamilySettings scaledFamily(FamilySettings settings, double factor);

/// Number of cells of the family's axis per bin of the frames: the largest multiple for harmonics, otherwise 1.
double familyCellsPerBin(const FamilySettings &settings);

/// The same settings; if there is no family, the line itself: one member at offset 0.
FamilySettings familyOrLine(const FamilySettings &settings);

/// Number of adjacent bands of a given width that the members cross while the family crosses one, in all channels;
/// without a family, one per channel.
double ringBands(const FamilySettings &settings, int channels = 1);

/// Frequencies of the members of a family at `hz`: its multiples, or at their offsets from it.
std::vector<double> memberFrequencies(const FamilySettings &settings, double hz);

/// Maps a frame of normalised power, of one or more channels, to the family's, again exponential of mean 1 on noise:
///
///   together  y(f) = -ln Q(K, Σ_ck y_c(f_k))         Q: regularised upper incomplete gamma function
///   inTurn    y(f) = -ln(1 - (1 - e^(-max_k y(f_k)))^K),   y(f_k) = -ln Q(C, Σ_c y_c(f_k))
///
/// f_k = m_k·f (harmonics), read at the nearest bin, or f + m_k (offsets), or f alone; c: channel. K and C count the
/// values inside the band that were observed; if there are none, y is NaN. The sum is a sufficient statistic for equal
/// weak members; the maximum is nearly so for one member at a time. Noise is assumed independent between channels.
/// Every detector operates on this y as on any other and is calibrated on it.
///
/// Oracle: direct sums; Boost.Math. Thread-safe.
class FamilyMap
{
public:
    /// On a bounded band, whose ends may be real (FamilySettings::firstBin). Throws Error if the family does not fit
    /// into it.
    FamilyMap(const FamilySettings &settings, const Axis &frequency, bool hasRealEnds, int channels = 1);

    /// On a circular band of `bins` with all cells alike, for calibration. `binsPerHz` converts offsets. Each channel
    /// has a section of the band. Offsets that fit are kept; otherwise each member gets its own section, and the family
    /// has bins/ringBands cells.
    static FamilyMap onRing(const FamilySettings &settings, Index bins, double binsPerHz, int channels = 1);

    const Axis &frequency() const { return m_frequency; } ///< as in familyAxis

    /// Maps one frame: y of all bins of the band, channel by channel, or of the ring → y of frequency().count cells.
    void apply(std::span<const float> y, std::span<float> out) const;

private:
    FamilyMap() = default;
    void applyInTurn(std::span<const float> y, std::span<float> out) const;

    FamilySettings m_settings;
    Axis m_frequency;
    int m_channels = 1;
    /// For each member and channel, the index in y of each cell; -1: outside the band.
    std::vector<std::int32_t> m_places;
};

/// The frames of a family, computed from frames of single lines.
class FamilyFrames final : public NormalisedFrames
{
public:
    /// `lines`: one per channel, or one ring that holds all channels.
    FamilyFrames(std::vector<NormalisedFramesPointer> lines, FamilyMap map);

    void read(Index first, Index count, std::span<float> out) const override;

    const Spectrogram *spectrogram() const override { return m_lines.front()->spectrogram(); }

private:
    std::vector<NormalisedFramesPointer> m_lines;
    FamilyMap m_map;
};

/// The frames of a family, computed from the lines of one or more channels. Without a family: the lines of all channels
/// combined, or those of a single channel unchanged.
NormalisedFramesPointer familyFrames(const std::vector<NormalisedFramesPointer> &channels,
                                     const FamilySettings &settings);

/// The same over noise on a circular band, as that of white complex noise is, which holds all channels.
NormalisedFramesPointer familyFramesOnRing(const NormalisedFramesPointer &ring, const FamilySettings &settings,
                                           int channels);

} // namespace faintline
