#pragma once

#include "signal/FileBytes.h"
#include "signal/PowerFrames.h"
#include "signal/formats/NumPy.h"

namespace faintline {

/// A spectrogram in a NumPy file of shape (frames, frequencies), power in any unit, whose axes are described by a grid
/// file with "values": "power":
///
///   { "values": "power", "time": { "first": 0, "step": 0.5 },
///     "axes": [ { "name": "frequency", "unit": "Hz", "first": 100, "step": 2 } ] }
///
/// The file may be larger than memory. Thread-safe.
class NumPyPower final : public PowerFrames
{
public:
    /// Throws Error if one of the files is damaged or they do not match.
    NumPyPower(const std::string &path, const std::string &gridPath);

    void read(const PowerPart &part, std::span<float> out) const override;

    /// Whether the grid file exists and declares power on one axis. False if it cannot be read; the next reader then
    /// reports why.
    static bool recognises(const std::string &path, const std::string &gridPath);

private:
    FileBytes m_file;
    NumPyLayout m_layout;
};

} // namespace faintline
