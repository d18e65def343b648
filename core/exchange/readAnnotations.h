#pragma once

#include "inspect/Review.h"
#include "signal/Recording.h"

#include <string>
#include <vector>

namespace faintline {

/// The recording that annotations belong to.
struct AnnotatedRecording {
    RecordingInfo info;
    std::vector<std::string> files{info.path}; ///< names of the files, folders or lists that it is read from

    AnnotatedRecording(const RecordingInfo &recording) : info(recording) {}
    AnnotatedRecording(const RecordingInfo &recording, std::vector<std::string> names)
        : info(recording), files(std::move(names))
    {
    }
};

/// Reads annotations of this or another program: Raven selection tables (columns by name; frequencies in Hz, kHz or
/// MHz), Audacity labels (with or without frequencies), SigMF annotations, and the CSV and JSON of `writeReviewed` and
/// `writeEvents`. The format is recognised by content; tables as TextTable.
///
/// Times are in seconds since the first sample. Frequencies are as elsewhere in the program; for I/Q recordings they
/// are relative to the centre, which `info` gives; in tables of real recordings, an edge of -1 is open. In a table over
/// several files (Begin File, File Offset (s)), rows of other files are left out with a note, and those of a recording
/// of several files are placed by their file's time stamp. A text "label [rejected] note" is split. At most 100 000
/// annotations of a file of at most 64 MiB; invalid or hostile content throws Error naming file and line.
std::vector<Annotation> readAnnotations(const std::string &path, const AnnotatedRecording &of,
                                        std::vector<std::string> *notes = nullptr);

} // namespace faintline
