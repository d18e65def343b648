#pragma once

#include "base/Checkpoints.h"
#include "frames/NormalisedFrames.h"
#include "frames/Spectrogram.h"
#include "noise/CausalBackground.h"
#include "noise/NoiseBackground.h"

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace faintline {

/// A spectrogram over its noise background, with each frame's background estimated from that frame and previous ones
/// (CausalBackground): y(t, f) = |S(t, f)|²/B(t, f), mean 1 on noise; 0 in digital silence, NaN (not observed) if the
/// frame's window reaches into a gap (Recording::isWhole).
///
/// The first frame needs the first block, `noise.blockWindows` windows; frames after that block need no later samples.
/// The delay is therefore (blockWindows - 1)·T_FT at the beginning and 0 afterwards. Values are a function of the
/// recording, the settings and the index, so a file gives the same bytes as a live run. Reading in order costs one
/// additional transform per frame; reading elsewhere continues from a stored state (64 MiB of them). Concurrent reads
/// are serialised.
class CausalSpectrogram final : public NormalisedFrames
{
public:
    /// Blocks have at most 512 and at least 2 windows.
    CausalSpectrogram(std::shared_ptr<const Spectrogram> spectrogram, const NormaliserSettings &settings);

    void read(Index first, Index count, std::span<float> out) const override;

    const Spectrogram *spectrogram() const override { return m_spectrogram.get(); }

    /// Number of samples that the first frame needs, counted from the first selected one.
    static Index samplesOfFirstBlock(const Spectrogram &spectrogram, const NormaliserSettings &settings);

    /// Stores states from now on, for `over`. For streams, whose background can be computed only once, in order.
    void keepStates() const;
    /// The same frames over a recording of the same samples, from the stored states. Reads nothing.
    std::shared_ptr<const CausalSpectrogram> over(RecordingPointer recording) const;

    /// Background of the first block, valid at any time.
    std::shared_ptr<const NoiseBackground> firstBackground() const { return m_firstBackground; }

private:
    CausalSpectrogram(std::shared_ptr<const Spectrogram> spectrogram, const CausalSpectrogram &like);

    CausalBackground begin() const;
    void goTo(Index frame) const;
    const NoiseBackground &step() const;

    std::shared_ptr<const Spectrogram> m_spectrogram;
    NormaliserSettings m_settings;
    Spectrogram m_coarse; ///< the same frames with one bin per cell, including the band's neighbourhood
    CausalGeometry m_geometry;
    std::shared_ptr<const NoiseBackground> m_firstBackground;

    mutable std::mutex m_mutex;
    mutable std::optional<CausalBackground> m_background;
    mutable Index m_next = 0; ///< next frame for m_background
    mutable Checkpoints<CausalBackground> m_kept;
    mutable bool m_keepsStates;
    mutable std::vector<float> m_power;
};

/// Normalises a spectrogram by its noise: NormalisedSpectrogram, or CausalSpectrogram with `noise.causal`.
NormalisedFramesPointer normalise(std::shared_ptr<const Spectrogram> spectrogram, const NormaliserSettings &settings,
                                  const RunContext &context = {});

} // namespace faintline
