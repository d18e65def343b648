#pragma once

#include "signal/Recording.h"
#include "signal/Stretches.h"
#include "signal/formats/AudioDecoder.h"

#include <memory>
#include <mutex>

namespace faintline {

/// Any file that libsndfile reads: WAV, RF64, W64, AIFF, FLAC, CAF, OGG, MP3, AU and more, with any number of channels.
///
/// With `iq`, channels 2k and 2k+1 are I and Q of complex channel k. Start time and centre frequency are taken from a
/// broadcast chunk (bext), from the chunk that receivers write (auxi) or from that of XWAV (harp), if present. A
/// truncated file gives the existing part, with a note. Samples that harp marks as missing keep their place in time and
/// read as 0; isWhole reports them.
///
/// Uncompressed data is read on demand. Compressed data is decoded in fixed blocks that are kept while in use. Each
/// block of a lossy codec (OGG, MP3) is decoded by a fresh decoder after the run-up that it needs to settle
/// (libsndfile's Vorbis seek gives a wrong first block), so that a sample's value never depends on earlier reads. A
/// codec that cannot seek is decoded from the beginning. Thread-safe: each thread uses its own handle.
class AudioRecording final : public Recording
{
public:
    /// Throws Error if the file cannot be opened or is not a recording, listing what would be accepted.
    AudioRecording(const std::string &path, bool iq);
    ~AudioRecording() override;

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override { return m_info.places.isWhole(first, count); }
    bool isFinite(int channel, Index first, Index count) const override
    {
        return !m_isFloat || isFiniteByReading(channel, first, count);
    }
    int scaleExponent(int channel) const override { return m_isFloat ? measuredScaleExponent(channel) : 0; }

    /// Whether libsndfile recognises the file's format, even if the file is damaged.
    static bool recognises(const std::string &path);

private:
    struct Handle {
        std::unique_ptr<AudioDecoder> decoder;
        std::vector<float> samples; ///< last decoded block, or scratch; all channels interleaved
        Index block = -1;
    };
    enum class Access { Direct, Blocks, Forward };

    std::unique_ptr<AudioDecoder> openDecoder() const;
    std::unique_ptr<Handle> borrow(Index block, Index position) const;
    void giveBack(std::unique_ptr<Handle> handle) const;
    void readDirectly(Index offset, Index first, std::span<float> out) const;
    void readBlocks(Index offset, Index first, std::span<float> out) const;
    void decodeBlock(Handle &handle, Index block) const;
    bool isReadable(std::unique_ptr<AudioDecoder> &decoder, Index sample) const;
    Index readableCount(std::unique_ptr<AudioDecoder> &decoder) const;
    void copyChannel(std::span<const float> frames, Index offset, std::span<float> out) const;
    [[noreturn]] void failAt(Index sample) const;

    void readStored(int channel, Index first, std::span<float> out) const;

    std::shared_ptr<const FileBytes> m_file;
    Index m_stored = 0;       ///< samples in the file
    Index m_streams = 1;      ///< channels of the file
    bool m_isIqBytes = false; ///< unsigned bytes of I and Q
    bool m_isFloat = false;   ///< uncompressed floats, whose full scale need not be 1
    Access m_access = Access::Direct;
    Index m_runUp = 0;
    Index m_blockSamples = 0;
    mutable std::mutex m_mutex;
    mutable std::vector<std::unique_ptr<Handle>> m_idle; ///< guarded by m_mutex
};

/// Formats that openRecording accepts, for messages.
inline constexpr const char *acceptedFormats =
    "accepted are WAV, RF64, W64, AIFF, FLAC, CAF, OGG, MP3, AU and other audio files, SigMF pairs (.sigmf-meta, "
    ".sigmf-data), strain and filterbanks in HDF5, sigproc filterbanks, and raw samples when their type and rate are "
    "given (such as --raw-type ci16_le --raw-rate 48000)";

} // namespace faintline
