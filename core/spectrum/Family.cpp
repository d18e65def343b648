#include "spectrum/Family.h"

#include "spectrum/Spectrogram.h"
#include "spectrum/familyLaw.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace faintline {

namespace {

    constexpr double largestMultiple = 64.0;

    /// The smallest distance between two members; ∞ of one.
    double closest(std::vector<double> members)
    {
        std::sort(members.begin(), members.end());
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i < members.size(); ++i)
            least = std::min(least, members[i] - members[i - 1]);
        return least;
    }

    FamilyMap mapOf(const FamilySettings &settings, const NormalisedFrames &lines, FamilyFrames::Band band)
    {
        const Spectrogram *spectrogram = lines.spectrogram();
        const Axis &frequency = lines.grid().axes.back();
        if (band == FamilyFrames::Band::Closed)
            return FamilyMap::onRing(settings, frequency.count, 1.0 / frequency.step);
        return {settings, frequency, spectrogram && spectrogram->hasRealEnds()};
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
    if (closest(settings.members) == 0.0)
        refuse("must not name a member twice");
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

Axis familyAxis(const FamilySettings &settings, const Axis &band)
{
    checkFamily(settings);
    if (settings.isNone())
        return band;
    const auto refuse = [&](const char *why) {
        throw fieldError("family.members", formatFieldValue(settings.members), why);
    };
    if (settings.relation == FamilySettings::Relation::Offsets) {
        if (closest(settings.members) < band.step)
            refuse("must lie at least a bin apart; a longer window (spectrogram.windowSeconds) has narrower bins");
        return band;
    }
    constexpr double apart = 3.0; // bins between neighbouring members
    Axis axis = band;
    axis.name = "fundamental " + band.name;
    axis.step = band.step / familyCellsPerBin(settings);
    const auto [least, most] = std::minmax_element(settings.members.begin(), settings.members.end());
    const double first = std::max({band.step, apart * band.step / closest(settings.members), band.value(0.0) / *least});
    axis.first = axis.step * std::ceil(first / axis.step);
    axis.count = Index(std::floor((band.last() / *most - axis.first) / axis.step)) + 1;
    if (axis.count < 1)
        refuse("must have multiples that all lie in the band, for some fundamental");
    return axis;
}

double ringBands(const FamilySettings &settings)
{
    if (settings.isNone())
        return 1.0;
    if (settings.relation == FamilySettings::Relation::Offsets)
        return double(settings.members.size());
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
    : m_settings(settings), m_frequency(familyAxis(settings, frequency)), m_bins(frequency.count)
{
    const Index first = innerOnly ? 1 : 0;
    const Index last = m_bins - 1 - first;
    const auto cells = std::size_t(m_frequency.count);
    m_places.resize(cells * settings.members.size());
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const std::vector<double> members = memberFrequencies(settings, m_frequency.value(double(cell)));
        for (std::size_t k = 0; k < members.size(); ++k) {
            const Index bin = std::lround(frequency.position(members[k]));
            m_places[k * cells + cell] = bin >= first && bin <= last ? std::int32_t(bin) : -1;
        }
    }
    if (std::all_of(m_places.begin(), m_places.end(), [](std::int32_t place) { return place < 0; }))
        throw fieldError("family.members", formatFieldValue(settings.members),
                         "must have at least one member in the band");
}

FamilyMap FamilyMap::onRing(const FamilySettings &settings, Index bins, double binsPerHz)
{
    checkFamily(settings);
    const std::vector<double> &members = settings.members;
    const bool isHarmonic = settings.relation == FamilySettings::Relation::Harmonics;
    const auto [least, most] = std::minmax_element(members.begin(), members.end());
    const bool fits = !isHarmonic && 2.0 * (*most - *least) * binsPerHz < double(bins);
    // Otherwise each member has a stretch to itself, or noise would be added to itself where two of them meet.
    const auto cells = fits ? bins : Index(double(bins) / ringBands(settings));
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
            map.m_places.push_back(std::int32_t(ring.wrapped(std::lround(std::floor(base + step * double(cell))))));
        stretch += step * double(cells);
    }
    return map;
}

namespace {

    /// Takes the members of every cell together with `combine`, then brings what K of them gave to the law of one cell.
    template <class Combine, class Law>
    void gather(std::span<const float> y, std::span<const std::int32_t> places, std::span<float> out, Combine combine,
                Law law)
    {
        const std::size_t cells = out.size();
        std::vector<std::uint8_t> counts(cells, 0);
        std::fill(out.begin(), out.end(), 0.0f);
        for (; !places.empty(); places = places.subspan(cells))
            for (std::size_t cell = 0; cell < cells; ++cell) {
                if (places[cell] < 0)
                    continue;
                const float value = y[std::size_t(places[cell])];
                if (std::isnan(value))
                    continue;
                out[cell] = combine(out[cell], value);
                ++counts[cell];
            }
        for (std::size_t cell = 0; cell < cells; ++cell)
            if (counts[cell] == 0)
                out[cell] = std::numeric_limits<float>::quiet_NaN();
            else if (counts[cell] > 1)
                out[cell] = law(out[cell], std::size_t(counts[cell]));
    }

} // namespace

void FamilyMap::apply(std::span<const float> y, std::span<float> out) const
{
    const auto larger = [](float a, float b) { return std::max(a, b); };
    if (m_settings.present == FamilySettings::Present::Together)
        gather(y, m_places, out, std::plus<float>(), powerOfSum);
    else
        gather(y, m_places, out, larger, powerOfLargest);
}

FamilyFrames::FamilyFrames(NormalisedFramesPointer lines, const FamilySettings &settings, Band band)
    : NormalisedFrames(lines->time(), lines->grid()), m_lines(std::move(lines)), m_map(mapOf(settings, *m_lines, band))
{
    m_grid.axes = {m_map.frequency()};
}

void FamilyFrames::read(Index first, Index count, std::span<float> out) const
{
    const auto bins = std::size_t(m_lines->grid().size());
    const auto cells = std::size_t(m_grid.size());
    std::vector<float> lines(std::size_t(count) * bins);
    m_lines->read(first, count, lines);
    for (std::size_t row = 0; row < std::size_t(count); ++row)
        m_map.apply(std::span(lines).subspan(row * bins, bins), out.subspan(row * cells, cells));
}

NormalisedFramesPointer familyFrames(NormalisedFramesPointer lines, const FamilySettings &settings,
                                     FamilyFrames::Band band)
{
    return settings.isNone() ? lines : std::make_shared<FamilyFrames>(std::move(lines), settings, band);
}

} // namespace faintline
