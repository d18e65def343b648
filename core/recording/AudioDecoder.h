#pragma once

#include "recording/FileBytes.h"

#include <sndfile.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// One open libsndfile handle on a file, with the position it has come to. For one thread at a time.
///
/// A WAV file whose data chunk was never given its length (a recorder that was killed, a stream) is read to its end.
class AudioDecoder
{
public:
    /// Null where libsndfile does not take the file; `why` then says what it said.
    static std::unique_ptr<AudioDecoder> open(std::shared_ptr<const FileBytes> file, std::string &why);

    ~AudioDecoder();
    AudioDecoder(const AudioDecoder &) = delete;
    AudioDecoder &operator=(const AudioDecoder &) = delete;

    const SF_INFO &format() const { return m_format; }

    /// Samples per channel come to by reading and seeking.
    Index position() const { return m_position; }

    /// Moves to a sample; false where libsndfile cannot.
    bool seek(Index sample);

    /// Reads up to `count` samples of all channels, interleaved; returns how many there were.
    Index read(Index count, std::span<float> out);

    /// What libsndfile wrote down while parsing the header.
    std::string log() const;

    /// The bytes of a chunk of the header ("auxi"); empty if absent.
    std::vector<std::byte> chunk(std::string_view id) const;

    std::optional<SF_BROADCAST_INFO> broadcastInfo() const;
    std::string text(int which) const; ///< SF_STR_DATE …; empty if absent

private:
    struct Source;

    AudioDecoder(std::unique_ptr<Source> source, SNDFILE *handle, const SF_INFO &format);

    std::unique_ptr<Source> m_source;
    SNDFILE *m_handle;
    SF_INFO m_format;
    Index m_position = 0;
};

} // namespace faintline
