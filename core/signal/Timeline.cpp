#include "signal/Timeline.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/files/fileName.h"
#include "signal/fileFormats.h"
#include "signal/formats/SigmfRecording.h"
#include "signal/timeInName.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

namespace faintline {

namespace fs = std::filesystem;

namespace {

    constexpr std::size_t mostOpen = 8;
    constexpr std::size_t mostFiles = 1'000'000;
    constexpr const char *listEnding = ".timeline";

    /// Files that Digital RF stores beside its samples, and the one being written.
    bool isBesideSamples(const std::string &name)
    {
        return name == "drf_properties.h5" || name == "dmd_properties.h5" || name.starts_with("metadata@")
               || name.starts_with("tmp.rf@");
    }

    void addFolder(const fs::path &folder, std::set<std::string> &files)
    {
        std::error_code code;
        fs::directory_iterator entry(folder, code);
        for (const fs::directory_iterator end; !code && entry != end; entry.increment(code)) {
            std::error_code ignored;
            const std::string name = entry->path().filename().string();
            if (name.starts_with('.') || isBesideSamples(name))
                continue;
            if (entry->is_directory(ignored) && !entry->is_symlink(ignored))
                addFolder(entry->path(), files);
            else if (entry->is_regular_file(ignored) && isNamedLikeRecording(entry->path().native(), false))
                files.insert(entry->path().string());
            if (files.size() > mostFiles)
                throw Error(folder.string(), "holds more than a million recordings; choose a part of them");
        }
        if (code)
            throw Error(folder.string(), "cannot be read: " + code.message());
    }

    void addList(const std::string &path, std::set<std::string> &files)
    {
        constexpr std::size_t longestLine = 1 << 16;
        std::ifstream list(path, std::ios::binary);
        if (!list)
            throw Error(path, "cannot be read");
        std::string line;
        while (std::getline(list, line)) {
            if (line.ends_with('\r'))
                line.pop_back();
            if (line.empty() || line.starts_with('#'))
                continue;
            if (line.size() > longestLine || line.find('\0') != std::string::npos || files.size() >= mostFiles)
                throw Error(path, "is not a list of at most a million file names, one per line");
            const std::string name = (fs::path(path).parent_path() / line).lexically_normal().string();
            if (Timeline::isNamedSo(name))
                throw Error(path, "names " + name + ", which is a folder or a list itself; name files");
            files.insert(name);
        }
    }

    /// A sentence on files that were left out.
    std::string noteOf(const std::vector<Error> &broken)
    {
        constexpr std::size_t mostNamed = 3;
        std::string names;
        for (std::size_t i = 0; i < std::min(broken.size(), mostNamed); ++i)
            names += (i == 0 ? "" : ", ") + fs::path(broken[i].where()).filename().string() + " ("
                     + broken[i].why().substr(0, broken[i].why().find(';')) + ")";
        return std::to_string(broken.size()) + " file(s) hold no readable recording and are left out: " + names
               + (broken.size() > mostNamed ? " …" : ".");
    }

} // namespace

bool Timeline::isNamedSo(const std::string &path)
{
    std::error_code ignored;
    return hasEnding(path, listEnding) || fs::is_directory(path, ignored);
}

std::vector<std::string> Timeline::filesOf(const std::vector<std::string> &names)
{
    std::error_code ignored;
    std::set<std::string> files;
    for (const std::string &name : names) {
        std::set<std::string> found;
        if (fs::is_directory(name, ignored))
            addFolder(name, found);
        else if (isNamedSo(name))
            addList(name, found);
        else
            found.insert(name);
        if (found.empty())
            throw Error(name, "holds no recordings (files such as .wav, .flac or .sigmf-meta)");
        files.merge(found);
    }
    return {files.begin(), files.end()};
}

Timeline::Timeline(const std::vector<std::string> &names, OpenFile open) : m_openFile(std::move(open))
{
    std::vector<TimedFile> timed;
    std::vector<Error> broken;
    for (const std::string &file : filesOf(names))
        if (const RecordingPointer recording = openUnlessBroken(file, broken))
            timed.push_back(addPart(file, *recording));
    if (timed.empty())
        throw broken.front();
    const Alignment aligned = alignFiles(timed);
    std::vector<TimelinePart> ordered;
    Index stored = 0;
    for (const PlacedFile &place : aligned.places) {
        TimelinePart part = m_parts[place.file];
        part.place = place;
        part.firstStored = stored;
        m_stretches.add(place.inTime, stored, place.count);
        stored += place.count;
        ordered.push_back(std::move(part));
    }
    m_parts = std::move(ordered);
    m_info.path = names.front();
    m_info.sampleRateHz = aligned.rateHz;
    m_info.sampleCount = m_stretches.end();
    m_info.places = m_stretches;
    m_info.startUnixSeconds = aligned.startUnixSeconds;
    m_info.notes = aligned.notes;
    if (!broken.empty())
        m_info.notes.push_back(noteOf(broken));
    if (m_hasGapsWithin)
        m_info.notes.push_back("Some files have gaps of their own, which are not observed.");
}

/// Opens a file to read its header; null if it exists but holds no recording.
RecordingPointer Timeline::openUnlessBroken(const std::string &path, std::vector<Error> &broken) const
{
    try {
        return m_openFile(path);
    } catch (const Error &error) {
        std::error_code ignored;
        if (error.kind() == Error::Kind::Failure || !fs::is_regular_file(path, ignored))
            throw;
        broken.push_back(error);
        return nullptr;
    }
}

TimedFile Timeline::addPart(const std::string &path, const Recording &recording)
{
    const RecordingInfo &info = recording.info();
    const std::optional<NamedTime> named = stampInName(path);
    const std::optional<double> start = info.startUnixSeconds || !named ? info.startUnixSeconds : named->unixSeconds;
    if (!start)
        throw Error(path,
                    "has no time stamp in its header or its name (such as 20260123_235959); a timeline requires one");
    if (m_parts.empty()) {
        m_info = info;
        m_info.places = {}; // of one file
        m_info.firstNumber = 0;
        m_info.sigmf.clear();
    } else {
        checkLike(info);
    }
    const bool hasGaps = !recording.isWhole(0, info.sampleCount);
    m_hasGapsWithin = m_hasGapsWithin || hasGaps;
    const bool isFloat = info.sampleType.find("f32") != std::string::npos
                         || info.sampleType.find("f64") != std::string::npos || info.sampleType.starts_with("float");
    m_parts.push_back({path, {}, 0, info.sampleCount, hasGaps, isFloat});
    const bool isExact =
        info.startUnixSeconds
        && (info.container == "Digital RF" || info.container == "HDF5 strain" || info.container == "KiwiSDR WAV");
    const bool hasFraction = named && named->hasFraction && *start == named->unixSeconds;
    return {path, *start, info.sampleRateHz, info.sampleCount, isExact, hasFraction};
}

void Timeline::checkLike(const RecordingInfo &other) const
{
    const auto differs = [&](const std::string &what, const std::string &own, const std::string &first) {
        throw Error(other.path, "has " + what + " " + own + ", but " + m_info.path + " has " + first
                                    + "; files of one timeline must agree");
    };
    if (other.channelCount != m_info.channelCount)
        differs("a channel count of", std::to_string(other.channelCount), std::to_string(m_info.channelCount));
    if (other.isComplex != m_info.isComplex)
        differs("samples that are", other.isComplex ? "I/Q" : "real", m_info.isComplex ? "I/Q" : "real ones");
    if (other.centreHz != m_info.centreHz)
        differs("a centre frequency of", formatNumber(other.centreHz) + " Hz", formatNumber(m_info.centreHz) + " Hz");
}

RecordingPointer Timeline::partAt(std::size_t number) const
{
    const std::lock_guard lock(m_mutex);
    const auto known =
        std::find_if(m_open.begin(), m_open.end(), [&](const auto &each) { return each.first == number; });
    if (known != m_open.end()) {
        std::rotate(known, known + 1, m_open.end());
        return m_open.back().second;
    }
    const TimelinePart &part = m_parts[number];
    RecordingPointer opened = m_openFile(part.path);
    if (opened->info().sampleCount != part.fileSamples || opened->info().isComplex != m_info.isComplex
        || opened->info().channelCount != m_info.channelCount)
        throw Error(part.path, "has changed since the timeline was opened", Error::Kind::Failure);
    if (m_open.size() >= mostOpen)
        m_open.erase(m_open.begin());
    m_open.emplace_back(number, std::move(opened));
    return m_open.back().second;
}

/// The part that contains a sample.
std::size_t Timeline::partOf(Index stored) const
{
    const auto behind =
        std::upper_bound(m_parts.begin(), m_parts.end(), stored,
                         [](Index wanted, const TimelinePart &part) { return wanted < part.firstStored; });
    return std::size_t(behind - m_parts.begin()) - 1;
}

void Timeline::read(int channel, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        m_stretches.read(from, m_info.floatsPerSample(), inside,
                         [&](Index stored, std::span<float> part) { readStored(channel, stored, part); });
    });
}

void Timeline::readStored(int channel, Index stored, std::span<float> out) const
{
    const Index floats = m_info.floatsPerSample();
    for (std::size_t number = partOf(stored); !out.empty(); ++number) {
        const TimelinePart &part = m_parts[number];
        const Index within = stored - part.firstStored;
        const Index count = std::min(part.place.count - within, std::ssize(out) / floats);
        partAt(number)->read(channel, part.place.skipped + within, count, out.first(std::size_t(count * floats)));
        out = out.subspan(std::size_t(count * floats));
        stored += count;
    }
}

bool Timeline::isWhole(Index first, Index count) const
{
    if (!m_stretches.isWhole(first, count))
        return false;
    bool isWhole = true;
    const Index to = std::min(first + count, m_info.sampleCount);
    for (auto part = std::upper_bound(
             m_parts.begin(), m_parts.end(), std::max<Index>(0, first),
             [](Index wanted, const TimelinePart &each) { return wanted < each.place.inTime + each.place.count; });
         m_hasGapsWithin && isWhole && part != m_parts.end() && part->place.inTime < to; ++part) {
        const Index from = std::max(first, part->place.inTime) - part->place.inTime;
        const Index end = std::min(to - part->place.inTime, part->place.count);
        isWhole = !part->hasGaps
                  || partAt(std::size_t(part - m_parts.begin()))->isWhole(part->place.skipped + from, end - from);
    }
    return isWhole;
}

bool Timeline::isFinite(int channel, Index first, Index count) const
{
    const Index to = std::min(first + count, m_info.sampleCount);
    for (auto part = std::upper_bound(
             m_parts.begin(), m_parts.end(), std::max<Index>(0, first),
             [](Index wanted, const TimelinePart &each) { return wanted < each.place.inTime + each.place.count; });
         part != m_parts.end() && part->place.inTime < to; ++part) {
        const Index from = std::max(first, part->place.inTime) - part->place.inTime;
        const Index end = std::min(to - part->place.inTime, part->place.count);
        if (!part->isFloat)
            continue;
        const RecordingPointer recording = partAt(std::size_t(part - m_parts.begin()));
        if (!recording->isFinite(channel, part->place.skipped + from, end - from))
            return false;
    }
    return true;
}

/// Uses the first file that is not silent; all come from one recorder.
int Timeline::scaleExponent(int channel) const
{
    constexpr std::size_t mostAskedParts = 16;
    const std::size_t step = std::max<std::size_t>(1, m_parts.size() / mostAskedParts);
    for (std::size_t number = 0; number < m_parts.size(); number += step)
        if (const int exponent = partAt(number)->scaleExponent(channel); exponent != 0)
            return exponent;
    return 0;
}

std::vector<std::string> filesBehind(const std::vector<std::string> &names, bool areRaw)
{
    std::vector<std::string> files;
    for (const std::string &name : Timeline::filesOf(names)) {
        const bool isSigmf = !areRaw && SigmfRecording::isNamedSo(name);
        files.push_back(isSigmf ? SigmfRecording::metaPath(name) : name);
        if (isSigmf)
            files.push_back(SigmfRecording::dataPath(name));
    }
    return files;
}

} // namespace faintline
