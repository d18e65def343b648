#pragma once

#include "base/Axis.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// What is known of a recording without reading its samples.
struct RecordingInfo {
    std::string path;
    std::string container;  ///< "WAV", "FLAC", "SigMF", "raw", "simulated" …
    std::string sampleType; ///< "int16", "float32", "ci16_le" …
    double sampleRateHz = 0.0;
    Index sampleCount = 0;                  ///< samples per channel; one I/Q pair is one sample
    int channelCount = 0;                   ///< an I/Q recording's two streams are one channel
    bool isComplex = false;                 ///< I/Q: negative frequencies are different from positive ones
    double centreHz = 0.0;                  ///< frequency that 0 Hz of the samples stands for
    std::optional<double> startUnixSeconds; ///< UTC of the first sample
    std::vector<std::string> notes;         ///< what was repaired or assumed while opening, one sentence each

    double durationSeconds() const { return double(sampleCount) / sampleRateHz; }
    Index floatsPerSample() const { return isComplex ? 2 : 1; }
};

/// Random access by sample to a recording that may be larger than memory.
///
/// A sample is one float, or two (I, Q) where isComplex. Integer formats are scaled to ±1 at full scale. Samples that
/// are not finite read as 0 and are counted. `read` may be called from several threads at once, and its values do not
/// depend on how a stretch is cut into requests.
class Recording
{
public:
    virtual ~Recording() = default;

    const RecordingInfo &info() const { return m_info; }

    /// Fills `out` (count samples of one channel, count·2 floats where isComplex) from sample `first` on. Samples
    /// before the start or beyond the end read as 0. Precondition: 0 ≤ channel < channelCount. Throws Error where the
    /// file fails under it.
    virtual void read(int channel, Index first, Index count, std::span<float> out) const = 0;

    /// Order of magnitude of a channel's samples: they lie around 2^e, e a multiple of 60, so 0 for all within 2^±30.
    /// Whoever squares samples takes it off before: single precision holds the square of no strain of 1e-22. A power of
    /// two, so it costs no bit. 0 for a recording that does not measure it (measuredScaleExponent) because its scale is
    /// known to be about 1.
    virtual int scaleExponent(int /*channel*/) const { return 0; }

    /// Whether all of these samples were heard: false where any of them lies in a gap, which reads as 0. A recording
    /// that knows of no gaps has none.
    virtual bool isWhole(Index /*first*/, Index /*count*/) const { return true; }

    /// Floats that were not finite in all reads so far (one that was read twice counts twice): 0 for a sound recording.
    Index nonFiniteCount() const { return m_nonFiniteCount.load(std::memory_order_relaxed); }

protected:
    /// What every `read` does besides fetching: 0 outside the recording, `fetch(first, out)` for the part inside, then
    /// 0 for values that are not finite.
    void fill(Index first, Index count, std::span<float> out,
              const std::function<void(Index first, std::span<float> out)> &fetch) const;

    /// What scaleExponent answers, from the median magnitude of short stretches all over the channel, silent ones left
    /// out.
    int measuredScaleExponent(int channel) const;
    /// The same of a known magnitude.
    static int scaleExponentOf(double magnitude);

    RecordingInfo m_info;

private:
    double meanMagnitude(int channel, Index first, std::span<float> samples) const;

    mutable std::atomic<Index> m_nonFiniteCount = 0;
};

using RecordingPointer = std::shared_ptr<const Recording>;

} // namespace faintline
