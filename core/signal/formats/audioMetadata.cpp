#include "signal/formats/AudioDecoder.h"

#include "base/utc.h"
#include "signal/formats/bytes.h"
#include "signal/timeInName.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <regex>
#include <span>
#include <string_view>
#include <utility>

namespace faintline {

namespace {

    constexpr std::array<std::pair<int, const char *>, 10> containers{{
        {SF_FORMAT_WAV, "WAV"},
        {SF_FORMAT_WAVEX, "WAV"},
        {SF_FORMAT_RF64, "RF64"},
        {SF_FORMAT_W64, "W64"},
        {SF_FORMAT_AIFF, "AIFF"},
        {SF_FORMAT_FLAC, "FLAC"},
        {SF_FORMAT_CAF, "CAF"},
        {SF_FORMAT_OGG, "OGG"},
        {SF_FORMAT_AU, "AU"},
        {SF_FORMAT_MPEG, "MP3"},
    }};

    constexpr std::array<std::pair<int, const char *>, 11> sampleTypes{{
        {SF_FORMAT_PCM_S8, "int8"},
        {SF_FORMAT_PCM_16, "int16"},
        {SF_FORMAT_PCM_24, "int24"},
        {SF_FORMAT_PCM_32, "int32"},
        {SF_FORMAT_PCM_U8, "uint8"},
        {SF_FORMAT_FLOAT, "float32"},
        {SF_FORMAT_DOUBLE, "float64"},
        {SF_FORMAT_ULAW, "µ-law"},
        {SF_FORMAT_ALAW, "A-law"},
        {SF_FORMAT_VORBIS, "Vorbis"},
        {SF_FORMAT_OPUS, "Opus"},
    }};

    std::string libraryName(int format)
    {
        SF_FORMAT_INFO info = {};
        info.format = format;
        if (sf_command(nullptr, SFC_GET_FORMAT_INFO, &info, sizeof info) != 0 || !info.name)
            return "unknown";
        return info.name;
    }

    template <std::size_t n>
    std::string nameIn(const std::array<std::pair<int, const char *>, n> &table, int format)
    {
        for (const auto &[known, name] : table)
            if (known == format)
                return name;
        return libraryName(format);
    }

    int numberIn(std::string_view text)
    {
        int value = -1;
        const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
        return code == std::errc() && end == text.data() + text.size() ? value : -1;
    }

    /// EBU Tech 3285: date yyyy-mm-dd, time hh-mm-ss with any separators; the reference counts samples from midnight.
    std::optional<double> bextTime(const SF_BROADCAST_INFO &bext, double rateHz)
    {
        const std::string_view date(bext.origination_date, sizeof bext.origination_date);
        const std::string_view time(bext.origination_time, sizeof bext.origination_time);
        const auto day =
            unixSeconds(numberIn(date.substr(0, 4)), numberIn(date.substr(5, 2)), numberIn(date.substr(8, 2)));
        const double samples = bext.time_reference_high * 0x1p32 + bext.time_reference_low;
        if (day && samples > 0.0 && samples < 86400.0 * rateHz)
            return *day + samples / rateHz;
        return unixSeconds(
            numberIn(date.substr(0, 4)), numberIn(date.substr(5, 2)), numberIn(date.substr(8, 2)),
            {numberIn(time.substr(0, 2)), numberIn(time.substr(3, 2)), double(numberIn(time.substr(6, 2)))});
    }

    /// A little-endian number of a chunk.
    std::uint32_t wordIn(const std::vector<std::byte> &chunk, std::size_t at, std::size_t count)
    {
        return std::uint32_t(littleEndian(std::span(chunk).subspan(at, count)));
    }

    /// SpectraVue's chunk, written by many receivers: two Windows SYSTEMTIMEs (start, stop), then the centre frequency.
    void readAuxi(const std::vector<std::byte> &auxi, RecordingInfo &info)
    {
        if (auxi.size() < 36)
            return;
        const auto word = [&](std::size_t i) { return int(wordIn(auxi, 2 * i, 2)); };
        const auto start = unixSeconds(word(0), word(1), word(3), {word(4), word(5), word(6) + word(7) / 1000.0});
        if (!start || word(0) < 1970)
            return;
        info.startUnixSeconds = start;
        info.notes.push_back("Start time taken from the auxi chunk, read as UTC.");
        if (info.isComplex) {
            info.centreHz = wordIn(auxi, 32, 4);
            info.notes.push_back("Centre frequency taken from the auxi chunk.");
        } else if (info.channelCount == 2) {
            info.notes.push_back(
                "The auxi chunk says that a receiver wrote this file: its two channels may be I and Q.");
        }
    }

    /// One stretch of samples of an XWAV (a "raw file"): start time and length.
    struct HarpEntry {
        double startUnixSeconds;
        Index samples;
    };

    /// Scripps' XWAV: deployment data, then an entry for each stretch. Returns the entries before the first one with an
    /// invalid time.
    std::vector<HarpEntry> harpEntries(const std::vector<std::byte> &harp, int channels)
    {
        constexpr std::size_t entriesAt = 56;
        constexpr std::size_t entryBytes = 32;
        constexpr Index sampleBytes = 2; // XWAV holds 16 bits
        std::vector<HarpEntry> entries;
        if (harp.size() < entriesAt + entryBytes)
            return entries;
        const std::size_t count = std::min<std::size_t>(wordIn(harp, 36, 2), (harp.size() - entriesAt) / entryBytes);
        for (std::size_t entry = 0; entry < count; ++entry) {
            const std::size_t at = entriesAt + entry * entryBytes;
            const auto byte = [&](std::size_t i) { return int(wordIn(harp, at + i, 1)); };
            const auto start = unixSeconds(2000 + byte(0), byte(1), byte(2),
                                           {byte(3), byte(4), byte(5) + wordIn(harp, at + 6, 2) / 1000.0});
            if (!start)
                break;
            entries.push_back({*start, Index(wordIn(harp, at + 12, 4)) / (sampleBytes * channels)});
        }
        return entries;
    }

    Stretches readHarp(const std::vector<std::byte> &harp, RecordingInfo &info)
    {
        constexpr double gapMinimumSeconds = 0.01; // its times are in milliseconds
        Stretches stretches;
        const std::vector<HarpEntry> entries = harpEntries(harp, std::max(1, info.channelCount));
        if (entries.empty() || info.isComplex)
            return stretches;
        info.startUnixSeconds = entries.front().startUnixSeconds;
        info.notes.push_back("Start time taken from the harp chunk, read as UTC.");
        Index stored = 0;
        for (const HarpEntry &entry : entries) {
            const double late =
                entry.startUnixSeconds - *info.startUnixSeconds - double(stretches.end()) / info.sampleRateHz;
            if (late > Stretches::longestSeconds)
                break;
            const Index gap = late > gapMinimumSeconds ? std::llround(late * info.sampleRateHz) : 0;
            const Index count = std::min(entry.samples, info.sampleCount - stored);
            stretches.add(stretches.end() + gap, stored, count);
            stored += std::max<Index>(0, count);
        }
        stretches.add(stretches.end(), stored, info.sampleCount - stored);
        if (stretches.hasGaps())
            info.notes.push_back("The harp chunk shows " + std::to_string(stretches.gaps()) + " gap(s), "
                                 + std::to_string(std::llround(double(stretches.missing()) / info.sampleRateHz))
                                 + " s in total, which were not observed.");
        return stretches;
    }

    /// A recorder's "Recorded at 19:22:55 14/12/2020 (UTC-5)", (UTC) or (UTC+5:30), as AudioMoth writes it.
    std::optional<double> commentTime(const std::string &comment)
    {
        static const std::regex pattern(R"((\d{1,2}):(\d{2}):(\d{2})(?:\.(\d{1,6}))? (\d{1,2})/(\d{1,2})/(\d{4}) )"
                                        R"(\(UTC(?:([+-])(\d{1,2})(?::?(\d{2}))?)?\))");
        std::smatch match;
        constexpr std::size_t commentLimitBytes = 4096;
        if (comment.size() > commentLimitBytes || !std::regex_search(comment, match, pattern))
            return std::nullopt;
        const auto whole = [&](std::size_t group) { return std::max(0, numberIn(match[group].str())); };
        const double fraction = whole(4) / std::pow(10.0, double(match[4].length()));
        const double zone = (match[8].str() == "-" ? -60.0 : 60.0) * (60 * whole(9) + whole(10));
        const auto time = unixSeconds(whole(7), whole(6), whole(5), {whole(1), whole(2), whole(3) + fraction});
        return time ? std::optional(*time - zone) : std::nullopt;
    }

    /// GUANO's "Timestamp: 2020-12-14T19:22:55-05:00", if it has a zone.
    std::optional<double> guanoTime(const std::vector<std::byte> &guano)
    {
        const std::string_view text = asText(guano);
        constexpr std::string_view key = "Timestamp:";
        const std::size_t at = text.starts_with(key) ? 0 : text.find("\nTimestamp:") + 1; // 0: none
        if (!text.substr(at).starts_with(key))
            return std::nullopt;
        std::string_view value = text.substr(at + key.size());
        value = value.substr(0, value.find_first_of("\r\n"));
        value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
        constexpr std::size_t dateDigits = 10;
        const bool hasZone = value.ends_with('Z') || value.find_first_of("+-", dateDigits) != std::string_view::npos;
        return hasZone ? parseUtc(value) : std::nullopt;
    }

    /// The start of a recording whose header holds the time when it was closed, which differs from the start in the
    /// file's name by the recording's length, and by whole quarters of an hour if the name has another zone.
    std::optional<double> startOfClosedFile(double said, const RecordingInfo &info)
    {
        constexpr double tolerance = 2.0; // of two times in whole seconds
        constexpr double quarter = 900.0;
        constexpr double zoneLimitSeconds = 14.0 * 3600.0;
        const std::optional<double> named = timeInName(info.path);
        const double lasts = info.durationSeconds();
        if (!named || lasts <= 2.0 * tolerance)
            return std::nullopt;
        const double rest = said - *named - lasts;
        if (std::abs(rest) <= tolerance)
            return named;
        const auto fromQuarter = [](double seconds) { return std::abs(std::remainder(seconds, quarter)); };
        const bool isZone = std::abs(rest) <= zoneLimitSeconds && fromQuarter(rest) <= tolerance;
        return isZone && fromQuarter(lasts) > 2.0 * tolerance ? std::optional(said - lasts) : std::nullopt;
    }

} // namespace

bool hasAiffRate(const FileBytes &file)
{
    std::array<std::byte, 18> head; // a chunk's name and length, or the contents of the common chunk
    const std::span<const std::byte> bytes(head);
    Index offset = 12;
    for (int chunks = 0; chunks < 1000 && file.readAt(offset, std::span(head).first(8)) == 8; ++chunks) {
        const bool isCommon = asText(head).starts_with("COMM");
        const auto length = Index(bigEndian(bytes.subspan(4, 4)));
        if (isCommon) {
            if (file.readAt(offset + 8, head) != head.size())
                return false;
            // Channels, frames, bits, then sign and exponent (bias 16383) in two bytes, and a significand with explicit
            // leading 1.
            const std::uint64_t exponent = bigEndian(bytes.subspan(8, 2));
            const bool isNormal = bigEndian(bytes.subspan(10, 4)) >> 31 != 0;
            return isNormal && exponent >= 16383
                   && exponent < 16383 + 30; // also false with a sign bit, and for infinity and NaN
        }
        offset += 8 + length + length % 2;
    }
    return false;
}

std::string containerName(int format)
{
    return nameIn(containers, format & SF_FORMAT_TYPEMASK);
}

std::string sampleTypeName(int format)
{
    return nameIn(sampleTypes, format & SF_FORMAT_SUBMASK);
}

Stretches readAudioMetadata(const AudioDecoder &decoder, RecordingInfo &info)
{
    std::optional<double> zoned = commentTime(decoder.text(SF_STR_COMMENT));
    if (!zoned)
        zoned = guanoTime(decoder.chunk("guan"));
    std::string from = "the recorder's comment, which tells its zone.";
    info.startUnixSeconds = zoned;
    if (const auto bext = zoned ? std::nullopt : decoder.broadcastInfo()) {
        info.startUnixSeconds = bextTime(*bext, info.sampleRateHz);
        from = "the bext chunk, read as UTC.";
    }
    if (!info.startUnixSeconds) {
        info.startUnixSeconds = parseUtc(decoder.text(SF_STR_DATE));
        from = "the header's date, read as UTC unless it tells a zone.";
    }
    if (const auto start =
            zoned || !info.startUnixSeconds ? std::nullopt : startOfClosedFile(*info.startUnixSeconds, info)) {
        info.startUnixSeconds = start;
        from = "the file's name: the header's time is that of the recording's end.";
    }
    const std::optional<double> before = info.startUnixSeconds;
    readAuxi(decoder.chunk("auxi"), info);
    Stretches stretches = readHarp(decoder.chunk("harp"), info);
    if (before && before == info.startUnixSeconds)
        info.notes.insert(info.notes.begin(), "Start time taken from " + from);
    return stretches;
}

long long missingBytes(const std::string &log)
{
    constexpr std::string_view words = "(should be ";
    constexpr std::array<std::string_view, 7> lengths{"RIFF", "riff", "Riff size", "FORM", "SSND", "data", "Data Size"};
    long long missing = 0;
    for (std::size_t lineStart = 0; lineStart < log.size();) {
        const std::size_t lineEnd = std::min(log.find('\n', lineStart), log.size());
        std::string_view line = std::string_view(log).substr(lineStart, lineEnd - lineStart);
        lineStart = lineEnd + 1;
        line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
        const std::size_t colon = line.find(':');
        const std::size_t should = line.find(words);
        if (colon == std::string_view::npos || should == std::string_view::npos)
            continue;
        for (const std::string_view name : lengths) {
            if (!line.starts_with(name))
                continue;
            long long claimed = 0;
            long long actual = 0;
            const std::string_view first = line.substr(std::min(line.find_first_not_of(' ', colon + 1), line.size()));
            const std::string_view second = line.substr(should + words.size());
            std::from_chars(first.data(), first.data() + first.size(), claimed);
            std::from_chars(second.data(), second.data() + second.size(), actual);
            missing = std::max(missing, claimed - actual);
        }
    }
    return missing;
}

} // namespace faintline
