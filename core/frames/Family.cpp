#include "frames/Family.h"

#include "frames/LooksLaw.h"
#include "frames/familyLaw.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace faintline {

namespace {

    /// The smallest distance between two members; ∞ for a single one.
    double closest(std::vector<double> members)
    {
        std::sort(members.begin(), members.end());
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i < members.size(); ++i)
            least = std::min(least, members[i] - members[i - 1]);
        return least;
    }

    /// powerOfSum with one table lookup for adjacent cells with the same number of members.
    class PowerOfSum
    {
    public:
        float operator()(float sum, std::size_t members)
        {
            if (members != m_members)
                m_law = &lawOfSum(m_members = members);
            return (*m_law)(sum / float(members));
        }

    private:
        std::size_t m_members = 0;
        const LooksLaw *m_law = nullptr;
    };

    /// Accumulated values of every cell, and how many were observed.
    struct Gathered {
        std::span<float> values;
        std::vector<std::uint16_t> counts;

        explicit Gathered(std::span<float> out) : values(out), counts(out.size(), 0)
        {
            std::fill(out.begin(), out.end(), 0.0f);
        }

        template <class Combine>
        void add(std::size_t cell, float value, Combine combine)
        {
            if (std::isnan(value))
                return;
            values[cell] = combine(values[cell], value);
            ++counts[cell];
        }

        template <class Combine>
        void add(std::span<const float> y, std::span<const std::int32_t> places, Combine combine)
        {
            for (; !places.empty(); places = places.subspan(values.size()))
                for (std::size_t cell = 0; cell < values.size(); ++cell)
                    if (places[cell] >= 0)
                        add(cell, y[std::size_t(places[cell])], combine);
        }

        /// Transforms each accumulated value to the law of a single cell.
        template <class Law>
        void finish(Law law)
        {
            for (std::size_t cell = 0; cell < values.size(); ++cell)
                if (counts[cell] == 0)
                    values[cell] = std::numeric_limits<float>::quiet_NaN();
                else if (counts[cell] > 1)
                    values[cell] = law(values[cell], std::size_t(counts[cell]));
        }
    };

} // namespace

const std::vector<Field<FamilySettings>> &FamilySettings::fields()
{
    using S = FamilySettings;
    static const std::vector<Field<S>> table{
        field(&S::relation, "relation", relationNames,
              "Lines detected as one signal: none, multiples of a fundamental, or lines at fixed distances.")
            .labelled("Lines detected together")
            .advised("Use it for signals of several lines that are too weak one by one: their powers are added. Lines "
                     "of other signals are then detected only as far as they raise such a sum."),
        field(&S::members, "members", "", -1e9, 1e9,
              "Members of the family: multiples of the fundamental (harmonics), or distances in Hz (offsets).")
            .labelled("Members")
            .advised("List only members that carry power: each of the others adds noise and raises the threshold. Time "
                     "grows with their number.")
            .withExample("1, 2, 3 or -50, 50"),
        field(&S::present, "present", presentNames,
              "Whether all members are present at a time, or one at a time, as in frequency-shift keying.")
            .labelled("Present")
            .advanced()
            .advised("With inTurn the largest member counts instead of the sum, as for keying between frequencies."),
    };
    return table;
}

void checkFamily(const FamilySettings &settings)
{
    const FamilySettings family = familyOrLine(settings);
    const auto refuse = [&](const std::string &why) {
        throw fieldError("family.members", formatFieldValue(family.members), why);
    };
    if (family.members.empty())
        refuse("needs at least one member, such as 1, 2, 3 (harmonics) or -50, 0, 50 (offsets)");
    if (family.members.size() > mostMembers)
        refuse("at most 64 members are possible");
    if (closest(family.members) == 0.0)
        refuse("must not name a member twice");
    if (family.relation == FamilySettings::Relation::Harmonics)
        for (const double member : family.members)
            if (!(member > 0.0 && member <= 64.0))
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
    const auto refuse = [&](const char *why) {
        throw fieldError("family.members", formatFieldValue(settings.members), why);
    };
    if (settings.relation != FamilySettings::Relation::Harmonics) {
        if (closest(familyOrLine(settings).members) < band.step)
            refuse("must lie at least a bin apart; a longer window (spectrogram.windowSeconds) has narrower bins");
        return band;
    }
    Axis axis = band;
    axis.name = "fundamental " + band.name;
    axis.step = band.step / familyCellsPerBin(settings);
    const auto [least, most] = std::minmax_element(settings.members.begin(), settings.members.end());
    const double first = std::max({band.step, 3.0 * band.step / closest(settings.members), band.value(0.0) / *least});
    axis.first = axis.step * std::ceil(first / axis.step);
    axis.count = Index(std::floor((band.last() / *most - axis.first) / axis.step)) + 1;
    if (axis.count < 1)
        refuse("must have multiples that all lie in the band, for some fundamental");
    return axis;
}

FamilySettings familyOrLine(const FamilySettings &settings)
{
    return settings.isNone() ? FamilySettings{FamilySettings::Relation::Offsets, {0.0}} : settings;
}

double ringBands(const FamilySettings &settings, int channels)
{
    if (settings.relation != FamilySettings::Relation::Harmonics)
        return double(familyOrLine(settings).members.size()) * channels;
    return std::accumulate(settings.members.begin(), settings.members.end(), 0.0) / familyCellsPerBin(settings)
           * channels;
}

std::vector<double> memberFrequencies(const FamilySettings &settings, double hz)
{
    std::vector<double> result;
    for (const double member : settings.members)
        result.push_back(settings.relation == FamilySettings::Relation::Harmonics ? member * hz : hz + member);
    return result;
}

FamilyMap::FamilyMap(const FamilySettings &settings, const Axis &frequency, bool hasRealEnds, int channels)
    : m_settings(familyOrLine(settings)), m_frequency(familyAxis(m_settings, frequency)), m_channels(channels)
{
    const Index first = settings.firstBin(hasRealEnds);
    const Index last = frequency.count - 1 - first;
    const std::size_t members = m_settings.members.size();
    const auto cells = std::size_t(m_frequency.count);
    m_places.resize(cells * members * std::size_t(channels));
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const std::vector<double> hz = memberFrequencies(m_settings, m_frequency.value(double(cell)));
        for (std::size_t k = 0; k < members; ++k) {
            const Index bin = std::lround(frequency.position(hz[k]));
            const bool isInside = bin >= first && bin <= last;
            for (int c = 0; c < channels; ++c)
                m_places[(k * std::size_t(channels) + std::size_t(c)) * cells + cell] =
                    isInside ? std::int32_t(c * frequency.count + bin) : -1;
        }
    }
    if (std::all_of(m_places.begin(), m_places.end(), [](std::int32_t place) { return place < 0; }))
        throw fieldError("family.members", formatFieldValue(m_settings.members),
                         "must have at least one member in the band");
}

FamilyMap FamilyMap::onRing(const FamilySettings &settings, Index bins, double binsPerHz, int channels)
{
    FamilyMap map;
    map.m_settings = familyOrLine(settings);
    map.m_channels = channels;
    checkFamily(map.m_settings);
    const std::vector<double> &members = map.m_settings.members;
    const bool isHarmonic = settings.relation == FamilySettings::Relation::Harmonics;
    const auto [least, most] = std::minmax_element(members.begin(), members.end());
    const Index own = bins / channels;
    const bool fits = !isHarmonic && 2.0 * (*most - *least) * binsPerHz < double(own);
    // Otherwise each member gets its own section, because noise would be added to itself where two meet. Channels lie
    // in a row: a member that runs past the end of one continues in the next, so the whole ring closes.
    const auto cells = fits ? own : Index(double(own) / ringBands(map.m_settings));
    map.m_frequency = {"frequency", "Hz", 0.0, 1.0, cells, true};
    const Axis ring{"frequency", "Hz", 0.0, 1.0, bins, true};
    double stretch = 0.0;
    for (const double member : members) {
        const double step = isHarmonic ? member / familyCellsPerBin(settings) : 1.0;
        const double base = fits ? member * binsPerHz : stretch;
        for (int c = 0; c < channels; ++c)
            for (Index cell = 0; cell < cells; ++cell)
                map.m_places.push_back(
                    std::int32_t(ring.wrapped(c * own + std::lround(std::floor(base + step * double(cell))))));
        stretch += step * double(cells);
    }
    return map;
}

void FamilyMap::apply(std::span<const float> y, std::span<float> out) const
{
    if (m_settings.present == FamilySettings::Present::InTurn)
        return applyInTurn(y, out);
    Gathered all(out);
    all.add(y, m_places, std::plus<float>());
    all.finish(PowerOfSum());
}

/// Combines all channels of each member, then takes the largest.
void FamilyMap::applyInTurn(std::span<const float> y, std::span<float> out) const
{
    const auto larger = [](float a, float b) { return std::max(a, b); };
    const std::size_t ofMember = std::size_t(m_channels) * out.size();
    Gathered all(out);
    std::vector<float> member(out.size());
    for (std::span<const std::int32_t> places = m_places; !places.empty(); places = places.subspan(ofMember)) {
        Gathered channels(member);
        channels.add(y, places.first(ofMember), std::plus<float>());
        channels.finish(PowerOfSum());
        for (std::size_t cell = 0; cell < out.size(); ++cell)
            all.add(cell, member[cell], larger);
    }
    all.finish(powerOfLargest);
}

FamilyFrames::FamilyFrames(std::vector<NormalisedFramesPointer> lines, FamilyMap map)
    : NormalisedFrames(lines.front()->time(), lines.front()->grid()), m_lines(std::move(lines)), m_map(std::move(map))
{
    m_grid.axes = {m_map.frequency()};
}

void FamilyFrames::read(Index first, Index count, std::span<float> out) const
{
    const auto bins = std::size_t(m_lines.front()->grid().size());
    const auto cells = std::size_t(m_grid.size());
    const auto rows = std::size_t(count);
    std::vector<float> lines(m_lines.size() * rows * bins); // channel by channel
    for (std::size_t c = 0; c < m_lines.size(); ++c)
        m_lines[c]->read(first, count, std::span(lines).subspan(c * rows * bins, rows * bins));
    std::vector<float> frame(m_lines.size() * bins);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t c = 0; c < m_lines.size(); ++c)
            std::copy_n(lines.begin() + std::ptrdiff_t((c * rows + row) * bins), bins,
                        frame.begin() + std::ptrdiff_t(c * bins));
        m_map.apply(frame, out.subspan(row * cells, cells));
    }
}

NormalisedFramesPointer familyFrames(const std::vector<NormalisedFramesPointer> &channels,
                                     const FamilySettings &settings)
{
    const NormalisedFramesPointer &first = channels.front();
    if (!settings.isSum(int(channels.size())))
        return first;
    return std::make_shared<FamilyFrames>(
        channels, FamilyMap(settings, first->grid().axes.back(), first->geometry().hasRealEnds, int(channels.size())));
}

NormalisedFramesPointer familyFramesOnRing(const NormalisedFramesPointer &ring, const FamilySettings &settings,
                                           int channels)
{
    if (!settings.isSum(channels))
        return ring;
    const Axis &frequency = ring->grid().axes.back();
    return std::make_shared<FamilyFrames>(std::vector{ring},
                                          FamilyMap::onRing(settings, frequency.count, 1.0 / frequency.step, channels));
}

} // namespace faintline
