#pragma once

#include "base/Axis.h"
#include "signal/Stretches.h"

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace faintline {

/// Properties of a recording that are known without reading its samples.
struct RecordingInfo {
    std::string path;
    std::string container;  ///< "WAV", "FLAC", "SigMF", "raw", "simulated" …
    std::string sampleType; ///< "int16", "float32", "ci16_le" …
    double sampleRateHz = 0.0;
    Index sampleCount = 0;                  ///< samples per channel; one I/Q pair is one sample
    int channelCount = 0;                   ///< an I/Q recording's two streams are one channel
    bool isComplex = false;                 ///< I/Q: negative frequencies are different from positive ones
    double centreHz = 0.0;                  ///< frequency that corresponds to 0 Hz of the samples
    std::optional<double> startUnixSeconds; ///< UTC of the first sample
    std::vector<std::string> notes;         ///< repairs and assumptions made on opening, one sentence each
    Stretches places{};                     ///< in time of the file's samples; empty if they are contiguous
    Index firstNumber = 0;                  ///< that SigMF gives the file's first sample (core:offset)
    std::string sigmf{};                    ///< "global" and "captures" of SigMF metadata, as JSON; else empty

    /// Of real samples, frequencies are what they are.
    bool isCentreKnown() const { return centreHz != 0.0 || !isComplex; }
    double durationSeconds() const { return double(sampleCount) / sampleRateHz; }
    Index floatsPerSample() const { return isComplex ? 2 : 1; }
};

/// Random access by sample to a recording that may be larger than memory.
///
/// A sample is one float, or two (I, Q) if isComplex. Integer formats are scaled to ±1 at full scale. Samples that are
/// not finite read as 0 and are counted. `read` may be called from several threads at once; its values do not depend on
/// how a stretch is divided into requests.
class Recording
{
public:
    virtual ~Recording() = default;

    const RecordingInfo &info() const { return m_info; }

    /// Fills `out` (count samples of one channel, count·2 floats if isComplex) from sample `first` on. Samples before
    /// the start or beyond the end read as 0. Precondition: 0 ≤ channel < channelCount. Throws Error if reading the
    /// file fails.
    virtual void read(int channel, Index first, Index count, std::span<float> out) const = 0;

    /// Order of magnitude of a channel's samples: they lie around 2^e, e a multiple of 60, so 0 for all within 2^±30.
    /// Remove it before squaring samples, because single precision cannot hold the square of a strain of 1e-22. As a
    /// power of two it costs no precision. 0 for recordings whose scale is known to be about 1, which do not measure it
    /// (measuredScaleExponent).
    virtual int scaleExponent(int /*channel*/) const { return 0; }

    /// Whether all of these samples were observed: false if any lies in a gap, which reads as 0. The default is for
    /// recordings without gaps.
    virtual bool isWhole(Index /*first*/, Index /*count*/) const { return true; }

    /// Whether all of a channel's samples in a stretch are finite; others read as 0. The default is for recordings whose
    /// samples are integers. Throws Error if reading the file fails.
    virtual bool isFinite(int /*channel*/, Index /*first*/, Index /*count*/) const { return true; }

    /// The number of samples of a stretch that are not finite, by reading it.
    Index nonFiniteCountIn(int channel, Index first, Index count) const
    {
        return std::ssize(nonFiniteIn(channel, first, count));
    }

    /// Whether a channel's samples were observed: no gap, and no sample that is not finite. Frames that reach into
    /// others are not observed.
    bool isObserved(int channel, Index first, Index count) const
    {
        return isWhole(first, count) && isFinite(channel, first, count);
    }

    /// Takes what the recording does not tell itself from its file's name: the start time (timeInName), and for I/Q the
    /// centre frequency (receiverName). Called once, by what opens the file.
    void completeByName();

    /// Number of floats that were not finite in all reads so far (read twice, counted twice).
    Index nonFiniteCount() const { return m_nonFiniteCount.load(std::memory_order_relaxed); }

protected:
    /// Common part of every `read`: writes 0 outside the recording, calls `fetch(first, out)` for the part inside, and
    /// replaces values that are not finite by 0.
    void fill(Index first, Index count, std::span<float> out,
              const std::function<void(Index first, std::span<float> out)> &fetch) const;

    /// The same for recordings with gaps: `fetch(stored, out)` reads samples of the file, of which m_info.places says
    /// where they are in time.
    void fillStored(Index first, Index count, std::span<float> out,
                    const std::function<void(Index stored, std::span<float> out)> &fetch) const;

    std::vector<Index> nonFiniteIn(int channel, Index first, Index count) const;
    /// Implementation of isFinite for samples that do not change: reads blocks, each once.
    bool isFiniteByReading(int channel, Index first, Index count) const;
    /// Implementation of scaleExponent: the median magnitude of short stretches distributed over the channel, without
    /// silent ones.
    int measuredScaleExponent(int channel) const;
    /// The scale exponent of a known magnitude.
    static int scaleExponentOf(double magnitude);

    RecordingInfo m_info;

private:
    double meanMagnitude(int channel, Index first, std::span<float> samples) const;

    mutable std::atomic<Index> m_nonFiniteCount = 0;
    mutable std::mutex m_finiteMutex;
    /// First and last of samples in a row that are not finite, of each block (channel, number) that was read; guarded by
    /// m_finiteMutex.
    mutable std::map<std::pair<int, Index>, std::vector<std::pair<Index, Index>>> m_nonFinite;
};

using RecordingPointer = std::shared_ptr<const Recording>;

/// A recording made from another one, sample by sample: as large, as whole and as finite as that.
class DerivedRecording : public Recording
{
public:
    int scaleExponent(int channel) const override { return m_base->scaleExponent(channel); }
    bool isWhole(Index first, Index count) const override { return m_base->isWhole(first, count); }
    bool isFinite(int channel, Index first, Index count) const override
    {
        return m_base->isFinite(channel, first, count);
    }

protected:
    /// With the info of `base`.
    explicit DerivedRecording(RecordingPointer base) : m_base(std::move(base)) { m_info = m_base->info(); }

    RecordingPointer m_base;
};

} // namespace faintline
