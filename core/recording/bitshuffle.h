#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace faintline {

/// How a chunk was bitshuffled: the parameters that its filter has in an HDF5 file.
struct BitshuffleLayout {
    std::size_t elementBytes = 1;
    std::size_t blockElements = 0; ///< 0: as many as fill 8 KiB, a multiple of 8
    bool isLz4 = false;
};

/// The bytes of a chunk before it was bitshuffled, at most `mostBytes`; empty where it is damaged.
///
/// Blocks of n elements are bit matrices that lie transposed, all lowest bits first; the last block may be shorter, and
/// up to 7 elements after it are as they were. With LZ4: the size (64 bits) and the blocks' size in bytes (32), then
/// each block behind its compressed size (32), big-endian. Source: Masui and others 2015, Astronomy and Computing 12,
/// 181. Oracle: the bitshuffle plug-in.
std::vector<std::byte> undoBitshuffle(std::span<const std::byte> chunk, const BitshuffleLayout &layout,
                                      std::size_t mostBytes);

} // namespace faintline
