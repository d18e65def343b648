#pragma once

#include "base/RunContext.h"
#include "frames/NormalisedFrames.h"
#include "noise/pings/PingNoise.h"
#include "signal/RawPings.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// Recorded pings as power, in a unit that makes the median of the first pings 1.
///
///   power p = x,  magnitude p = x²,  decibels p = 10^(x/10),  complex p = I² + Q²
///
/// Integers get a uniform random number within ± half their step added first, a function of ping and cell, so that
/// faint noise has a continuous law. Negative power counts as 0; numbers that are not finite become NaN, not observed.
/// Thread-safe; pure functions of (file, kind of values, ping).
class PingPower
{
public:
    /// `values`: Power, Magnitude or Decibels; it does not matter if the pings are complex. Throws Error as
    /// RawPings::read does.
    PingPower(std::shared_ptr<const RawPings> pings, PingValues values);

    /// Writes pings first … first+count-1, one value per cell.
    void read(Index first, Index count, std::span<float> out) const;

    const RawPings &pings() const { return *m_pings; }
    const Axis &time() const { return m_pings->info().time; }
    const Grid &grid() const { return m_pings->info().grid; }

private:
    double powerOf(double value) const;
    std::vector<double> powers(Index first, Index count) const;

    std::shared_ptr<const RawPings> m_pings;
    PingValues m_values;
    double m_unit = 1.0;
};

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
