#pragma once

#include <string>
#include <vector>

namespace faintline {

/// How the names of files end that can be opened as recordings, without the dot. Others are recognised by their
/// content, if one asks for them.
const std::vector<std::string> &recordingEndings();

/// The recordings in these files and folders, as whole paths in order; each once.
///
/// A file is taken as it is. In a folder and the folders below it those count whose name ends as that of a recording
/// does (.wav, .flac, .sigmf-meta, .fil …; .npy with its NAME.grid.json); with `raw`, those of raw samples instead
/// (.cf32, .cs16 …). Names that begin with a dot are left out, and links to folders are not followed. Folders that
/// cannot be read are added to `unreadable`. Throws Error where a name does not exist.
std::vector<std::string> findRecordings(const std::vector<std::string> &names, bool raw,
                                        std::vector<std::string> &unreadable);

} // namespace faintline
