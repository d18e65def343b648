#pragma once

#include "signal/PowerFrames.h"

#include <span>
#include <string>

namespace faintline {

/// What sigproc's header says of a filterbank's axes, in its units.
struct FilterbankHeader {
    double fch1 = 0.0;   ///< frequency of the first channel, MHz
    double foff = 0.0;   ///< between channels, MHz; negative if they descend
    double tsamp = 0.0;  ///< s
    double tstart = 0.0; ///< MJD of the beginning of the first spectrum; 0: unknown
    Index channels = 0;
    Index frames = 0;
};

/// Sets axes and start time, with a note on channels that excludeDc leaves out: frequencies ascend, in Hz; the time of a frame is its middle. Throws Error naming `path`
/// and the invalid value.
void setFilterbankAxes(PowerInfo &info, const FilterbankHeader &header, const std::string &path);

/// Sets values of a part to NaN (not observed) in channels that hold a receiver's DC offset, unless the part keeps them
/// (hasDc): the middle one of each coarse channel, in files of whole coarse channels of 2²⁰ channels. A file of another
/// number was cut out, and its middle is a channel like others. `descends`: as in the file.
void excludeDc(const PowerInfo &info, const PowerPart &part, bool descends, std::span<float> out);

} // namespace faintline
