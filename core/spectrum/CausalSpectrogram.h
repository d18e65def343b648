#pragma once

#include "base/Checkpoints.h"
#include "spectrum/CausalBackground.h"
#include "spectrum/NoiseBackground.h"
#include "spectrum/NormalisedFrames.h"
#include "spectrum/Spectrogram.h"

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace faintline {

/// A spectrogram over its noise background, each frame over one from that frame and those before it (CausalBackground):
/// y(t, f) = |S(t, f)|²/B(t, f), mean 1 on noise; 0 in digital silence, NaN (not observed) in a frame whose window
/// reaches into a gap (Recording::isWhole).
///
/// The first frame needs the first block, `noise.blockWindows` windows, and a frame after that block needs nothing
/// behind it: the delay is (blockWindows - 1)·T_FT at the beginning and 0 from then on. Values are a function of the
/// recording, the settings and the index, so a file gives the bytes that a live run gave. Read in order it costs one
/// more transform a frame; to read elsewhere, the background is carried on from a state that was kept (64 MiB of them).
/// Reads take turns, whatever their threads.
class CausalSpectrogram final : public NormalisedFrames
{
public:
    /// Windows of a block are at most 512, and at least 2.
    CausalSpectrogram(std::shared_ptr<const Spectrogram> spectrogram, const NormaliserSettings &settings);

    void read(Index first, Index count, std::span<float> out) const override;

    const Spectrogram *spectrogram() const override { return m_spectrogram.get(); }

    /// Samples of the recording that the first frame needs to be there, all of them from the selection's first on.
    static Index samplesOfFirstBlock(const Spectrogram &spectrogram, const NormaliserSettings &settings);

    /// Of samples that pass by, whose background is carried on once, states are kept from now on, for `over`.
    void keepStates() const;
    /// The same frames of a recording with the same samples, from the states that were kept of these. Reads nothing.
    std::shared_ptr<const CausalSpectrogram> over(std::shared_ptr<const Spectrogram> spectrogram) const;

    /// The first block's background, at any time.
    std::shared_ptr<const NoiseBackground> firstBackground() const { return m_firstBackground; }

private:
    CausalSpectrogram(std::shared_ptr<const Spectrogram> spectrogram, const CausalSpectrogram &like);

    CausalBackground begin() const;
    void goTo(Index frame) const;
    const NoiseBackground &step() const;

    std::shared_ptr<const Spectrogram> m_spectrogram;
    NormaliserSettings m_settings;
    Spectrogram m_coarse; ///< the same frames, one bin a cell, and the band's neighbourhood
    CausalGeometry m_geometry;
    std::shared_ptr<const NoiseBackground> m_firstBackground;

    mutable std::mutex m_mutex;
    mutable std::optional<CausalBackground> m_background;
    mutable Index m_next = 0; ///< frame that m_background takes next
    mutable Checkpoints<CausalBackground> m_kept;
    mutable bool m_keepsStates;
    mutable std::vector<float> m_power;
};

} // namespace faintline
