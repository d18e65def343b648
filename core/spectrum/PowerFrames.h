#pragma once

#include "base/Axis.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// What is known of a file of power without reading its values.
struct PowerInfo {
    std::string path;
    std::string container;  ///< "sigproc filterbank" …
    std::string sampleType; ///< "uint8", "float32" …
    Axis time;              ///< s from the first frame
    Axis frequency;         ///< Hz, ascending
    int channelCount = 1;   ///< polarisations
    double quantum = 0.0; ///< step from one value to the next where there are only a few of them (1, 2, 4 bits), else 0
    std::optional<double> startUnixSeconds;
    std::vector<std::string> notes; ///< what was repaired or assumed while opening, one sentence each
};

/// A part of it: some cells of some frames of one channel.
struct PowerPart {
    int channel = 0;
    Index firstFrame = 0;
    Index frames = 0;
    Index firstCell = 0;
    Index cells = 0;
};

/// Power over time and frequency that a file holds already, as a spectrometer or a correlator wrote it: in a unit of
/// its own, with the receiver's passband on it, the mean of any number of looks. No detector takes it before
/// NormalisedPower has been through it.
///
/// Random access; files may be larger than memory. Thread-safe.
class PowerFrames
{
public:
    virtual ~PowerFrames() = default;

    const PowerInfo &info() const { return m_info; }

    /// Writes frames × cells of a part that lies within the file, row by row; NaN where nothing was observed. Throws
    /// Error where the file fails under it.
    virtual void read(const PowerPart &part, std::span<float> out) const = 0;

protected:
    PowerInfo m_info;
};

} // namespace faintline
