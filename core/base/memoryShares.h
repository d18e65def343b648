#pragma once

#include <cstddef>

namespace faintline {

/// Memory budget of one open recording, independent of its length, and how its parts share it.
///
/// Each part that grows with the data keeps to its share by itself: pictures merge rows, checkpoints are spaced farther
/// apart, frames are read again. A longer recording, or more places inspected, costs time instead.
///
///   documentBytes = Σ shares (checked below)
///
/// A window itself takes some 100 MiB. A sonar ping has as many states as a minute of a recording, but there are few:
/// caches of states keep a few pings even if that exceeds their share (`orSome`).
namespace memoryShares {

    inline constexpr std::size_t mebibyte = std::size_t(1) << 20;
    inline constexpr std::size_t documentBytes = 528 * mebibyte;

    /// For the input, and as much for the statistic and for the input as plain dB; 1.33 per cell.
    inline constexpr std::size_t picture = 64 * mebibyte;
    /// Noise; twice this while it is estimated, before the pictures exist.
    inline constexpr std::size_t background = 64 * mebibyte;
    inline constexpr std::size_t checkpoints = 32 * mebibyte; ///< of the chain, for replaying part of a run
    /// Frames through which a path is traced back; the same again for checkpoints.
    inline constexpr std::size_t pathRecord = 32 * mebibyte;
    /// Visible part of the input, of the statistic, and of its preview.
    inline constexpr std::size_t closeup = 24 * mebibyte;
    inline constexpr std::size_t channels = 32 * mebibyte;      ///< pictures of channels beside each other, together
    inline constexpr std::size_t previewFrames = 24 * mebibyte; ///< kept while a detector is tuned
    inline constexpr std::size_t stateReplay = 24 * mebibyte;   ///< all states of the inspected frames
    inline constexpr std::size_t layerReplay = 24 * mebibyte;   ///< ages and predecessors of all paths

    static_assert(3 * picture + background + checkpoints + 2 * pathRecord + 3 * closeup + channels + previewFrames
                      + stateReplay + layerReplay
                  == documentBytes);

    constexpr std::size_t orSome(std::size_t share, std::size_t bytesOfSome)
    {
        return share > bytesOfSome ? share : bytesOfSome;
    }

    /// Final size of a picture within a share when it holds all of its frames. With that size as its share the picture
    /// is the same, and it was never larger.
    constexpr std::size_t inTheEnd(std::size_t share, std::size_t frames, std::size_t cells)
    {
        constexpr std::size_t branching = 4; ///< frames per row, and rows per row of the next level
        for (std::size_t merged = 1; merged <= frames; merged *= branching) {
            std::size_t bytes = 0;
            for (std::size_t rows = frames / merged; rows > 0; rows /= branching)
                bytes += rows * cells;
            if (bytes <= share)
                return bytes;
        }
        return share;
    }

} // namespace memoryShares

} // namespace faintline
