#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace faintline {

/// Parameters of the bitshuffle filter of an HDF5 chunk.
struct BitshuffleLayout {
    std::size_t elementBytes = 1;
    std::size_t blockElements = 0; ///< 0: as many as fill 8 KiB, rounded to a multiple of 8
    bool isLz4 = false;
};

/// Undoes bitshuffle of a chunk, giving at most `mostBytes`; returns an empty vector if it is damaged.
///
/// Blocks of n elements are transposed bit matrices, all lowest bits first; the last block may be shorter, and up to 7
/// elements after it are stored as they are. With LZ4: the size (64 bits) and the blocks' size in bytes (32), then each
/// block after its compressed size (32), big-endian. Source: Masui and others 2015, Astronomy and Computing 12, 181.
/// Oracle: the bitshuffle plug-in.
std::vector<std::byte> undoBitshuffle(std::span<const std::byte> chunk, const BitshuffleLayout &layout,
                                      std::size_t mostBytes);

} // namespace faintline
