#pragma once

#include <cstddef>

namespace faintline {

/// What one open recording may take of memory, however long it is, and how its parts share it: the only budget there
/// is.
///
/// Every part that grows with what is looked at keeps to its share by itself: pictures merge rows, checkpoints lie
/// farther apart, frames are read again. What a longer recording, or more places looked at, cost is time.
///
///   documentBytes = Σ shares (checked below)
///
/// A window takes some 100 MiB for itself. A sonar's ping, of which there are few, has as many states as a minute of a
/// recording has: what keeps states keeps some pings' where that is more than its share (`orSome`).
namespace memoryShares {

    inline constexpr std::size_t mebibyte = std::size_t(1) << 20;
    inline constexpr std::size_t documentBytes = 432 * mebibyte;

    inline constexpr std::size_t picture = 64 * mebibyte; ///< of the input, and as much of the statistic; 1.33 a cell
    /// Of the noise; twice while it is estimated, before the pictures are there.
    inline constexpr std::size_t background = 64 * mebibyte;
    inline constexpr std::size_t checkpoints = 32 * mebibyte; ///< of the chain, kept of a run to replay a part of it
    /// Of frames a path is traced back through, and as much of checkpoints.
    inline constexpr std::size_t pathRecord = 32 * mebibyte;
    /// Of what is visible: of the input, of the statistic, of its preview.
    inline constexpr std::size_t closeup = 24 * mebibyte;
    inline constexpr std::size_t previewFrames = 24 * mebibyte; ///< kept while a detector is being tuned
    inline constexpr std::size_t stateReplay = 24 * mebibyte;   ///< all states of the frames that were looked at
    inline constexpr std::size_t layerReplay = 24 * mebibyte;   ///< ages of all paths and where they come from

    static_assert(2 * picture + background + checkpoints + 2 * pathRecord + 3 * closeup + previewFrames + stateReplay
                      + layerReplay
                  == documentBytes);

    constexpr std::size_t orSome(std::size_t share, std::size_t bytesOfSome)
    {
        return share > bytesOfSome ? share : bytesOfSome;
    }

    /// What a picture within a share has grown to when all of its frames are in it. Given that much it is the same
    /// picture, and was never larger.
    constexpr std::size_t inTheEnd(std::size_t share, std::size_t frames, std::size_t cells)
    {
        constexpr std::size_t branching = 4; ///< frames to a row, rows to a row of the next level
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
