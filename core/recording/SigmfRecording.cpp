#include "recording/SigmfRecording.h"

#include "base/json.h"
#include "base/oneLine.h"
#include "base/utc.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

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

    constexpr double largestCount = 9007199254740992.0; // 2⁵³

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
    std::string dataPath;
    RawLayout layout;
    double centreHz = 0.0;
    std::optional<double> startUnixSeconds;
    std::vector<std::string> notes;
    std::vector<Start> starts;
    Index firstGlobal = 0;

    void readLayout(const Section &global);
    void readStartTime(const std::optional<std::string> &time, Index start);
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
    const Index offset = global.count("core:offset", 0.0, largestCount, 0);
    meta.dataPath = dataPathOf(global, path);
    if (!std::filesystem::exists(meta.dataPath))
        throw Error(path, "its samples, " + meta.dataPath + ", are missing");

    const auto captures = json.find("captures");
    if (captures == json.end() || captures->is_null())
        return meta;
    if (!captures->is_array())
        throw Error(metaPath + ": captures", "must be a list, [ … ]");
    for (std::size_t i = 0; i < captures->size(); ++i) {
        const Section capture((*captures)[i], metaPath + ": captures[" + std::to_string(i) + "]");
        const Index start = capture.count("core:sample_start", 0.0, largestCount, offset) - offset;
        const double frequency = capture.number("core:frequency", -1e15, 1e15).value_or(0.0);
        const Index header = capture.count("core:header_bytes", 0.0, largestCount, 0);
        const std::optional<std::string> time = capture.text("core:datetime");
        if (const Json *inTime = capture.find("core:global_index");
            inTime && inTime->is_number_unsigned() && inTime->get<double>() <= largestCount)
            addStretch(meta, start, inTime->get<Index>());
        if (i == 0) {
            meta.centreHz = frequency;
            meta.layout.headerBytes = header;
            meta.readStartTime(time, start);
        } else if (header > 0) {
            capture.refuse("core:header_bytes", "bytes can be skipped before the first capture only, not between "
                                                "captures");
        } else if (frequency != meta.centreHz) {
            meta.notes.push_back("From sample " + std::to_string(start)
                                 + " on, another capture has the centre frequency " + formatNumber(frequency)
                                 + " Hz; the first one's is used for all.");
            break;
        }
    }
    return meta;
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
    layout.trailingBytes = global.count("core:trailing_bytes", 0.0, largestCount, 0);
}

/// Sets the start time from that of a capture that begins with sample `start`.
void SigmfRecording::Meta::readStartTime(const std::optional<std::string> &time, Index start)
{
    startUnixSeconds = time ? parseUtc(*time) : std::nullopt;
    if (startUnixSeconds)
        *startUnixSeconds -= double(start) / layout.sampleRateHz;
    else if (time)
        notes.push_back("core:datetime \"" + oneLine(*time, 40) + "\" is not an ISO 8601 time and is ignored.");
}

/// Adds a capture's first sample with its places in file and time, if samples are missing before it.
void SigmfRecording::addStretch(Meta &meta, Index start, Index globalIndex)
{
    if (meta.starts.empty()) {
        meta.starts.push_back({start, start});
        meta.firstGlobal = globalIndex - start;
        return;
    }
    const Index inTime = globalIndex - meta.firstGlobal;
    const Meta::Start &last = meta.starts.back();
    const Index gap = (inTime - last.inTime) - (start - last.inFile);
    if (gap < 0 || start < last.inFile || double(inTime) > Stretches::longestSeconds * meta.layout.sampleRateHz) {
        meta.notes.push_back("From sample " + std::to_string(start)
                             + " on, core:global_index contradicts what comes before it and is ignored.");
        return;
    }
    if (gap > 0)
        meta.starts.push_back({inTime, start});
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
    placeInTime(meta);
}

void SigmfRecording::placeInTime(const Meta &meta)
{
    Meta::Start next{0, 0};
    for (const Meta::Start &start : meta.starts) {
        if (start.inFile >= m_info.sampleCount) // not written yet
            continue;
        m_stretches.add(next.inTime, next.inFile, start.inFile - next.inFile);
        next = start;
    }
    m_stretches.add(next.inTime, next.inFile, m_info.sampleCount - next.inFile);
    if (!m_stretches.hasGaps())
        return;
    m_info.sampleCount = m_stretches.end();
    m_info.notes.push_back(std::to_string(m_stretches.gaps()) + " gap(s), in all "
                           + std::to_string(m_stretches.missing()) + " samples, which were not observed.");
}

void SigmfRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    if (!m_stretches.hasGaps()) {
        RawRecording::read(channel, first, count, out);
        return;
    }
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        m_stretches.read(from, m_info.floatsPerSample(), inside,
                         [&](Index inFile, std::span<float> part) { readFile(channel, inFile, part); });
    });
}

bool SigmfRecording::isWhole(Index first, Index count) const
{
    return m_stretches.isWhole(first, count);
}

} // namespace faintline
