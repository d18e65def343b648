#pragma once

#include "base/RunContext.h"
#include "frames/NormalisedFrames.h"
#include "noise/pings/PingNoise.h"
#include "noise/pings/PingPower.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// Mean noise power of each cell of recorded pings, block by block (pingBlockNoise).
///
/// The pings are divided into blocks of at least `blockPings`; the background of a ping is interpolated between the
/// centres of blocks, in the logarithm, and constant beyond the outer ones. From past pings alone (`pastOnly`), it is
/// that of the previous block, and in the first block its own.
class PingBackground
{
public:
    /// Reads at most 2²⁴ values, but at least 16 pings, of each block. Memory: 64 MiB, and that of the values. Throws
    /// Error if most cells hold no power, or if there are more than 2²⁰ cells; Cancelled.
    PingBackground(const PingPower &power, const PingNoiseSettings &settings, const RunContext &context = {});

    /// ln mean noise power of all cells of a ping; below `noPingNoise`/2 where there is no noise.
    void readLn(Index ping, std::span<float> ln) const;

    Index blockCount() const { return m_blocks; }

private:
    std::span<const float> block(Index index) const;

    Index m_cells;
    Index m_blocks = 1;
    double m_blockPings = 1.0;
    bool m_pastOnly;
    std::vector<float> m_ln; ///< blocks × cells
};

/// Recorded pings over their noise: y, exponential of mean 1 on noise, NaN where there is none.
///
/// The power of a ping (PingPower) is divided by its background (PingBackground), and with `followPing` by its own
/// level if that clearly differs from 1. Construction reads the file once. Thread-safe; a ping is a pure function of
/// (file, settings, index).
class NormalisedPings final : public NormalisedFrames
{
public:
    /// `values`: what the numbers are, Power, Magnitude or Decibels; `isGuessed`: nobody said so. Throws Error as
    /// PingBackground does, and Cancelled.
    NormalisedPings(std::shared_ptr<const RawPings> pings, PingValues values, bool isGuessed,
                    const PingNoiseSettings &settings, const RunContext &context = {});

    void read(Index first, Index count, std::span<float> out) const override;

    /// What was assumed, in one sentence: "int16, taken as magnitude: …".
    std::string assumption() const override;
    bool isGuessed() const override { return m_isGuessed; }

private:
    PingPower m_power;
    PingValues m_values;
    bool m_isGuessed;
    bool m_followsPing;
    PingBackground m_background;
};

/// What was assumed of frames that are recorded pings; empty for all others.
std::string pingAssumption(const NormalisedFrames &frames);

/// The same if it was guessed; otherwise empty.
std::string pingGuess(const NormalisedFrames &frames);

} // namespace faintline
