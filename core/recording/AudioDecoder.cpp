#include "recording/AudioDecoder.h"

#include "base/Error.h"
#include "recording/listChunk.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string_view>

namespace faintline {

namespace {

    std::uint32_t littleEndian(std::span<const std::byte, 4> bytes)
    {
        std::uint32_t value = 0;
        for (std::size_t i = 4; i-- > 0;)
            value = value << 8 | std::uint32_t(bytes[i]);
        return value;
    }

    bool isChunkName(std::span<const std::byte, 4> name)
    {
        return std::all_of(name.begin(), name.end(),
                           [](std::byte c) { return c >= std::byte(32) && c < std::byte(127); });
    }

    /// Position of the length of a RIFF file's data chunk, if that length is 0 although no other chunk follows.
    std::optional<Index> unsetDataLength(const FileBytes &file)
    {
        std::array<std::byte, 8> header;
        const std::span<const std::byte, 8> view(header);
        const auto name = [&] { return std::string_view(reinterpret_cast<const char *>(header.data()), 4); };
        const auto readHeader = [&](Index offset) { return file.readAt(offset, header) == header.size(); };
        if (!readHeader(0) || name() != "RIFF")
            return std::nullopt;
        Index offset = 12;
        for (int chunks = 0; chunks < 1000 && readHeader(offset) && isChunkName(view.first<4>()); ++chunks) {
            const Index length = littleEndian(view.last<4>());
            const Index next = offset + 8 + length + length % 2;
            if (name() == "data") {
                if (length != 0 || !readHeader(next))
                    return std::nullopt;
                const Index following = littleEndian(view.last<4>());
                const bool isChunk = isChunkName(view.first<4>()) && next + 8 + following <= file.size() + 1;
                return isChunk ? std::nullopt : std::optional(offset + 4);
            }
            offset = next;
        }
        return std::nullopt;
    }

} // namespace

/// Input of libsndfile: a shared file, its own offset, and 4 bytes that may be replaced by 0xFF …. While it reads the
/// header, lists that would make it loop get an unknown name.
struct AudioDecoder::Source {
    std::shared_ptr<const FileBytes> file;
    std::optional<Index> patched;
    Index offset = 0;
    bool isOpening = true;

    static Source &of(void *user) { return *static_cast<Source *>(user); }

    static sf_count_t length(void *user) { return of(user).file->size(); }
    static sf_count_t tell(void *user) { return of(user).offset; }
    static sf_count_t write(const void *, sf_count_t, void *) { return 0; }

    static sf_count_t seek(sf_count_t offset, int whence, void *user)
    {
        Source &source = of(user);
        const Index base = whence == SEEK_CUR ? source.offset : whence == SEEK_END ? source.file->size() : 0;
        constexpr Index farthest = Index(1) << 60; // beyond the end of any file; a chunk's length may point there
        source.offset = std::clamp<Index>(base + std::clamp<Index>(offset, -farthest, farthest), 0, farthest);
        return source.offset;
    }

    static sf_count_t read(void *out, sf_count_t count, void *user)
    {
        Source &source = of(user);
        const std::span<std::byte> bytes(static_cast<std::byte *>(out), std::size_t(std::max<sf_count_t>(0, count)));
        Index got = 0;
        try {
            got = Index(source.file->readAt(source.offset, bytes));
        } catch (const Error &) {
            return 0; // an exception must not pass through C; the short read is noticed later
        }
        for (Index i = 0; source.patched && i < 4; ++i)
            if (const Index at = *source.patched + i - source.offset; at >= 0 && at < got)
                bytes[std::size_t(at)] = std::byte(0xff);
        source.offset += got;
        if (source.isOpening && got > 0 && source.isBehindBadList())
            bytes[std::size_t(got - 1)] = std::byte('x');
        return got;
    }

    bool isBehindBadList() const
    {
        std::array<std::byte, 4> name;
        const Index chunk = offset - std::ssize(name);
        if (chunk < 0 || file->readAt(chunk, name) < name.size())
            return false;
        const std::string_view text(reinterpret_cast<const char *>(name.data()), name.size());
        return (text == "LIST" || text == "INFO") && leadsBackwards(*file, chunk);
    }
};

AudioDecoder::AudioDecoder(std::unique_ptr<Source> source, SNDFILE *handle, const SF_INFO &format)
    : m_source(std::move(source)), m_handle(handle), m_format(format)
{
}

AudioDecoder::~AudioDecoder()
{
    sf_close(m_handle);
}

std::unique_ptr<AudioDecoder> AudioDecoder::open(std::shared_ptr<const FileBytes> file, std::string &why)
{
    auto source = std::make_unique<Source>();
    source->patched = unsetDataLength(*file);
    source->file = std::move(file);
    SF_VIRTUAL_IO access = {Source::length, Source::seek, Source::read, Source::write, Source::tell};
    SF_INFO format = {};
    SNDFILE *handle = sf_open_virtual(&access, SFM_READ, &format, source.get());
    if (!handle) {
        why = sf_strerror(nullptr);
        return nullptr;
    }
    source->isOpening = false;
    return std::unique_ptr<AudioDecoder>(new AudioDecoder(std::move(source), handle, format));
}

bool AudioDecoder::seek(Index sample)
{
    if (sample == m_position)
        return true;
    const bool isThere = sf_seek(m_handle, sample, SEEK_SET) == sample;
    m_position = isThere ? sample : -1;
    return isThere;
}

Index AudioDecoder::read(Index count, std::span<float> out)
{
    Index done = 0;
    while (done < count) {
        const sf_count_t got = sf_readf_float(m_handle, out.data() + done * m_format.channels, count - done);
        if (got <= 0)
            break;
        done += got;
    }
    m_position += done;
    return done;
}

std::string AudioDecoder::log() const
{
    std::string text(16384, '\0');
    sf_command(m_handle, SFC_GET_LOG_INFO, text.data(), int(text.size()));
    text.resize(std::min(text.find('\0'), text.size()));
    return text;
}

std::vector<std::byte> AudioDecoder::chunk(std::string_view id) const
{
    SF_CHUNK_INFO info = {};
    std::copy_n(id.data(), std::min(id.size(), sizeof info.id), info.id);
    info.id_size = unsigned(id.size());
    SF_CHUNK_ITERATOR *iterator = sf_get_chunk_iterator(m_handle, &info);
    constexpr unsigned largest = 1 << 20;
    if (!iterator || sf_get_chunk_size(iterator, &info) != SF_ERR_NO_ERROR || info.datalen > largest)
        return {};
    std::vector<std::byte> bytes(info.datalen);
    info.data = bytes.data();
    if (sf_get_chunk_data(iterator, &info) != SF_ERR_NO_ERROR)
        return {};
    return bytes;
}

std::optional<SF_BROADCAST_INFO> AudioDecoder::broadcastInfo() const
{
    SF_BROADCAST_INFO info = {};
    if (sf_command(m_handle, SFC_GET_BROADCAST_INFO, &info, sizeof info) != SF_TRUE)
        return std::nullopt;
    return info;
}

std::string AudioDecoder::text(int which) const
{
    const char *text = sf_get_string(m_handle, which);
    return text ? text : "";
}

} // namespace faintline
