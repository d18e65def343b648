#include "signal/formats/KiwiRecording.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/numberText.h"
#include "signal/formats/bytes.h"
#include "signal/formats/riffChunks.h"
#include "signal/timeInName.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace faintline {

namespace {

    constexpr std::size_t mostRuns = 1 << 20;

    /// The GNSS second of the week of a chunk's first sample; nothing if the receiver had no fix.
    std::optional<double> stampOf(const FileBytes &file, const RiffChunk &kiwi)
    {
        constexpr Index stampBytes = 10;
        std::array<std::byte, stampBytes> content;
        if (kiwi.length < stampBytes || file.readAt(kiwi.offset, content) < content.size())
            return std::nullopt;
        constexpr int noFix = 255;
        constexpr double week = 604800.0;
        const double seconds = numberAt<std::uint32_t>(content, 2) + 1e-9 * numberAt<std::uint32_t>(content, 6);
        const bool isSound = std::to_integer<int>(content[0]) != noFix && seconds < week;
        return isSound ? std::optional(seconds) : std::nullopt;
    }

    /// The sample clock derived from a file's time stamps.
    class StampedClock
    {
    public:
        explicit StampedClock(double nominalHz) : m_nominalHz(nominalHz) {}

        void add(Index sample, std::optional<double> stamp)
        {
            if (!stamp)
                return;
            constexpr double week = 604800.0;
            if (m_isKnown && *stamp < m_last.seconds - m_weeks * week - 0.5 * week)
                m_weeks += 1.0;
            const Stamp now{sample, *stamp + m_weeks * week};
            if (!m_isKnown)
                m_first = m_last = m_begin = m_longestBegin = m_longestEnd = now;
            m_isKnown = true;
            if (sample > m_last.sample) {
                const double expected = double(sample - m_last.sample) / m_nominalHz;
                const double missing = now.seconds - m_last.seconds - expected;
                if (std::abs(missing) > longestBetweenBlocks && m_stale == 0.0 && m_last.sample == m_first.sample) {
                    m_stale = missing;
                    m_first = m_begin = m_longestBegin = m_longestEnd = now;
                } else if (std::abs(missing) > 0.5 * expected) {
                    if (m_gaps.size() < mostRuns)
                        m_gaps.push_back({sample, missing});
                    m_begin = now;
                }
            }
            m_last = now;
            if (now.sample - m_begin.sample > m_longestEnd.sample - m_longestBegin.sample) {
                m_longestBegin = m_begin;
                m_longestEnd = now;
            }
        }

        /// Over the longest stretch without a gap; the header's rate if that is short, contradicts it, or agrees with it
        /// to the stamps' nanosecond.
        double rateHz() const
        {
            const double seconds = m_longestEnd.seconds - m_longestBegin.seconds;
            const double rate = double(m_longestEnd.sample - m_longestBegin.sample) / seconds;
            constexpr double farOff = 1e-3;
            constexpr double rateFromSeconds = 1.0;
            constexpr double resolution = 2e-9; // of a difference of two stamps
            const double off = std::abs(rate / m_nominalHz - 1.0);
            return seconds >= rateFromSeconds && off < farOff && off * seconds > resolution ? rate : m_nominalHz;
        }

        /// Second of the GPS week of the first sample.
        std::optional<double> firstSecond() const
        {
            return m_isKnown ? std::optional(m_first.seconds - double(m_first.sample) / rateHz()) : std::nullopt;
        }

        /// Places of `stored` samples in time; adds contradictions between stamps to `notes`.
        Stretches stretches(Index stored, std::vector<std::string> &notes) const
        {
            Stretches stretches;
            Index begin = 0;
            Index shift = 0;
            for (const Gap &gap : m_gaps) {
                const Index missing = std::llround(gap.seconds * rateHz());
                if (missing < 0 || double(gap.sample + shift + missing) > Stretches::longestSeconds * rateHz()) {
                    notes.push_back("The time stamp of sample " + std::to_string(gap.sample)
                                    + " contradicts those before it and is ignored.");
                    break;
                }
                stretches.add(begin + shift, begin, gap.sample - begin);
                begin = gap.sample;
                shift += missing;
            }
            stretches.add(begin + shift, begin, stored - begin);
            return stretches;
        }

        std::vector<std::string> notes() const
        {
            std::vector<std::string> notes;
            if (m_isKnown)
                notes.push_back("The first time stamp is second " + formatPlainly(m_first.seconds)
                                + " of the GPS week.");
            if (m_stale != 0.0)
                notes.push_back("The time stamp of the first block, " + formatNumber(std::round(std::abs(m_stale)))
                                + " s " + (m_stale > 0.0 ? "before" : "after")
                                + " those of the next ones, is not of its time and is ignored.");
            if (rateHz() != m_nominalHz)
                notes.push_back("The sample rate is that of the time stamps; the header says "
                                + formatNumber(m_nominalHz) + " Hz.");
            return notes;
        }

    private:
        struct Stamp {
            Index sample = 0;
            double seconds = 0.0;
        };

        struct Gap {
            Index sample; ///< first sample after it
            double seconds;
        };

        /// A receiver that was idle stamps its first block with the time of an earlier one.
        static constexpr double longestBetweenBlocks = 10.0; // s

        double m_nominalHz;
        double m_weeks = 0.0;
        double m_stale = 0.0;   ///< by how much the first stamp is too early, s; 0: it is not
        bool m_isKnown = false; ///< whether there was a stamp
        Stamp m_first, m_last;
        Stamp m_begin;                      ///< of the current stretch without a gap
        Stamp m_longestBegin, m_longestEnd; ///< of the longest one
        std::vector<Gap> m_gaps;
    };

} // namespace

bool KiwiRecording::recognises(const std::string &path)
{
    const FileBytes file(path);
    if (!isWave(file, "RIFF"))
        return false;
    const std::optional<RiffChunk> format = riffChunkAt(file, riffHeadBytes);
    if (!format || format->name != "fmt ")
        return false;
    const std::optional<RiffChunk> next = riffChunkAt(file, format->end());
    return next && next->name == "kiwi";
}

KiwiRecording::KiwiRecording(const std::string &path) : m_file(path)
{
    static_assert(std::endian::native == std::endian::little);
    const std::optional<RiffChunk> format = riffChunkAt(m_file, riffHeadBytes);
    std::array<std::byte, 16> fields;
    if (!isWave(m_file, "RIFF") || !format || format->name != "fmt "
        || m_file.readAt(format->offset, fields) < fields.size())
        throw Error(path, "is not a KiwiSDR WAV file");
    const auto channels = numberAt<std::uint16_t>(fields, 2);
    const double nominalHz = numberAt<std::uint32_t>(fields, 4);
    const auto bits = numberAt<std::uint16_t>(fields, 14);
    if (numberAt<std::uint16_t>(fields, 0) != 1 || bits != 16 || channels < 1 || channels > 2 || !(nominalHz > 0.0))
        throw Error(path, "has " + std::to_string(channels) + " channel(s) of " + std::to_string(bits) + " bits at "
                              + formatNumber(nominalHz) + " Hz; a KiwiSDR writes 1 or 2 of 16 bits");
    m_bytesPerSample = 2 * channels;

    StampedClock clock(nominalHz);
    std::optional<double> stamp;
    for (auto chunk = riffChunkAt(m_file, format->end()); chunk; chunk = riffChunkAt(m_file, chunk->end())) {
        if (chunk->name == "kiwi")
            stamp = stampOf(m_file, *chunk);
        if (chunk->name != "data")
            continue;
        const Index there = std::min(chunk->length, m_file.size() - chunk->offset);
        clock.add(stored(), std::exchange(stamp, std::nullopt));
        add(chunk->offset, there / m_bytesPerSample);
        if (there < chunk->length)
            m_info.notes.push_back("The file ends within a chunk of samples; the existing part is read.");
    }
    if (stored() == 0)
        throw Error(path, "is a KiwiSDR WAV file without samples");
    m_info.path = path;
    m_info.container = "KiwiSDR WAV";
    m_info.sampleType = "int16";
    m_info.channelCount = 1;
    m_info.isComplex = channels == 2;
    m_info.sampleRateHz = clock.rateHz();
    const std::vector<std::string> said = clock.notes();
    m_info.notes.insert(m_info.notes.end(), said.begin(), said.end());
    const auto second = clock.firstSecond();
    if (const auto named = timeInName(path); named && second)
        m_info.startUnixSeconds = unixFromGpsWeekSecond(*second, *named);
    const Stretches &places = m_info.places = clock.stretches(stored(), m_info.notes);
    m_info.sampleCount = places.end();
    if (places.hasGaps())
        m_info.notes.push_back("The time stamps show " + std::to_string(places.gaps()) + " gap(s), "
                               + formatNumber(std::round(1e3 * double(places.missing()) / m_info.sampleRateHz) / 1e3)
                               + " s in total, which were not observed.");
}

Index KiwiRecording::stored() const
{
    return m_runs.empty() ? 0 : m_runs.back().firstSample + m_runs.back().samples * m_runs.back().count;
}

void KiwiRecording::add(Index offset, Index samples)
{
    if (samples <= 0)
        return;
    if (!m_runs.empty()) {
        ChunkRun &run = m_runs.back();
        const Index last = run.offset + (run.count - 1) * run.stride;
        if (run.samples == samples && (run.count == 1 || offset - last == run.stride)) {
            run.stride = offset - last;
            ++run.count;
            return;
        }
    }
    if (m_runs.size() >= mostRuns)
        throw Error(m_file.path(),
                    "has chunks of samples of more than a million sizes and distances, which no receiver writes");
    m_runs.push_back({stored(), offset, samples, 0, 1});
}

/// Reads samples of one run, from one of its samples on.
void KiwiRecording::readWithin(const ChunkRun &run, Index sample, std::span<float> out) const
{
    constexpr float fullScale = 32768.0f;
    const Index floats = m_info.floatsPerSample();
    std::vector<std::byte> bytes;
    while (!out.empty()) {
        const Index within = sample % run.samples;
        const Index count = std::min(run.samples - within, std::ssize(out) / floats);
        bytes.resize(std::size_t(count * m_bytesPerSample));
        const Index at = run.offset + sample / run.samples * run.stride + within * m_bytesPerSample;
        if (m_file.readAt(at, bytes) < bytes.size())
            throw Error(m_info.path, "was truncated while open", Error::Kind::Failure);
        for (std::size_t i = 0; i < std::size_t(count * floats); ++i)
            out[i] = float(numberAt<std::int16_t>(bytes, 2 * i)) / fullScale;
        out = out.subspan(std::size_t(count * floats));
        sample += count;
    }
}

void KiwiRecording::readStored(Index sample, std::span<float> out) const
{
    auto run = std::upper_bound(m_runs.begin(), m_runs.end(), sample,
                                [](Index wanted, const ChunkRun &r) { return wanted < r.firstSample; })
               - 1;
    const Index floats = m_info.floatsPerSample();
    for (; !out.empty(); ++run) {
        const Index within = sample - run->firstSample;
        const Index here = std::min(run->samples * run->count - within, std::ssize(out) / floats);
        readWithin(*run, within, out.first(std::size_t(here * floats)));
        out = out.subspan(std::size_t(here * floats));
        sample += here;
    }
}

void KiwiRecording::read(int, Index first, Index count, std::span<float> out) const
{
    fillStored(first, count, out, [&](Index sample, std::span<float> part) { readStored(sample, part); });
}

} // namespace faintline
