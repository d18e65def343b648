#include "signal/Recording.h"

#include "base/multiversion.h"
#include "base/numberText.h"
#include "signal/timeInName.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace faintline {

namespace {

    /// Replaces values that are not finite by 0; returns their number.
    FAINTLINE_MULTIVERSION
    Index clearNonFinite(float *values, std::size_t n)
    {
        constexpr std::uint32_t exponent = 0x7f800000u;
        Index found = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const auto bits = std::bit_cast<std::uint32_t>(values[i]);
            const bool isFinite = (bits & exponent) != exponent;
            values[i] = std::bit_cast<float>(isFinite ? bits : 0u);
            found += isFinite ? 0 : 1;
        }
        return found;
    }

    constexpr Index finiteBlockSamples = 1 << 16;

    /// Where nonFiniteIn collects samples while a read of this thread runs.
    thread_local std::vector<Index> *wantedNonFinite = nullptr;

    void collectNonFinite(std::span<const float> values, Index first, Index floatsPerSample)
    {
        for (Index i = 0; i < std::ssize(values); ++i) {
            const Index sample = first + i / floatsPerSample;
            if (!std::isfinite(values[std::size_t(i)])
                && (wantedNonFinite->empty() || wantedNonFinite->back() != sample))
                wantedNonFinite->push_back(sample);
        }
    }

    /// Runs of samples in a row, one for all if there are many.
    std::vector<std::pair<Index, Index>> runsOf(const std::vector<Index> &samples)
    {
        constexpr std::size_t mostRunsOfBlock = 256;
        std::vector<std::pair<Index, Index>> runs;
        for (const Index sample : samples)
            if (!runs.empty() && runs.back().second + 1 == sample)
                runs.back().second = sample;
            else
                runs.emplace_back(sample, sample);
        if (runs.size() > mostRunsOfBlock)
            return {{samples.front(), samples.back()}};
        return runs;
    }

} // namespace

std::vector<Index> Recording::nonFiniteIn(int channel, Index first, Index count) const
{
    std::vector<Index> found;
    std::vector<float> samples(std::size_t(count * m_info.floatsPerSample()));
    struct Restore {
        std::vector<Index> *before = wantedNonFinite;
        ~Restore() { wantedNonFinite = before; }
    } const restore;
    wantedNonFinite = &found;
    read(channel, first, count, samples);
    return found;
}

bool Recording::isFiniteByReading(int channel, Index first, Index count) const
{
    const Index end = std::min(first + count, m_info.sampleCount);
    first = std::max<Index>(0, first);
    for (Index block = first / finiteBlockSamples; block * finiteBlockSamples < end; ++block) {
        const std::lock_guard lock(m_finiteMutex);
        const auto [known, isNew] = m_nonFinite.try_emplace({channel, block});
        if (isNew)
            try {
                const Index from = block * finiteBlockSamples;
                known->second =
                    runsOf(nonFiniteIn(channel, from, std::min(finiteBlockSamples, m_info.sampleCount - from)));
            } catch (...) {
                m_nonFinite.erase(known);
                throw;
            }
        for (const auto &[from, to] : known->second)
            if (to >= first && from < end)
                return false;
    }
    return true;
}

void Recording::completeByName()
{
    if (!m_info.startUnixSeconds && (m_info.startUnixSeconds = timeInName(m_info.path)))
        m_info.notes.push_back("Start time taken from the file's name, read as UTC unless it tells a zone.");
    const std::optional<ReceiverName> name = receiverName(m_info.path);
    if (!name || m_info.isCentreKnown() == m_info.isComplex)
        return;
    if (m_info.isComplex) {
        m_info.centreHz = name->centreHz;
        m_info.notes.push_back(
            (name->rawType.empty() ? "Centre frequency" : "Centre frequency, and what else was not given,")
            + std::string(" taken from the file's name, as ") + name->program + " writes it.");
    } else if (m_info.channelCount == 2) {
        m_info.notes.push_back("The file's name is that of a recording of I and Q around "
                               + formatPlainly(name->centreHz) + " Hz by " + name->program
                               + ": its two channels may be I and Q.");
    }
}

int Recording::scaleExponentOf(double magnitude)
{
    constexpr int step = 60;
    constexpr int exponentLimit = 120; // the range of floats ends beyond it
    if (!(magnitude > 0.0) || !std::isfinite(magnitude))
        return 0;
    return std::clamp(step * int(std::lround(std::log2(magnitude) / step)), -exponentLimit, exponentLimit);
}

/// Mean magnitude of the non-zero samples from one on; 0 if there are none.
double Recording::meanMagnitude(int channel, Index first, std::span<float> samples) const
{
    read(channel, first, std::ssize(samples) / m_info.floatsPerSample(), samples);
    double sum = 0.0;
    double count = 0.0;
    for (const float value : samples)
        if (value != 0.0f) {
            sum += double(std::abs(value));
            count += 1.0;
        }
    return count > 0.0 ? sum / count : 0.0;
}

int Recording::measuredScaleExponent(int channel) const
{
    constexpr Index stretches = 64;
    constexpr Index stretchSamples = 64;
    constexpr Index blockSamples = 1 << 16;
    std::vector<double> magnitudes;
    std::vector<float> samples(std::size_t(stretchSamples * m_info.floatsPerSample()));
    const Index step = std::max(stretchSamples, m_info.sampleCount / stretches);
    for (Index first = 0; first < m_info.sampleCount; first += step)
        if (const double magnitude = meanMagnitude(channel, first, samples); magnitude > 0.0)
            magnitudes.push_back(magnitude);
    samples.resize(std::size_t(blockSamples * m_info.floatsPerSample()));
    for (Index first = 0; magnitudes.empty() && first < m_info.sampleCount; first += blockSamples)
        if (const double magnitude = meanMagnitude(channel, first, samples); magnitude > 0.0)
            magnitudes.push_back(magnitude);
    if (magnitudes.empty())
        return 0;
    const auto middle = magnitudes.begin() + std::ssize(magnitudes) / 2;
    std::nth_element(magnitudes.begin(), middle, magnitudes.end());
    return scaleExponentOf(*middle);
}

void Recording::fill(Index first, Index count, std::span<float> out,
                     const std::function<void(Index first, std::span<float> out)> &fetch) const
{
    const Index floats = m_info.floatsPerSample();
    out = out.first(std::size_t(std::max<Index>(count, 0) * floats));
    const Index begin = std::clamp<Index>(first, 0, m_info.sampleCount);
    const Index end = first >= m_info.sampleCount ? begin : std::clamp<Index>(first + count, begin, m_info.sampleCount);
    if (begin == end) {
        std::fill(out.begin(), out.end(), 0.0f);
        return;
    }
    const std::size_t before = std::size_t((begin - first) * floats);
    const std::span<float> inside = out.subspan(before, std::size_t((end - begin) * floats));
    std::fill(out.begin(), out.begin() + Index(before), 0.0f);
    std::fill(out.begin() + Index(before + inside.size()), out.end(), 0.0f);
    fetch(begin, inside);
    if (wantedNonFinite) {
        collectNonFinite(inside, begin, floats);
        clearNonFinite(inside.data(), inside.size());
        return;
    }
    if (const Index found = clearNonFinite(inside.data(), inside.size()))
        m_nonFiniteCount.fetch_add(found, std::memory_order_relaxed);
}

void Recording::fillStored(Index first, Index count, std::span<float> out,
                           const std::function<void(Index stored, std::span<float> out)> &fetch) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        if (m_info.places.hasGaps())
            m_info.places.read(from, m_info.floatsPerSample(), inside, fetch);
        else
            fetch(from, inside);
    });
}

} // namespace faintline
