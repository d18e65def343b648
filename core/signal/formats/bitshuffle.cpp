#include "signal/formats/bitshuffle.h"

#include "signal/formats/bytes.h"

#include <lz4.h>

#include <algorithm>
#include <cstdint>

namespace faintline {

namespace {

    constexpr std::size_t multiple = 8;       ///< block sizes are multiples of it, elements
    constexpr std::size_t targetBytes = 8192; ///< size of a block if not specified
    constexpr std::size_t fewestElements = 128;

    /// 8 × 8 bits, transposed (Warren, Hacker's Delight, 7-3).
    std::uint64_t transposed(std::uint64_t x)
    {
        std::uint64_t t = (x ^ (x >> 7)) & 0x00AA00AA00AA00AAu;
        x ^= t ^ (t << 7);
        t = (x ^ (x >> 14)) & 0x0000CCCC0000CCCCu;
        x ^= t ^ (t << 14);
        t = (x ^ (x >> 28)) & 0x00000000F0F0F0F0u;
        return x ^ t ^ (t << 28);
    }

    /// One block: bit k of byte b of all elements lies in row 8b + k.
    void transposeBack(std::span<const std::byte> block, std::size_t elementBytes, std::byte *out)
    {
        const std::size_t elements = block.size() / elementBytes;
        const std::size_t row = elements / 8;
        for (std::size_t byte = 0; byte < elementBytes; ++byte)
            for (std::size_t group = 0; group < row; ++group) {
                std::uint64_t bits = 0;
                for (std::size_t k = 0; k < 8; ++k)
                    bits |= std::to_integer<std::uint64_t>(block[(8 * byte + k) * row + group]) << (8 * k);
                bits = transposed(bits);
                for (std::size_t i = 0; i < 8; ++i)
                    out[(8 * group + i) * elementBytes + byte] = static_cast<std::byte>(bits >> (8 * i));
            }
    }

    /// Reads a chunk's bytes sequentially; returns false beyond its end.
    class Source
    {
    public:
        explicit Source(std::span<const std::byte> bytes) : m_bytes(bytes) {}

        bool take(std::size_t count, std::span<const std::byte> &taken)
        {
            if (m_bytes.size() < count)
                return false;
            taken = m_bytes.first(count);
            m_bytes = m_bytes.subspan(count);
            return true;
        }

        bool number(std::size_t bytes, std::uint64_t &value)
        {
            std::span<const std::byte> taken;
            if (!take(bytes, taken))
                return false;
            value = bigEndian(taken);
            return true;
        }

    private:
        std::span<const std::byte> m_bytes;
    };

    bool readBlock(Source &source, bool isLz4, std::span<std::byte> block)
    {
        std::span<const std::byte> taken;
        if (!isLz4) {
            if (!source.take(block.size(), taken))
                return false;
            std::copy(taken.begin(), taken.end(), block.begin());
            return true;
        }
        std::uint64_t compressed = 0;
        if (!source.number(4, compressed) || compressed > LZ4_MAX_INPUT_SIZE || !source.take(compressed, taken))
            return false;
        const int got =
            LZ4_decompress_safe(reinterpret_cast<const char *>(taken.data()), reinterpret_cast<char *>(block.data()),
                                int(taken.size()), int(block.size()));
        return got == int(block.size());
    }

} // namespace

std::vector<std::byte> undoBitshuffle(std::span<const std::byte> chunk, const BitshuffleLayout &layout,
                                      std::size_t mostBytes)
{
    Source source(chunk);
    std::uint64_t size = chunk.size();
    std::uint64_t blockBytes = 0;
    if (layout.isLz4 && !(source.number(8, size) && source.number(4, blockBytes)))
        return {};
    const std::size_t elementBytes = layout.elementBytes;
    if (elementBytes == 0 || elementBytes > 256 || size > mostBytes || size % elementBytes != 0)
        return {};
    std::size_t blockElements = layout.isLz4 ? blockBytes / elementBytes : layout.blockElements;
    if (blockElements == 0)
        blockElements = std::max(fewestElements, targetBytes / elementBytes / multiple * multiple);
    if (blockElements % multiple != 0)
        return {};

    std::vector<std::byte> out(size);
    std::vector<std::byte> block;
    const std::size_t elements = size / elementBytes;
    std::size_t done = 0;
    while (elements - done >= multiple) {
        const std::size_t here = std::min(blockElements, (elements - done) / multiple * multiple);
        block.resize(here * elementBytes);
        if (!readBlock(source, layout.isLz4, block))
            return {};
        transposeBack(block, elementBytes, out.data() + done * elementBytes);
        done += here;
    }
    std::span<const std::byte> rest;
    if (!source.take((elements - done) * elementBytes, rest))
        return {};
    std::copy(rest.begin(), rest.end(), out.begin() + std::ptrdiff_t(done * elementBytes));
    return out;
}

} // namespace faintline
