#include "signal/formats/riffChunks.h"

#include "signal/formats/bytes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>
#include <vector>

namespace faintline {

namespace {

    constexpr Index wordBytes = 4;
    constexpr Index listLimitBytes = Index(16) << 20; ///< bytes to examine

    /// Whether the library stops at a name: one that is not part of the list, or invalid.
    bool isEnd(std::string_view name)
    {
        return name == "data" || name == std::string_view("\0\0\0\0", wordBytes);
    }

    bool hasKnownName(std::string_view name)
    {
        constexpr std::array<std::string_view, 20> known{"LIST", "INFO", "bext", "iXML", "axml", "id3 ", "ID3 ",
                                                         "cue ", "smpl", "inst", "JUNK", "junk", "PAD ", "FLLR",
                                                         "fact", "PEAK", "_PMX", "guan", "wamd", "auxi"};
        return std::find(known.begin(), known.end(), name) != known.end();
    }

    std::string_view nameAt(std::span<const std::byte> bytes)
    {
        return asText(bytes).substr(0, wordBytes);
    }

} // namespace

std::optional<RiffChunk> riffChunkAt(const FileBytes &file, Index offset)
{
    std::array<std::byte, chunkHeadBytes> head;
    if (file.readAt(offset, head) < head.size())
        return std::nullopt;
    return RiffChunk{std::string(nameAt(head)), offset + chunkHeadBytes,
                     Index(littleEndian(std::span(head).last(wordBytes)))};
}

bool isWave(const FileBytes &file, std::string_view kind)
{
    return file.hasAt(0, kind) && file.hasAt(riffHeadBytes - wordBytes, "WAVE");
}

bool isChunkHead(std::span<const std::byte> bytes)
{
    if (std::ssize(bytes) < chunkHeadBytes)
        return false;
    const std::string_view name = nameAt(bytes);
    const bool isPrintable = std::all_of(name.begin(), name.end(), [](char c) { return c >= ' ' && c <= '~'; });
    return isPrintable
           && (hasKnownName(name)
               || littleEndian(bytes.subspan(wordBytes, wordBytes)) <= std::uint64_t(listLimitBytes));
}

BehindSamples behindSamples(std::span<const std::byte> bytes, bool isOdd, bool isAll)
{
    constexpr std::size_t tagBytes = 128;
    const std::size_t padding = isOdd ? 1 : 0;
    if (isChunkHead(bytes) || (isOdd && !bytes.empty() && isChunkHead(bytes.subspan(1))))
        return BehindSamples::Chunk;
    if (std::ssize(bytes) < chunkHeadBytes + Index(padding))
        return isAll ? BehindSamples::Nothing : BehindSamples::Unknown;
    if (const auto tag = bytes.subspan(padding); nameAt(tag).starts_with("TAG") && tag.size() <= tagBytes) {
        if (!isAll)
            return BehindSamples::Unknown;
        return tag.size() == tagBytes ? BehindSamples::Chunk : BehindSamples::Samples;
    }
    if (bytes.size() < mostToTellByBytes
        && std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte(0); }))
        return isAll ? BehindSamples::Padding : BehindSamples::Unknown;
    return BehindSamples::Samples;
}

Index chunksAtEnd(const FileBytes &file, Index declaredEnd, Index begin, Index frameBytes)
{
    constexpr Index mostBytes = 1 << 20;
    const Index from = std::max(declaredEnd, file.size() - mostBytes);
    std::vector<std::byte> bytes(std::size_t(std::max<Index>(0, file.size() - from)));
    bytes.resize(file.readAt(from, bytes));
    std::set<Index> starts{std::ssize(bytes)}; // of chunks from which the end is reached, and the end
    Index samplesEnd = file.size();
    for (Index at = std::ssize(bytes) - chunkHeadBytes; at >= 0; --at) {
        const auto head = std::span(bytes).subspan(std::size_t(at), std::size_t(chunkHeadBytes));
        const std::string_view name = nameAt(head);
        if (!std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == ' '; }))
            continue;
        const auto length = Index(littleEndian(head.last(wordBytes)));
        const Index end = at + chunkHeadBytes + length;
        if (!starts.contains(end) && !starts.contains(end + length % 2))
            continue;
        starts.insert(at);
        const Index samples = from + at - begin;
        const Index padding = samples % frameBytes;
        if (padding == 0 || (padding == 1 && samples % 2 == 0))
            samplesEnd = from + at - padding;
    }
    return samplesEnd;
}

bool leadsBackwards(const FileBytes &file, Index chunk)
{
    std::array<std::byte, wordBytes> kind;
    std::array<std::byte, 2 * wordBytes> head;
    if (file.readAt(0, kind) < kind.size() || file.readAt(chunk, head) < head.size())
        return false;
    const auto value = asText(kind) == "RIFX" ? bigEndian : littleEndian;
    const Index length =
        std::min(Index(value(std::span(head).last(wordBytes))), file.size() - chunk - std::ssize(head));
    std::vector<std::byte> bytes(std::size_t(std::clamp<Index>(length, 0, listLimitBytes)));
    bytes.resize(file.readAt(chunk + std::ssize(head), bytes));

    Index at = 0;
    while (at + 2 * wordBytes <= std::ssize(bytes)) {
        const auto word = [&](Index place) { return std::span(bytes).subspan(std::size_t(place)).first(wordBytes); };
        const std::string_view name = asText(word(at));
        at += wordBytes;
        if (name == "INFO" || name == "adtl")
            continue;
        if (name == "exif")
            return true;
        if (isEnd(name))
            return false;
        const auto size = Index(value(word(at)));
        at += wordBytes;
        if (at + size + size % 2 > 0xffffffff)
            return true;
        at += size + size % 2;
    }
    return at < length && length > listLimitBytes; // longer lists are not examined
}

} // namespace faintline
