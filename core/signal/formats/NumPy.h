#pragma once

#include "base/Axis.h"
#include "base/files/AtomicFile.h"
#include "signal/FileBytes.h"
#include "signal/PowerFrames.h"

#include <span>
#include <string>
#include <vector>

namespace faintline {

/// Values of an array in NumPy's .npy format, version 1.0: float32 or float64, little-endian, C order.
template <class T>
struct NumPyValues {
    std::vector<Index> shape;
    std::vector<T> values;
};
using NumPyArray = NumPyValues<float>; ///< float64 is rounded to single precision
using NumPyDoubles = NumPyValues<double>;

/// Number of values in an array of that shape.
Index valueCount(const std::vector<Index> &shape);

/// Shape, position and type of the values of any .npy file in C order, without reading them.
struct NumPyHeader {
    std::vector<Index> shape;
    Index offset = 0;       ///< of the first value, bytes
    std::string descriptor; ///< NumPy's name of the type: "<f4", "|u1" …

    bool isDouble() const { return descriptor == "<f8"; }
};

/// Throws Error if the file is not such an array; its length and type are not checked.
NumPyHeader readNumPyHeader(const std::string &path);

/// Throws Error if the file is not such an array, is truncated, or holds more than 2³¹ values.
NumPyArray readNumPy(const std::string &path);
NumPyDoubles readNumPyDoubles(const std::string &path);

/// Writes a float32 array part by part; the file appears with `finish`, when it holds all values.
class NumPyWriter
{
public:
    NumPyWriter(const std::string &path, const std::vector<Index> &shape);
    void write(std::span<const float> values);
    /// Throws Error if the number of values does not match the shape.
    void finish();

private:
    AtomicFile m_file;
    std::string m_path;
    Index m_expected = 1;
    Index m_written = 0;
};

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
    NumPyHeader m_header;
};

} // namespace faintline
