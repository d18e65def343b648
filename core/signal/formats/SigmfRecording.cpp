#include "signal/formats/SigmfRecording.h"

#include "base/json.h"
#include "base/oneLine.h"
#include "base/utc.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace faintline {

namespace {

    constexpr std::string_view metaEnding = ".sigmf-meta";
    constexpr std::string_view dataEnding = ".sigmf-data";

    std::string withEnding(const std::string &path, std::string_view ending)
    {
        return path.substr(0, path.size() - metaEnding.size()) + std::string(ending);
    }

    /// One of the objects of a metadata file, with its name for messages.
    class Section
    {
    public:
        Section(const Json &object, std::string name) : m_object(object), m_name(std::move(name))
        {
            if (!object.is_object())
                throw Error(m_name, "must be an object, { … }");
        }

        [[noreturn]] void refuse(const char *key, const std::string &why) const
        {
            throw Error(m_name + "." + key, why);
        }

        const std::string &name() const { return m_name; }

        const Json *find(const char *key) const
        {
            const auto found = m_object.find(key);
            return found == m_object.end() || found->is_null() ? nullptr : &*found;
        }

        std::optional<double> number(const char *key, double minimum, double maximum) const
        {
            const Json *value = find(key);
            if (!value)
                return std::nullopt;
            const double number = value->is_number() ? value->get<double>() : std::nan("");
            if (!(number >= minimum && number <= maximum))
                refuse(key, "must be a number in " + formatNumber(minimum) + " … " + formatNumber(maximum));
            return number;
        }

        Index count(const char *key, double minimum, double maximum, Index otherwise) const
        {
            const double value = number(key, minimum, maximum).value_or(double(otherwise));
            if (std::floor(value) != value)
                refuse(key, "must be a whole number");
            return Index(value);
        }

        std::optional<std::string> text(const char *key) const
        {
            const Json *value = find(key);
            if (value && !value->is_string())
                refuse(key, "must be a string");
            return value ? std::optional(value->get<std::string>()) : std::nullopt;
        }

    private:
        const Json &m_object;
        std::string m_name;
    };

    constexpr double largestSampleCount = 9007199254740992.0; // 2⁵³

    constexpr double crystalError = 200e-6;

    /// "… is 2.5 s later than "
    std::string timeIs(Index sample, double late)
    {
        return "The core:datetime of the capture at sample " + std::to_string(sample) + " is "
               + formatNumber(std::round(1e3 * std::abs(late)) / 1e3) + " s " + (late > 0.0 ? "later" : "earlier")
               + " than ";
    }

    /// The sample file of a metadata file, by its name or as specified in it.
    std::string dataPathOf(const Section &global, const std::string &path)
    {
        const std::optional<std::string> dataset = global.text("core:dataset");
        if (!dataset)
            return withEnding(path, dataEnding);
        if (std::filesystem::path(*dataset).has_parent_path() || dataset->find('\0') != std::string::npos)
            global.refuse("core:dataset", "must be the name of a file in the same folder");
        return (std::filesystem::path(path).parent_path() / *dataset).string();
    }

} // namespace

struct SigmfRecording::Meta {
    /// A sample whose place in time determines that of the following ones.
    struct Start {
        Index inTime;
        Index inFile;
    };
    /// A capture's time, of which the place is known.
    struct CaptureTime {
        Index number;            ///< of its first sample
        Index inTime;            ///< place of that
        double startUnixSeconds; ///< of the recording, by this time
        bool isWhole;            ///< seconds
    };
    std::string dataPath;
    RawLayout layout;
    double centreHz = 0.0;
    std::optional<double> startUnixSeconds;
    std::vector<std::string> notes;
    std::vector<Start> starts;
    std::vector<CaptureTime> stamps;
    std::optional<Index> firstGlobal;   ///< global index of the first sample
    std::optional<double> datedSeconds; ///< time of a sample, s since 1970 …
    Index datedInTime = 0;              ///< … which has this place
    bool isRetuned = false;             ///< another centre frequency was told
    bool isContradicted = false;        ///< a time before its sample number was told
    Index offset = 0;
    std::string json; ///< "global" and "captures"

    void readLayout(const Section &global);
    void readCapture(const Section &capture, bool isFirst);
    void placeByIndex(Index start, Index globalIndex);
    void placeByTime(Index start, const std::string &time, bool isPlaced);
    void settleStart();
    double lateness(const CaptureTime &stamp, const CaptureTime &other) const;
    Index inTimeOf(Index start) const;
};

bool SigmfRecording::isNamedSo(const std::string &path)
{
    return path.ends_with(metaEnding) || path.ends_with(dataEnding);
}

std::string SigmfRecording::dataPath(const std::string &path)
{
    return readMeta(path).dataPath;
}

std::string SigmfRecording::metaPath(const std::string &path)
{
    return withEnding(path, metaEnding);
}

SigmfRecording::Meta SigmfRecording::readMeta(const std::string &path)
{
    const std::string metaPath = SigmfRecording::metaPath(path);
    if (!std::filesystem::exists(metaPath))
        throw Error(path, metaPath == path ? "no such file"
                                           : "its metadata, " + metaPath
                                                 + ", is missing; without it the samples can be opened as raw ones "
                                                   "(such as --raw-type ci16_le --raw-rate 48000)");
    const Json json = readJsonFile(metaPath);
    if (!json.is_object() || !json.contains("global"))
        throw Error(metaPath, "is not SigMF metadata: it must be an object with a key \"global\"");
    const Section global(json["global"], metaPath + ": global");
    Meta meta;
    meta.readLayout(global);
    meta.offset = global.count("core:offset", 0.0, largestSampleCount, 0);
    meta.dataPath = dataPathOf(global, path);
    if (!std::filesystem::exists(meta.dataPath))
        throw Error(path, "its samples, " + meta.dataPath + ", are missing");

    const auto captures = json.find("captures");
    const bool hasCaptures = captures != json.end() && !captures->is_null();
    if (hasCaptures && !captures->is_array())
        throw Error(metaPath + ": captures", "must be a list, [ … ]");
    for (std::size_t i = 0; hasCaptures && i < captures->size(); ++i)
        meta.readCapture({(*captures)[i], metaPath + ": captures[" + std::to_string(i) + "]"}, i == 0);
    meta.settleStart();
    meta.json = Json{{"global", json["global"]}, {"captures", hasCaptures ? *captures : Json::array()}}.dump();
    return meta;
}

void SigmfRecording::Meta::readCapture(const Section &capture, bool isFirst)
{
    const Index start = capture.count("core:sample_start", 0.0, largestSampleCount, offset) - offset;
    const std::optional<double> frequency = capture.number("core:frequency", -1e15, 1e15);
    const Index header = capture.count("core:header_bytes", 0.0, largestSampleCount, 0);
    const std::optional<std::string> time = capture.text("core:datetime");
    const Json *index = capture.find("core:global_index");
    const bool isPlaced = index && index->is_number_unsigned() && index->get<double>() <= largestSampleCount;
    if (isPlaced)
        placeByIndex(start, index->get<Index>());
    if (time)
        placeByTime(start, *time, isPlaced);
    if (isFirst) {
        centreHz = frequency.value_or(0.0);
        layout.headerBytes = header;
    } else if (header > 0) {
        capture.refuse("core:header_bytes", "bytes can be skipped before the first capture only, not between captures");
    } else if (frequency && *frequency != centreHz && !isRetuned) {
        isRetuned = true;
        notes.push_back("From sample " + std::to_string(start) + " on, another capture has the centre frequency "
                        + formatNumber(*frequency) + " Hz; the first one's is used for all.");
    }
}

void SigmfRecording::Meta::readLayout(const Section &global)
{
    const std::optional<std::string> type = global.text("core:datatype");
    if (!type)
        global.refuse("core:datatype", "is missing; expected one of " + sampleTypeList());
    layout.type = parseSampleType(*type, global.name() + ".core:datatype");
    const std::optional<double> rate = global.number("core:sample_rate", 1e-9, 1e15);
    if (!rate)
        global.refuse("core:sample_rate", "is missing; frequencies require it");
    layout.sampleRateHz = *rate;
    layout.channelCount = int(global.count("core:num_channels", 1.0, 1024.0, 1));
    layout.trailingBytes = global.count("core:trailing_bytes", 0.0, largestSampleCount, 0);
}

/// Place in time of a sample of the file, by the captures so far.
Index SigmfRecording::Meta::inTimeOf(Index start) const
{
    return starts.empty() ? start : starts.back().inTime + start - starts.back().inFile;
}

/// Adds a capture's first sample with its places in file and time, if samples are missing before it.
void SigmfRecording::Meta::placeByIndex(Index start, Index globalIndex)
{
    if (!firstGlobal) {
        firstGlobal = globalIndex - inTimeOf(start);
        return;
    }
    const Index inTime = globalIndex - *firstGlobal;
    const Index gap = inTime - inTimeOf(start);
    const bool isBackward = !starts.empty() && start < starts.back().inFile;
    if (gap < 0 || isBackward || double(inTime) > Stretches::longestSeconds * layout.sampleRateHz) {
        notes.push_back("From sample " + std::to_string(start)
                        + " on, core:global_index contradicts what comes before it and is ignored.");
        return;
    }
    if (gap > 0)
        starts.push_back({inTime, start});
}

/// Takes the start time from the first capture that has one. If a later one is late, and no index gives its place
/// (isPlaced), samples are missing before it. Those whose places are known are compared in settleStart.
void SigmfRecording::Meta::placeByTime(Index start, const std::string &time, bool isPlaced)
{
    const std::optional<double> seconds = parseUtc(time);
    const double rate = layout.sampleRateHz;
    const Index inTime = inTimeOf(start);
    if (!seconds) {
        notes.push_back("core:datetime \"" + oneLine(time, 40) + "\" is not an ISO 8601 time and is ignored.");
        return;
    }
    const bool isWhole = time.find('.') == std::string::npos && time.find(',') == std::string::npos;
    if (isPlaced || !datedSeconds)
        stamps.push_back({offset + start, inTime, *seconds - double(inTime) / rate, isWhole});
    if (!datedSeconds) {
        startUnixSeconds = *seconds - double(inTime) / rate;
        datedSeconds = seconds;
        datedInTime = inTime;
        return;
    }
    if (isPlaced)
        return;
    const double elapsed = double(inTime - datedInTime) / rate;
    const double late = *seconds - *datedSeconds - elapsed;
    if (std::abs(late) <= (isWhole ? 1.0 : 0.01) + crystalError * std::abs(elapsed))
        return;
    const std::string where = timeIs(offset + start, late) + "its sample number tells";
    const bool isBackward = !starts.empty() && start < starts.back().inFile;
    if (late < 0.0 || isBackward || late > Stretches::longestSeconds) {
        if (!std::exchange(isContradicted, true))
            notes.push_back(where + "; the time is ignored.");
        return;
    }
    starts.push_back({inTime + std::llround(late * rate), start});
    datedSeconds = seconds;
    datedInTime = starts.back().inTime;
    notes.push_back(where + ": samples are missing before it" + (isWhole ? ", to within 1 s." : "."));
}

/// By how much a time is later than another one and the places of both tell; 0 within their resolution.
double SigmfRecording::Meta::lateness(const CaptureTime &stamp, const CaptureTime &other) const
{
    const double late = stamp.startUnixSeconds - other.startUnixSeconds;
    const double elapsed = double(stamp.inTime - other.inTime) / layout.sampleRateHz;
    const double resolution = (stamp.isWhole || other.isWhole ? 1.0 : 0.01) + crystalError * std::abs(elapsed);
    return std::abs(late) <= resolution ? 0.0 : late;
}

/// Of times whose places are known, those of the majority count: the first one may be stale.
void SigmfRecording::Meta::settleStart()
{
    if (stamps.size() < 2)
        return;
    std::vector<CaptureTime> sorted = stamps;
    const auto middle = sorted.begin() + std::ssize(sorted) / 2;
    std::ranges::nth_element(sorted, middle, {}, &CaptureTime::startUnixSeconds);
    const auto agrees = [&](const CaptureTime &stamp) { return lateness(stamp, *middle) == 0.0; };
    const bool isMajority = 2 * std::ranges::count_if(stamps, agrees) > std::ssize(stamps);
    const CaptureTime &right = isMajority ? *std::ranges::find_if(stamps, agrees) : stamps.front();
    startUnixSeconds = right.startUnixSeconds;
    const auto wrong =
        std::ranges::find_if(stamps, [&](const CaptureTime &stamp) { return lateness(stamp, right) != 0.0; });
    if (wrong != stamps.end())
        notes.push_back(timeIs(wrong->number, lateness(*wrong, right)) + "its core:global_index "
                        + (&right == &stamps.front() ? "tells" : "and most other times tell")
                        + "; the time is ignored.");
}

SigmfRecording::SigmfRecording(const std::string &path, bool iq) : SigmfRecording(path, readMeta(path), iq) {}

SigmfRecording::SigmfRecording(const std::string &path, const Meta &meta, bool iq)
    : RawRecording(meta.dataPath, iq ? withIqPairs(path, meta.layout) : meta.layout)
{
    m_info.path = path;
    m_info.container = "SigMF";
    m_info.centreHz = meta.centreHz;
    m_info.startUnixSeconds = meta.startUnixSeconds;
    m_info.notes.insert(m_info.notes.end(), meta.notes.begin(), meta.notes.end());
    m_info.firstNumber = meta.offset;
    m_info.sigmf = meta.json;
    placeInTime(meta);
}

void SigmfRecording::placeInTime(const Meta &meta)
{
    Meta::Start next{0, 0};
    Stretches &places = m_info.places;
    for (const Meta::Start &start : meta.starts) {
        if (start.inFile >= m_info.sampleCount) // not written yet
            continue;
        places.add(next.inTime, next.inFile, start.inFile - next.inFile);
        next = start;
    }
    places.add(next.inTime, next.inFile, m_info.sampleCount - next.inFile);
    if (!places.hasGaps())
        return;
    m_info.sampleCount = places.end();
    m_info.notes.push_back(std::to_string(places.gaps()) + " gap(s), in all " + std::to_string(places.missing())
                           + " samples, which were not observed.");
}

void SigmfRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    fillStored(first, count, out, [&](Index inFile, std::span<float> part) { readFile(channel, inFile, part); });
}

bool SigmfRecording::isWhole(Index first, Index count) const
{
    return m_info.places.isWhole(first, count);
}

} // namespace faintline
