#include "recording/listChunk.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <vector>

namespace faintline {

namespace {

    constexpr Index wordBytes = 4;
    constexpr Index most = Index(16) << 20; ///< bytes to examine

    std::uint32_t number(std::span<const std::byte> bytes, bool isBigEndian)
    {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < wordBytes; ++i)
            value = value << 8 | std::to_integer<std::uint32_t>(bytes[isBigEndian ? i : wordBytes - 1 - i]);
        return value;
    }

    /// Whether the library stops at a name: one that is not part of the list, or invalid.
    bool isEnd(std::string_view name)
    {
        return name == "data" || name == std::string_view("\0\0\0\0", wordBytes);
    }

} // namespace

bool leadsBackwards(const FileBytes &file, Index chunk)
{
    std::array<std::byte, wordBytes> kind;
    std::array<std::byte, 2 * wordBytes> head;
    if (file.readAt(0, kind) < kind.size() || file.readAt(chunk, head) < head.size())
        return false;
    const bool isBigEndian = std::memcmp(kind.data(), "RIFX", kind.size()) == 0;
    const Index length =
        std::min<Index>(number(std::span(head).last(wordBytes), isBigEndian), file.size() - chunk - std::ssize(head));
    std::vector<std::byte> bytes(std::size_t(std::clamp<Index>(length, 0, most)));
    bytes.resize(file.readAt(chunk + std::ssize(head), bytes));

    Index at = 0;
    while (at + 2 * wordBytes <= std::ssize(bytes)) {
        const auto word = [&](Index place) { return std::span(bytes).subspan(std::size_t(place)).first(wordBytes); };
        const std::string_view name(reinterpret_cast<const char *>(word(at).data()), wordBytes);
        at += wordBytes;
        if (name == "INFO" || name == "adtl")
            continue;
        if (name == "exif")
            return true;
        if (isEnd(name))
            return false;
        const Index size = number(word(at), isBigEndian);
        at += wordBytes;
        if (at + size + size % 2 > 0xffffffff)
            return true;
        at += size + size % 2;
    }
    return at < length && length > most; // longer lists are not examined
}

} // namespace faintline
