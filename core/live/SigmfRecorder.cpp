#include "live/SigmfRecorder.h"

#include "base/Error.h"
#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "base/utc.h"
#include "signal/formats/SigmfRecording.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>

#include <fcntl.h>
#include <unistd.h>

namespace faintline {

namespace {

    constexpr std::string_view metaEnding = ".sigmf-meta";
    constexpr std::string_view dataEnding = ".sigmf-data";
    constexpr std::string_view listEnding = ".timeline";
    constexpr Index mostCaptures = 10000; ///< per file; each one rewrites the metadata

} // namespace

SigmfRecorder::SigmfRecorder(const std::string &path, const StreamFormat &format, const RotationSettings &rotation,
                             double startUnixSeconds)
    : m_format(format), m_rotation(rotation), m_startUnixSeconds(startUnixSeconds),
      m_writtenSamples(std::make_shared<WrittenSamples>(format, startUnixSeconds))
{
    if (!SigmfRecording::isNamedSo(path))
        throw Error(path, "recordings of what is heard are SigMF; the file name must end in .sigmf-meta");
    m_stem = path.substr(0, path.size() - metaEnding.size());
    checkIsNew(m_stem + std::string(listEnding));
    begin();
}

void SigmfRecorder::checkIsNew(const std::string &path) const
{
    if (std::filesystem::exists(path))
        throw Error(path, "exists already and is not overwritten; choose another name");
}

std::string SigmfRecorder::whole() const
{
    return m_files.size() == 1 ? m_files.front() : m_stem + std::string(listEnding);
}

SigmfRecorder::~SigmfRecorder()
{
    ::close(m_descriptor);
}

void SigmfRecorder::begin()
{
    const std::string stem = m_files.empty() ? m_stem : m_stem + "-" + std::to_string(m_files.size() + 1);
    const std::string data = stem + std::string(dataEnding);
    for (const std::string &name : {stem + std::string(metaEnding), data})
        checkIsNew(name);
    const int descriptor = ::open(data.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0)
        throw Error(data, std::string("cannot be written: ") + std::strerror(errno));
    if (m_descriptor >= 0)
        ::close(m_descriptor);
    m_descriptor = descriptor;
    m_fileStart = m_position;
    m_written = 0;
    m_captures = {{0, m_position}};
    m_isAfterGap = false;
    m_files.push_back(stem + std::string(metaEnding));
    m_writtenSamples->beginFile(data);
    writeMeta();
    if (m_files.size() > 1)
        writeList();
}

void SigmfRecorder::writeList() const
{
    std::string names;
    for (const std::string &file : m_files)
        names += std::filesystem::path(file).filename().string() + "\n";
    writeTextFile(whole(), names, Durability::Program, Written::Document);
}

void SigmfRecorder::writeMeta() const
{
    Json global;
    global["core:datatype"] = m_format.type.name();
    global["core:sample_rate"] = m_format.sampleRateHz;
    global["core:version"] = "1.0.0";
    global["core:num_channels"] = m_format.channelCount;
    global["core:recorder"] = "Faintline";
    global["core:description"] = "Heard from " + m_format.origin;
    Json captures = Json::array();
    for (const Capture &each : m_captures) {
        Json capture;
        capture["core:sample_start"] = each.sampleStart;
        capture["core:global_index"] = each.globalIndex;
        if (m_format.centreHz != 0.0)
            capture["core:frequency"] = m_format.centreHz;
        capture["core:datetime"] = formatUtc(m_startUnixSeconds + double(each.globalIndex) / m_format.sampleRateHz);
        captures.push_back(std::move(capture));
    }
    const Json meta = {{"global", global}, {"captures", captures}, {"annotations", Json::array()}};
    writeTextFile(m_files.back(), meta.dump(4) + "\n", Durability::Program, Written::Document);
}

void SigmfRecorder::rotateIfDue()
{
    const double bytes = double(m_written) * double(m_format.frameBytes());
    const double seconds = double(m_position - m_fileStart) / m_format.sampleRateHz;
    const bool isDue = std::ssize(m_captures) >= mostCaptures
                       || (m_rotation.largestBytes > 0.0 && bytes >= m_rotation.largestBytes)
                       || (m_rotation.longestSeconds > 0.0 && seconds >= m_rotation.longestSeconds);
    if (isDue && m_written > 0)
        begin();
}

void SigmfRecorder::skip(Index samples)
{
    m_position += samples;
    m_isAfterGap = m_isAfterGap || samples > 0;
}

void SigmfRecorder::write(std::span<const std::byte> bytes)
{
    if (bytes.empty())
        return;
    rotateIfDue();
    if (m_isAfterGap) { // before the samples, so that a reader knows of the gap
        if (m_written == 0)
            m_captures.clear();
        m_captures.push_back({m_written, m_position});
        m_isAfterGap = false;
        writeMeta();
    }
    const Index count = std::ssize(bytes) / m_format.frameBytes();
    for (std::span<const std::byte> left = bytes; !left.empty();) {
        const ssize_t written = ::write(m_descriptor, left.data(), left.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0) {
            const int reason = errno;
            (void)!::ftruncate(m_descriptor, static_cast<off_t>(m_written * m_format.frameBytes()));
            throw Error(m_files.back(), std::string("cannot be written any further: ") + std::strerror(reason),
                        Error::Kind::Failure);
        }
        left = left.subspan(std::size_t(written));
    }
    m_writtenSamples->add(m_position, count);
    m_written += count;
    m_position += count;
}

double SigmfRecorder::secondsLeft() const
{
    std::error_code ignored;
    const std::filesystem::path folder = std::filesystem::absolute(m_files.back(), ignored).parent_path();
    const std::filesystem::space_info space = std::filesystem::space(folder, ignored);
    if (ignored)
        return std::numeric_limits<double>::infinity();
    return double(space.available) / (m_format.sampleRateHz * double(m_format.frameBytes()));
}

} // namespace faintline
