#pragma once

#include "base/Axis.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// Properties of a power file that are known without reading its values.
struct PowerInfo {
    std::string path;
    std::string container;  ///< "sigproc filterbank" …
    std::string sampleType; ///< "uint8", "float32" …
    Axis time;              ///< s since the first frame
    Axis frequency;         ///< Hz, ascending
    int channelCount = 1;   ///< polarisations
    double quantum = 0.0;   ///< step between values if there are only a few (1, 2, 4 bits), else 0
    std::optional<double> startUnixSeconds;
    std::vector<std::string> notes; ///< repairs and assumptions made on opening, one sentence each
};

/// A part of a file: some cells of some frames of one channel.
struct PowerPart {
    int channel = 0;
    Index firstFrame = 0;
    Index frames = 0;
    Index firstCell = 0;
    Index cells = 0;
    bool hasDc = false; ///< observe the channels that hold a receiver's DC offset, too
};

/// Power over time and frequency stored in a file, as written by a spectrometer or a correlator: in its own unit,
/// including the receiver's passband, averaged over any number of looks. Detectors need it normalised
/// (NormalisedPower).
///
/// Random access; files may be larger than memory. Thread-safe.
class PowerFrames
{
public:
    virtual ~PowerFrames() = default;

    const PowerInfo &info() const { return m_info; }

    /// Writes frames × cells of a part that lies within the file, row by row; NaN if not observed. Throws Error if
    /// reading the file fails.
    virtual void read(const PowerPart &part, std::span<float> out) const = 0;

protected:
    PowerInfo m_info;
};

} // namespace faintline
