#include "live/HeardRecording.h"

#include "live/streamInfo.h"

#include <algorithm>

namespace faintline {

void WrittenSamples::beginFile(std::string dataPath)
{
    const std::lock_guard lock(m_mutex);
    m_files.push_back({std::move(dataPath), m_stored});
}

void WrittenSamples::add(Index inTime, Index count)
{
    const std::lock_guard lock(m_mutex);
    m_stretches.add(inTime, m_stored, count);
    m_stored += count;
}

Index WrittenSamples::end() const
{
    const std::lock_guard lock(m_mutex);
    return m_stretches.end();
}

bool WrittenSamples::isWhole(Index first, Index count) const
{
    const std::lock_guard lock(m_mutex);
    return m_stretches.isWhole(first, count);
}

void WrittenSamples::read(int channel, Index first, std::span<float> out) const
{
    std::vector<StoredPart> parts;
    { // the recorder does not wait for the disk
        const std::lock_guard lock(m_mutex);
        m_stretches.read(first, m_format.type.isComplex ? 2 : 1, out, [&](Index stored, std::span<float> part) {
            parts.push_back({stored, part});
        });
    }
    for (const StoredPart &part : parts)
        readStored(channel, part);
}

/// The file that holds a sample; reduces `count` to the samples that lie in the same file.
std::pair<std::shared_ptr<const FileBytes>, WrittenSamples::File> WrittenSamples::fileOf(Index stored,
                                                                                         Index &count) const
{
    const std::lock_guard lock(m_mutex);
    const auto next = std::upper_bound(m_files.begin(), m_files.end(), stored,
                                       [](Index wanted, const File &file) { return wanted < file.firstStored; });
    if (next != m_files.end())
        count = std::min(count, next->firstStored - stored);
    const File &file = *std::prev(next);
    if (!m_open || m_open->path() != file.path)
        m_open = std::make_shared<const FileBytes>(file.path);
    return {m_open, file};
}

void WrittenSamples::readStored(int channel, const StoredPart &part) const
{
    const Index floats = m_format.type.isComplex ? 2 : 1;
    const Index whole = std::ssize(part.out) / floats;
    std::vector<std::byte> bytes;
    for (Index done = 0, count = 0; done < whole; done += count) {
        count = whole - done;
        const auto [file, place] = fileOf(part.stored + done, count);
        bytes.assign(std::size_t(count * m_format.frameBytes()), std::byte{0});
        file->readAt((part.stored + done - place.firstStored) * m_format.frameBytes(), bytes);
        convertSamples(m_format.type,
                       std::span<const std::byte>(bytes).subspan(std::size_t(channel * m_format.type.sampleBytes())),
                       m_format.frameBytes(),
                       part.out.subspan(std::size_t(done * floats), std::size_t(count * floats)));
    }
}

HeardRecording::HeardRecording(std::shared_ptr<const WrittenSamples> written, std::optional<Index> samples)
    : m_written(std::move(written))
{
    m_info = streamInfo(m_written->format());
    m_info.sampleCount = samples.value_or(endlessSamples);
    m_info.startUnixSeconds = m_written->startUnixSeconds();
}

void HeardRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) { m_written->read(channel, from, inside); });
}

} // namespace faintline
