#pragma once

#include "app/cli/inRange.h"
#include "signal/fileFormats.h"

namespace faintline {

/// Adds the options, of both programs, that say how to read a file that does not describe itself.
inline void addOpening(CLI::App &command, OpenOptions &options)
{
    command.add_flag("--iq", options.iq, "Treat two channels as I and Q");
    command.add_option("--raw-type", options.rawType, "Sample type of a raw file, as in SigMF: ci16_le, rf32_le …");
    command.add_option("--raw-rate", options.rawRateHz, "Sample rate of a raw file, Hz")->check(inRange(1e-9, 1e15));
    command.add_option("--raw-channels", options.rawChannels, "Channels of a raw file")->check(inRange(1, 1024));
    command.add_option("--raw-header", options.rawHeaderBytes, "Bytes before the first sample of a raw file")
        ->check(inRange(0, 1e15));
}

} // namespace faintline
