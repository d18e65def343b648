#pragma once

#include "signal/openRecording.h"

#include <memory>
#include <string>
#include <vector>

namespace faintline {

class MainWindow;

/// Windows at program start: one for each file, at least one, with the program's store and theme.
std::vector<std::unique_ptr<MainWindow>> programWindows(const std::vector<std::string> &files,
                                                        const OpenOptions &options);

} // namespace faintline
