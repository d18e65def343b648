#pragma once

#include <string>
#include <vector>

namespace faintline {

/// The recordings in these files and folders, as absolute paths in order, without duplicates.
///
/// Named files are always included. Folders are searched recursively for files with the extension of a recording (.wav,
/// .flac, .sigmf-meta, .fil …; .npy with its NAME.grid.json), or of raw samples if `raw` is set (.cf32, .cs16 …). Names
/// that begin with a dot are ignored, and links to folders are not followed. Folders that cannot be read are added to
/// `unreadable`. Throws Error if a name does not exist.
std::vector<std::string> findRecordings(const std::vector<std::string> &names, bool raw,
                                        std::vector<std::string> &unreadable);

} // namespace faintline
