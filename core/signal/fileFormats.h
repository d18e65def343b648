#pragma once

#include "signal/PowerFrames.h"
#include "signal/RawPings.h"
#include "signal/Recording.h"

#include <memory>
#include <string>
#include <vector>

namespace faintline {

/// How to read a file that does not fully describe itself.
struct OpenOptions {
    bool iq = false;        ///< take real channels in pairs, as I and Q of one complex channel
    std::string rawType;    ///< datatype of a raw file, SigMF's names ("ci16_le", "rf32_be", "cu8" …); empty: not raw
    double rawRateHz = 0.0; ///< sample rate of a raw file
    int rawChannels = 1;
    Index rawHeaderBytes = 0;

    bool operator==(const OpenOptions &) const = default;
};

/// A format of files that hold samples, or frames: power over time and frequency, or pings.
struct FileFormat {
    const char *name;
    std::vector<std::string> endings;            ///< of names, without the dot, by which folders and dialogs find it
    bool (*recognises)(const std::string &path); ///< by name or content
    /// Null for formats of frames; these have one or both of the others, which give null for a file of the other kind.
    /// All read headers only, and throw Error naming the file and the cause.
    RecordingPointer (*openSamples)(const std::string &path, const OpenOptions &options);
    std::shared_ptr<const PowerFrames> (*openPower)(const std::string &path, const std::string &gridPath) = nullptr;
    std::shared_ptr<const RawPings> (*openPings)(const std::string &path, const std::string &gridPath) = nullptr;
};

/// All formats. The first one that recognises a file opens it; the last one of samples tries every file.
const std::vector<FileFormat> &fileFormats();

/// Whether a name says that a file holds raw samples, and its content does not contradict.
bool isNamedRaw(const std::string &path);
/// Opens raw samples, whose type and rate the options tell. Throws Error.
RecordingPointer openRaw(const std::string &path, const OpenOptions &options);

/// Endings of the names of all formats, without the dot, those of sound first.
std::vector<std::string> recordingEndings();
/// Whether a file's name has one of them, or one of a format of samples.
bool isNamedLikeRecording(const std::string &path, bool mayHoldFrames = true);

/// Path of the file that describes the axes of a stack of frames: NAME.grid.json for NAME.npy or NAME.h5.
std::string gridPathOf(const std::string &stackPath);
/// The same if there is such a file, else empty.
std::string gridBeside(const std::string &stackPath);

/// Path of the file that states what a recording or a stack is known to hold: sea.truth.json for sea.npy.
std::string truthPathOf(const std::string &path);

/// Whether a file holds frames (with time and frequency, or any other axes) rather than samples: a NumPy file by its
/// name, others by content. False if there is no such file.
bool holdsFrames(const std::string &path);

/// Opens a file of power that is not normalised yet; null for files of another kind. Throws Error.
std::shared_ptr<const PowerFrames> openPower(const std::string &path);

/// Opens a stack of frames on several axes, as numbers; null for other files, also for frames on a single axis.
/// `gridPath`: empty for axes without units. Throws Error.
std::shared_ptr<const RawPings> openRawPings(const std::string &path, const std::string &gridPath);

} // namespace faintline
