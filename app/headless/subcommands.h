#pragma once

#include "app/headless/RenderOptions.h"
#include "app/headless/comparePictures.h"
#include "app/headless/replayPicture.h"

#include <CLI/CLI.hpp>

#include <string>

namespace faintline {

// Options of the program faintline and of its subcommands; each function returns the subcommand that it adds.

/// `size`: as `parseSize` takes it.
CLI::App *addRender(CLI::App &program, RenderOptions &options, std::string &size);
CLI::App *addReport(CLI::App &program, RenderOptions &options);
CLI::App *addReplay(CLI::App &program, ReplayOptions &options);
CLI::App *addCheckPictures(CLI::App &program, CheckOptions &options);

/// "1600x1000"; throws Error.
QSize parseSize(const std::string &text);

/// Rejects "nan" and "inf", which no range check catches; throws Error.
void checkNumbers(const RenderOptions &options);

} // namespace faintline
