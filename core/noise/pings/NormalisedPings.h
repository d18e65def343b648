#pragma once

#include "base/RunContext.h"
#include "frames/NormalisedFrames.h"
#include "noise/pings/PingBackground.h"
#include "noise/pings/PingPower.h"

#include <memory>
#include <string>

namespace faintline {

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
