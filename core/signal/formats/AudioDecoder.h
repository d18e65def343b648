#pragma once

#include "signal/FileBytes.h"
#include "signal/Recording.h"
#include "signal/Stretches.h"

#include <sndfile.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// An open libsndfile handle and its current position. Use it from one thread at a time.
///
/// A WAV file whose samples go on behind their declared length (recorder killed, stream, or longer than the 4 GiB that
/// its length can tell) is read to its end; a chunk that libsndfile rejects is left out. Notes say so.
class AudioDecoder
{
public:
    /// Returns null if libsndfile rejects the file; `why` then holds its message.
    static std::unique_ptr<AudioDecoder> open(std::shared_ptr<const FileBytes> file, std::string &why);

    ~AudioDecoder();
    AudioDecoder(const AudioDecoder &) = delete;
    AudioDecoder &operator=(const AudioDecoder &) = delete;

    const SF_INFO &format() const { return m_format; }

    /// Current position in samples per channel.
    Index position() const { return m_position; }

    /// Moves to a sample; returns false if libsndfile cannot.
    bool seek(Index sample);

    /// Reads up to `count` samples of all channels, interleaved; returns the number read.
    Index read(Index count, std::span<float> out);

    /// Repairs of the header, one sentence each.
    const std::vector<std::string> &notes() const;

    /// libsndfile's log of parsing the header.
    std::string log() const;

    /// The bytes of a chunk of the header ("auxi"); empty if absent.
    std::vector<std::byte> chunk(std::string_view id) const;

    std::optional<SF_BROADCAST_INFO> broadcastInfo() const;
    std::string text(int which) const; ///< SF_STR_DATE …; empty if absent

private:
    struct SharedInput;

    static std::unique_ptr<AudioDecoder> openAs(std::unique_ptr<SharedInput> source, std::string &why);
    AudioDecoder(std::unique_ptr<SharedInput> source, SNDFILE *handle, const SF_INFO &format);

    std::unique_ptr<SharedInput> m_source;
    SNDFILE *m_handle;
    SF_INFO m_format;
    Index m_position = 0;
};

/// Where the samples of a WAV file lie: how many bytes precede and follow them.
struct WavPlace {
    Index headerBytes = 0;
    Index trailingBytes = 0;
};

/// Nothing if the file is no WAV file.
std::optional<WavPlace> placeInWav(const FileBytes &file);

/// Container and sample type of a libsndfile format: "WAV", "int16".
std::string containerName(int format);
std::string sampleTypeName(int format);

/// Sets start time and centre frequency from the header: a recorder's comment or GUANO time stamp with its zone, bext
/// (origination date and time reference), auxi (a receiver's start time and centre frequency), harp (XWAV's start
/// times), or a date string that is an ISO 8601 time. A date that is later than the time in the file's name by the
/// recording's length was written at its end. Returns the places of the file's samples in time, which only harp gives.
Stretches readAudioMetadata(const AudioDecoder &decoder, RecordingInfo &info);

/// Number of bytes by which a header claims more than the file holds, according to libsndfile's log; 0 if it does not.
long long missingBytes(const std::string &log);

/// Whether an AIFF file's sample rate, an 80-bit floating-point number, lies in 1 Hz … 2³⁰ Hz. The library invents one
/// if it does not.
bool hasAiffRate(const FileBytes &file);

} // namespace faintline
