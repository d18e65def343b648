#pragma once

#include "signal/FileBytes.h"

#include <optional>
#include <span>
#include <string>

namespace faintline {

/// Bytes of a RIFF file's beginning: its kind, length and "WAVE"; and of a chunk's name and length.
constexpr Index riffHeadBytes = 12;
constexpr Index chunkHeadBytes = 8;

/// A chunk of a RIFF file: its name, and where its content lies.
struct RiffChunk {
    std::string name;
    Index offset = 0;
    Index length = 0;

    Index end() const { return offset + length + length % 2; } ///< with the padding
};

/// The chunk whose head lies there; nothing beyond the end of the file.
std::optional<RiffChunk> riffChunkAt(const FileBytes &file, Index offset);

/// Whether a file begins as a WAV file of that kind: "RIFF", or "RF64" with lengths of 64 bits.
bool isWave(const FileBytes &file, std::string_view kind);

/// Whether bytes begin as a RIFF chunk does, rather than as samples: a name of four printable characters, and a length
/// of at most 16 MiB, or the name of a chunk that programs write behind samples.
bool isChunkHead(std::span<const std::byte> bytes);

/// What follows the declared end of a WAV file's samples.
enum class BehindSamples { Nothing, Chunk, Padding, Samples, Unknown };

/// Tells by the first bytes behind a declared end. A length in 32 bits may be too small, because a recorder passed 4 GiB
/// or was killed; what begins as no chunk is then more samples. Fewer bytes than a chunk's head, zeros of up to 64 KiB
/// and an ID3 tag (128 bytes) to the end are none. `isOdd`: the declared length is, so that a byte of padding may
/// precede a chunk. `isAll`: no more bytes follow; else Unknown says that more are needed.
BehindSamples behindSamples(std::span<const std::byte> bytes, bool isOdd, bool isAll);
constexpr std::size_t mostToTellByBytes = (std::size_t(1) << 16) + 2; ///< bytes that are enough for behindSamples

/// Where the samples of a WAV file end whose declared length, to `declaredEnd`, is too small: at the chunks of a sequence
/// that reaches exactly to the end of the file, in its last MiB, else at the end of the file. Their names are letters,
/// digits, _ or blanks, and the first one stands at a whole number of frames of `frameBytes`, from `begin` on, or a byte
/// of padding behind it. White bytes look like that in two of 10⁶ files: a length of 32 bits must have one value.
Index chunksAtEnd(const FileBytes &file, Index declaredEnd, Index begin, Index frameBytes);

/// Whether a LIST or INFO chunk of a RIFF file holds a length that would make libsndfile 1.2 (wavlike_subchunk_parse),
/// which adds lengths in 32 bits, seek backwards and possibly loop forever. Chunks for photographs (exif) count as
/// such: they are not parsed here, and no recorder writes them.
///
///   "LIST" size "INFO"|"adtl",  then repeatedly  name size content
bool leadsBackwards(const FileBytes &file, Index chunk);

} // namespace faintline
