#include "spectrum/Family.h"

#include "recording/Recording.h"
#include "spectrum/NormalisedPower.h"
#include "spectrum/Spectrogram.h"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace faintline {

namespace {

    constexpr std::size_t mostMembers = 64;
    constexpr double largestMultiple = 64.0;
    constexpr float exact = 12.0f; ///< beyond this maximum, 1 - (1 - e^-m)^K is K·e^-m to single precision

    /// The law of K summed cells; nothing to do for one.
    LooksLaw sumLaw(std::size_t members)
    {
        const auto looks = static_cast<double>(members);
        return {looks, boost::math::gamma_p_inv(looks, 0.5) / looks};
    }

    const LooksLaw &sumLawOf(std::size_t members)
    {
        static const std::vector<LooksLaw> laws = [] {
            std::vector<LooksLaw> all;
            for (std::size_t i = 1; i <= mostMembers; ++i)
                all.push_back(sumLaw(i));
            return all;
        }();
        return laws[members - 1];
    }

    float largestOf(float maximum, std::size_t members)
    {
        const auto K = static_cast<float>(members);
        if (maximum > exact)
            return maximum - std::log(K);
        return -std::log(-std::expm1(K * std::log1p(-std::exp(-maximum))));
    }

    /// Of a band, the cells of a fundamental all of whose members lie in it, neighbouring ones apart.
    Axis fundamentalAxis(const FamilySettings &settings, const Axis &band)
    {
        constexpr double apart = 3.0; // bins between neighbouring multiples
        Axis axis = band;
        axis.step = band.step / familyCellsPerBin(settings);
        const auto [least, most] = std::minmax_element(settings.members.begin(), settings.members.end());
        const double first = std::max(apart * band.step, band.value(0.0) / *least);
        const double last = band.last() / *most;
        axis.first = axis.step * std::ceil(first / axis.step);
        axis.count = static_cast<Index>(std::floor((last - axis.first) / axis.step)) + 1;
        if (axis.count < 1)
            throw fieldError("family.members", formatFieldValue(settings.members),
                             "no fundamental has all of these multiples in the band");
        return axis;
    }

    /// Whether the band ends at 0 Hz and half the rate, where y has other statistics and lines have none to themselves.
    bool endsAreOthers(const Spectrogram &spectrogram)
    {
        return !spectrogram.recording().info().isComplex
               && !(spectrogram.selection().lowHz < spectrogram.selection().highHz);
    }

    FamilyMap mapOf(const FamilySettings &settings, const NormalisedFrames &lines, FamilyFrames::Band band)
    {
        const Spectrogram *spectrogram = lines.spectrogram();
        const Axis &frequency = lines.grid().axes.back();
        if (band == FamilyFrames::Band::Closed)
            return FamilyMap::onRing(settings, frequency.count, 1.0 / frequency.step);
        return {settings, frequency, spectrogram && endsAreOthers(*spectrogram)};
    }

} // namespace

const std::vector<Field<FamilySettings>> &FamilySettings::fields()
{
    using S = FamilySettings;
    static const std::vector<Field<S>> table{
        field(&S::relation, "relation", relationNames,
              "Lines detected as one signal: none, multiples of a fundamental, or lines at fixed distances."),
        field(&S::members, "members", "", -1e9, 1e9,
              "Members of the family: multiples of the fundamental (harmonics), or distances in Hz (offsets)."),
        field(&S::present, "present", presentNames,
              "Whether all members are present at a time, or one at a time, as in frequency-shift keying."),
    };
    return table;
}

void checkFamily(const FamilySettings &settings)
{
    if (settings.isNone())
        return;
    const auto refuse = [&](const std::string &why) {
        throw fieldError("family.members", formatFieldValue(settings.members), why);
    };
    if (settings.members.empty())
        refuse("needs at least one member, such as 1, 2, 3 (harmonics) or -50, 0, 50 (offsets)");
    if (settings.members.size() > mostMembers)
        refuse("at most 64 members are possible");
    if (settings.relation == FamilySettings::Relation::Harmonics)
        for (const double member : settings.members)
            if (!(member > 0.0 && member <= largestMultiple))
                refuse("multiples of a fundamental must lie above 0 and be at most 64");
}

FamilySettings scaledFamily(FamilySettings settings, double factor)
{
    if (settings.relation == FamilySettings::Relation::Offsets)
        for (double &member : settings.members)
            member *= factor;
    return settings;
}

double familyCellsPerBin(const FamilySettings &settings)
{
    return settings.relation == FamilySettings::Relation::Harmonics
               ? *std::max_element(settings.members.begin(), settings.members.end())
               : 1.0;
}

double ringBands(const FamilySettings &settings)
{
    if (settings.isNone())
        return 1.0;
    if (settings.relation == FamilySettings::Relation::Offsets)
        return static_cast<double>(settings.members.size());
    return std::accumulate(settings.members.begin(), settings.members.end(), 0.0) / familyCellsPerBin(settings);
}

std::vector<double> memberFrequencies(const FamilySettings &settings, double hz)
{
    std::vector<double> result;
    for (const double member : settings.members)
        result.push_back(settings.relation == FamilySettings::Relation::Harmonics ? member * hz : hz + member);
    return result;
}

FamilyMap::FamilyMap(const FamilySettings &settings, const Axis &frequency, bool innerOnly)
    : m_settings(settings), m_frequency(frequency), m_bins(frequency.count)
{
    checkFamily(settings);
    if (settings.relation == FamilySettings::Relation::Harmonics)
        m_frequency = fundamentalAxis(settings, frequency);
    const Index first = innerOnly ? 1 : 0;
    const Index last = m_bins - 1 - first;
    const auto cells = static_cast<std::size_t>(m_frequency.count);
    m_places.resize(cells * settings.members.size());
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const std::vector<double> members = memberFrequencies(settings, m_frequency.value(static_cast<double>(cell)));
        for (std::size_t k = 0; k < members.size(); ++k) {
            const Index bin = std::lround(frequency.position(members[k]));
            m_places[k * cells + cell] = bin >= first && bin <= last ? static_cast<std::int32_t>(bin) : -1;
        }
    }
    if (std::all_of(m_places.begin(), m_places.end(), [](std::int32_t place) { return place < 0; }))
        throw fieldError("family.members", formatFieldValue(settings.members), "none of them lies in the band");
}

FamilyMap FamilyMap::onRing(const FamilySettings &settings, Index bins, double binsPerHz)
{
    checkFamily(settings);
    const std::vector<double> &members = settings.members;
    const bool isHarmonic = settings.relation == FamilySettings::Relation::Harmonics;
    const auto [least, most] = std::minmax_element(members.begin(), members.end());
    const bool fits = !isHarmonic && 2.0 * (*most - *least) * binsPerHz < static_cast<double>(bins);
    // Otherwise each member has a stretch to itself, or noise would be added to itself where two of them meet.
    const auto cells = fits ? bins : static_cast<Index>(static_cast<double>(bins) / ringBands(settings));
    FamilyMap map;
    map.m_settings = settings;
    map.m_bins = bins;
    map.m_frequency = {"frequency", "Hz", 0.0, 1.0, cells, true};
    const Axis ring{"frequency", "Hz", 0.0, 1.0, bins, true};
    double stretch = 0.0;
    for (const double member : members) {
        const double step = isHarmonic ? member / familyCellsPerBin(settings) : 1.0;
        const double base = fits ? member * binsPerHz : stretch;
        for (Index cell = 0; cell < cells; ++cell)
            map.m_places.push_back(static_cast<std::int32_t>(
                ring.wrapped(std::lround(std::floor(base + step * static_cast<double>(cell))))));
        stretch += step * static_cast<double>(cells);
    }
    return map;
}

void FamilyMap::apply(std::span<const float> y, std::span<float> out) const
{
    m_settings.present == FamilySettings::Present::Together ? together(y, out) : inTurn(y, out);
}

void FamilyMap::together(std::span<const float> y, std::span<float> out) const
{
    const std::size_t cells = out.size();
    std::vector<std::uint8_t> counts(cells, 0);
    std::fill(out.begin(), out.end(), 0.0f);
    for (auto place = m_places.begin(); place != m_places.end(); place += static_cast<std::ptrdiff_t>(cells))
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const std::int32_t bin = place[static_cast<std::ptrdiff_t>(cell)];
            if (bin < 0 || std::isnan(y[static_cast<std::size_t>(bin)]))
                continue;
            out[cell] += y[static_cast<std::size_t>(bin)];
            ++counts[cell];
        }
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const std::size_t K = counts[cell];
        if (K == 0)
            out[cell] = std::numeric_limits<float>::quiet_NaN();
        else if (K > 1)
            out[cell] = sumLawOf(K)(out[cell] / static_cast<float>(K));
    }
}

void FamilyMap::inTurn(std::span<const float> y, std::span<float> out) const
{
    const std::size_t cells = out.size();
    std::vector<std::uint8_t> counts(cells, 0);
    std::fill(out.begin(), out.end(), 0.0f);
    for (auto place = m_places.begin(); place != m_places.end(); place += static_cast<std::ptrdiff_t>(cells))
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const std::int32_t bin = place[static_cast<std::ptrdiff_t>(cell)];
            if (bin < 0 || std::isnan(y[static_cast<std::size_t>(bin)]))
                continue;
            out[cell] = std::max(out[cell], y[static_cast<std::size_t>(bin)]);
            ++counts[cell];
        }
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const std::size_t K = counts[cell];
        if (K == 0)
            out[cell] = std::numeric_limits<float>::quiet_NaN();
        else if (K > 1)
            out[cell] = largestOf(out[cell], K);
    }
}

FamilyFrames::FamilyFrames(NormalisedFramesPointer lines, const FamilySettings &settings, Band band)
    : NormalisedFrames(lines->time(), lines->grid()), m_lines(std::move(lines)), m_map(mapOf(settings, *m_lines, band))
{
    m_grid.axes = {m_map.frequency()};
}

void FamilyFrames::read(Index first, Index count, std::span<float> out) const
{
    const auto bins = static_cast<std::size_t>(m_lines->grid().size());
    const auto cells = static_cast<std::size_t>(m_grid.size());
    std::vector<float> lines(static_cast<std::size_t>(count) * bins);
    m_lines->read(first, count, lines);
    for (std::size_t row = 0; row < static_cast<std::size_t>(count); ++row)
        m_map.apply(std::span(lines).subspan(row * bins, bins), out.subspan(row * cells, cells));
}

NormalisedFramesPointer familyFrames(NormalisedFramesPointer lines, const FamilySettings &settings,
                                     FamilyFrames::Band band)
{
    return settings.isNone() ? lines : std::make_shared<FamilyFrames>(std::move(lines), settings, band);
}

Axis familyAxis(const FamilySettings &settings, const Spectrogram &spectrogram)
{
    if (settings.isNone())
        return spectrogram.frequency();
    return FamilyMap(settings, spectrogram.frequency(), endsAreOthers(spectrogram)).frequency();
}

} // namespace faintline
