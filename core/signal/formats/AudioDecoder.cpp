#include "signal/formats/AudioDecoder.h"

#include "base/Error.h"
#include "signal/formats/bytes.h"
#include "signal/formats/riffChunks.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string_view>

namespace faintline {

namespace {

    constexpr Index fourGiB = Index(1) << 32; ///< where a length in 32 bits begins anew

    void append(std::vector<std::byte> &bytes, std::string_view name, std::uint64_t value, int valueBytes)
    {
        for (const char c : name)
            bytes.push_back(static_cast<std::byte>(c));
        for (int i = 0; i < valueBytes; ++i)
            bytes.push_back(std::byte(value >> (8 * i) & 0xff));
    }

    /// The header of a WAV file (RIFF or RF64) as its bytes tell it, independently of libsndfile.
    class WavChunks
    {
    public:
        explicit WavChunks(const FileBytes &file) : m_file(file)
        {
            m_isRf64 = isWave(file, "RF64");
            if (m_isRf64 || isWave(file, "RIFF"))
                walk(riffHeadBytes);
        }

        bool isComplete() const { return m_data.offset > 0 && find("fmt "); }

        /// Whether samples go on behind their declared length.
        bool isLonger() const { return isComplete() && m_dataBytes != m_data.length && !m_isTruncated; }

        std::vector<std::string> notes() const
        {
            if (isLonger())
                return {"The header gives " + std::to_string(m_data.length)
                        + " bytes of samples, but no chunk follows "
                          "them (it was never closed, or passed 4 GiB); "
                        + std::to_string(m_dataBytes) + " bytes are read."};
            if (m_paddingBytes > 0)
                return {"The last " + std::to_string(m_paddingBytes)
                        + " bytes of the file are 0, beyond the length in its header, and are not read."};
            return {};
        }

        Index dataOffset() const { return m_data.offset; }
        Index dataBytes() const { return m_dataBytes; }

        /// A header with the true length of the samples and only the named chunks.
        std::vector<std::byte> headerWith(std::span<const std::string_view> names) const
        {
            constexpr Index chunkLimitBytes = Index(1) << 20;
            std::vector<std::byte> kept;
            for (const RiffChunk &chunk : m_chunks) {
                const bool isList = chunk.name == "LIST" || chunk.name == "INFO";
                if (std::find(names.begin(), names.end(), chunk.name) == names.end() || chunk.length > chunkLimitBytes
                    || (isList && leadsBackwards(m_file, chunk.offset - chunkHeadBytes)))
                    continue;
                append(kept, chunk.name, std::uint64_t(chunk.length), 4);
                const std::size_t before = kept.size();
                kept.resize(before + std::size_t(chunk.length + chunk.length % 2));
                if (m_file.readAt(chunk.offset, std::span(kept).subspan(before, std::size_t(chunk.length)))
                    < std::size_t(chunk.length))
                    kept.resize(before - std::size_t(chunkHeadBytes));
            }
            constexpr Index ds64Bytes = 28;
            const Index all = 4 + std::ssize(kept) + chunkHeadBytes + m_dataBytes;
            const bool isLong = m_isRf64 || all + m_dataBytes % 2 >= fourGiB - 1;
            std::vector<std::byte> header;
            append(header, isLong ? "RF64" : "RIFF", std::uint64_t(isLong ? fourGiB - 1 : all), 4);
            append(header, "WAVE", 0, 0);
            if (isLong) {
                append(header, "ds64", std::uint64_t(ds64Bytes), 4);
                append(header, "", std::uint64_t(all + ds64Bytes + chunkHeadBytes), 8);
                append(header, "", std::uint64_t(m_dataBytes), 8);
                append(header, "", 0, 8); // samples of a compressed type
                append(header, "", 0, 4); // further lengths
            }
            header.insert(header.end(), kept.begin(), kept.end());
            append(header, "data", std::uint64_t(isLong ? fourGiB - 1 : m_dataBytes), 4);
            return header;
        }

        /// The names of the chunks that a header with only `names` leaves out, for a note.
        std::string others(std::span<const std::string_view> names) const
        {
            std::string text;
            for (const RiffChunk &chunk : m_chunks)
                if (std::find(names.begin(), names.end(), chunk.name) == names.end() && chunk.name != "ds64")
                    text += (text.empty() ? "" : ", ") + chunk.name;
            return text;
        }

        bool isRiff() const { return !m_isRf64; }

    private:
        const RiffChunk *find(std::string_view name) const
        {
            const auto found = std::find_if(m_chunks.begin(), m_chunks.end(),
                                            [&](const RiffChunk &chunk) { return chunk.name == name; });
            return found == m_chunks.end() ? nullptr : &*found;
        }

        /// A chunk with a printable name.
        std::optional<RiffChunk> chunkAt(Index offset) const
        {
            std::optional<RiffChunk> chunk = riffChunkAt(m_file, offset);
            const auto isPrintable = [](char c) { return c >= ' ' && c <= '~'; };
            return chunk && std::ranges::all_of(chunk->name, isPrintable) ? chunk : std::nullopt;
        }

        void walk(Index offset)
        {
            constexpr int mostChunks = 1000;
            std::optional<RiffChunk> chunk;
            for (int i = 0; i < mostChunks && (chunk = chunkAt(offset)); ++i) {
                Index length = chunk->length;
                if (chunk->name != "data") {
                    m_chunks.push_back(*chunk);
                } else if (m_data.offset == 0) {
                    setData(*chunk);
                    length = m_dataBytes;
                }
                offset = chunk->offset + length;
                if (length % 2 != 0 && chunkAt(offset + 1)) // some programs omit the padding
                    ++offset;
            }
            if (m_data.offset == 0 && !m_chunks.empty())
                findDataBehind(m_chunks.back().offset);
        }

        /// Of a chunk whose length leads past the head of the samples: these reach to the end of the file.
        void findDataBehind(Index offset)
        {
            constexpr Index largestHeadBytes = 1 << 16;
            for (Index at = offset; at < offset + largestHeadBytes && m_data.offset == 0; ++at)
                if (m_file.hasAt(at, "data"))
                    if (const auto chunk = riffChunkAt(m_file, at);
                        chunk && chunk->offset + chunk->length == m_file.size())
                        setData(*chunk);
        }

        void setData(const RiffChunk &chunk)
        {
            m_data = chunk;
            const RiffChunk *const lengths = m_isRf64 ? find("ds64") : nullptr;
            std::array<std::byte, 16> both; // of the file and of the samples
            if (lengths && chunk.length == fourGiB - 1 && m_file.readAt(lengths->offset, both) == both.size())
                m_data.length = Index(littleEndian(std::span(both).last(8)) & ~(std::uint64_t(1) << 63));
            const Index available = m_file.size() - chunk.offset;
            m_isTruncated = m_data.length > available;
            m_dataBytes = available;
            for (Index end = m_data.length; end <= available; end += fourGiB) {
                const BehindSamples behind = behindAt(chunk.offset + end, end % 2 != 0);
                const bool isEnd = behind == BehindSamples::Chunk || (behind != BehindSamples::Samples && end > 0);
                if (isEnd && behind == BehindSamples::Padding)
                    m_paddingBytes = available - end;
                if (isEnd) {
                    m_dataBytes = end;
                    return;
                }
                if (m_isRf64)
                    break;
            }
            if (m_isTruncated)
                return;
            const Index samplesEnd = chunksAtEnd(m_file, chunk.offset + m_data.length, chunk.offset, frameBytes());
            m_dataBytes = samplesEnd - chunk.offset;
        }

        /// Of the samples of all channels at one time.
        Index frameBytes() const
        {
            constexpr Index frameBytesAt = 12;
            std::array<std::byte, 2> bytes{};
            if (const RiffChunk *const format = find("fmt "))
                m_file.readAt(format->offset + frameBytesAt, bytes);
            return std::max<Index>(1, Index(littleEndian(bytes)));
        }

        BehindSamples behindAt(Index offset, bool isOdd) const
        {
            std::vector<std::byte> bytes(mostToTellByBytes);
            bytes.resize(m_file.readAt(offset, bytes));
            const bool isAll = offset + std::ssize(bytes) >= m_file.size();
            return behindSamples(bytes, isOdd, isAll);
        }

        const FileBytes &m_file;
        bool m_isRf64 = false;
        bool m_isTruncated = false;
        std::vector<RiffChunk> m_chunks; ///< but the samples
        RiffChunk m_data;                ///< with its declared length
        Index m_dataBytes = 0;
        Index m_paddingBytes = 0;
    };

} // namespace

/// Input of libsndfile: a shared file and its own offset. The header of a WAV file may be replaced by a repaired one.
/// While the library reads the file's own header, lists that would make it loop get an unknown name.
struct AudioDecoder::SharedInput {
    std::shared_ptr<const FileBytes> file;
    std::vector<std::byte> header; ///< shown in place of what precedes the samples; empty: the file's own
    Index dataOffset = 0;          ///< of the samples in the file, if there is a header
    Index dataBytes = 0;
    std::vector<std::string> notes;
    bool isRiff = false; ///< of which the repaired header may be RF64
    Index offset = 0;
    bool isOpening = true;

    static SharedInput &of(void *user) { return *static_cast<SharedInput *>(user); }

    Index size() const { return header.empty() ? file->size() : std::ssize(header) + dataBytes; }

    static sf_count_t length(void *user) { return of(user).size(); }
    static sf_count_t tell(void *user) { return of(user).offset; }
    static sf_count_t write(const void *, sf_count_t, void *) { return 0; }

    static sf_count_t seek(sf_count_t offset, int whence, void *user)
    {
        SharedInput &source = of(user);
        const Index base = whence == SEEK_CUR ? source.offset : whence == SEEK_END ? source.size() : 0;
        constexpr Index offsetLimitBytes = Index(1)
                                           << 60; // beyond the end of any file; a chunk's length may point there
        source.offset = std::clamp<Index>(base + std::clamp<Index>(offset, -offsetLimitBytes, offsetLimitBytes), 0,
                                          offsetLimitBytes);
        return source.offset;
    }

    static sf_count_t read(void *out, sf_count_t count, void *user)
    {
        SharedInput &source = of(user);
        const std::span<std::byte> bytes(static_cast<std::byte *>(out), std::size_t(std::max<sf_count_t>(0, count)));
        Index got = 0;
        try {
            got = source.readShown(bytes);
        } catch (const Error &) {
            return 0; // an exception must not pass through C; the short read is noticed later
        }
        source.offset += got;
        if (source.isOpening && source.header.empty() && got > 0 && source.isBehindBadList())
            bytes[std::size_t(got - 1)] = std::byte('x');
        return got;
    }

    Index readShown(std::span<std::byte> bytes) const
    {
        if (header.empty())
            return Index(file->readAt(offset, bytes));
        Index done = 0;
        if (offset < std::ssize(header)) {
            done = std::min(std::ssize(bytes), std::ssize(header) - offset);
            std::copy_n(header.begin() + offset, done, bytes.begin());
        }
        const Index inData = offset + done - std::ssize(header);
        const Index rest = std::clamp<Index>(dataBytes - inData, 0, std::ssize(bytes) - done);
        if (rest > 0)
            done += Index(file->readAt(dataOffset + inData, bytes.subspan(std::size_t(done), std::size_t(rest))));
        return done;
    }

    bool isBehindBadList() const
    {
        std::array<std::byte, 4> name;
        const Index chunk = offset - std::ssize(name);
        if (chunk < 0 || file->readAt(chunk, name) < name.size())
            return false;
        const std::string_view text = asText(name);
        return (text == "LIST" || text == "INFO") && leadsBackwards(*file, chunk);
    }
};

AudioDecoder::AudioDecoder(std::unique_ptr<SharedInput> source, SNDFILE *handle, const SF_INFO &format)
    : m_source(std::move(source)), m_handle(handle), m_format(format)
{
}

AudioDecoder::~AudioDecoder()
{
    sf_close(m_handle);
}

std::unique_ptr<AudioDecoder> AudioDecoder::openAs(std::unique_ptr<SharedInput> source, std::string &why)
{
    SF_VIRTUAL_IO access = {SharedInput::length, SharedInput::seek, SharedInput::read, SharedInput::write,
                            SharedInput::tell};
    SF_INFO format = {};
    SNDFILE *handle = sf_open_virtual(&access, SFM_READ, &format, source.get());
    if (!handle) {
        why = sf_strerror(nullptr);
        return nullptr;
    }
    source->isOpening = false;
    if (source->isRiff && (format.format & SF_FORMAT_TYPEMASK) == SF_FORMAT_RF64)
        format.format = SF_FORMAT_WAV | (format.format & SF_FORMAT_SUBMASK);
    return std::unique_ptr<AudioDecoder>(new AudioDecoder(std::move(source), handle, format));
}

std::unique_ptr<AudioDecoder> AudioDecoder::open(std::shared_ptr<const FileBytes> file, std::string &why)
{
    static constexpr std::array<std::string_view, 8> useful{"fmt ", "bext", "auxi", "harp",
                                                            "LIST", "INFO", "guan", "fact"};
    const WavChunks chunks(*file);
    const auto openWith = [&](std::size_t names,
                              std::string &message) { // names: how many of the useful; 0: the file's own
        auto source = std::make_unique<SharedInput>();
        source->file = file;
        source->notes = chunks.notes();
        if (names > 0) {
            source->header = chunks.headerWith(std::span(useful).first(names));
            source->dataOffset = chunks.dataOffset();
            source->dataBytes = chunks.dataBytes();
            source->isRiff = chunks.isRiff();
        }
        return openAs(std::move(source), message);
    };
    if (auto decoder = openWith(chunks.isLonger() ? useful.size() : 0, why); decoder || !chunks.isComplete())
        return decoder;
    for (const std::size_t names : {useful.size(), useful.size() - 1, std::size_t(1)}) {
        std::string ignored;
        if (auto decoder = openWith(names, ignored)) {
            const std::string others = chunks.others(std::span(useful).first(names));
            decoder->m_source->notes.push_back(
                "A chunk of the header is damaged; chunks that are not needed are ignored (" + others + ").");
            return decoder;
        }
    }
    return nullptr;
}

const std::vector<std::string> &AudioDecoder::notes() const
{
    return m_source->notes;
}

std::optional<WavPlace> placeInWav(const FileBytes &file)
{
    const WavChunks chunks(file);
    if (!chunks.isComplete())
        return std::nullopt;
    return WavPlace{chunks.dataOffset(), file.size() - chunks.dataOffset() - chunks.dataBytes()};
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
    constexpr unsigned chunkLimitBytes = 1 << 20;
    if (!iterator || sf_get_chunk_size(iterator, &info) != SF_ERR_NO_ERROR || info.datalen > chunkLimitBytes)
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
