#pragma once

#include "base/Axis.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// A dataset of numbers, or of pairs "r" and "i", in an open HDF5 file, with random access to boxes.
class Hdf5Dataset
{
public:
    ~Hdf5Dataset();

    const std::vector<Index> &shape() const { return m_shape; }
    bool isComplex() const { return m_isComplex; }
    bool isFloat() const { return m_isFloat; }
    bool isSigned() const { return m_isSigned; }
    int bits() const { return m_bits; } ///< of a number
    /// Of a number: "float32", "uint8".
    std::string typeName() const
    {
        return (m_isFloat ? "float" : m_isSigned ? "int" : "uint") + std::to_string(m_bits);
    }

    /// A numeric or text attribute; nothing if it is missing or of another kind.
    std::optional<double> number(const std::string &attribute) const;
    std::optional<std::string> text(const std::string &attribute) const;

    /// Reads a box, last axis contiguous, converted to single precision, two floats per pair. Precondition: it lies
    /// within the shape. Throws Error if the file is damaged there, or if a small box needs more compressed chunks than
    /// are cached.
    void read(const std::vector<Index> &first, const std::vector<Index> &count, std::span<float> out) const;

    /// All values of a table of integers, at most a million. Throws Error as `read` does.
    std::vector<std::int64_t> readIntegers() const;

private:
    friend class Hdf5File;
    Hdf5Dataset(std::string path, std::int64_t handle);
    void checkChunks(const std::vector<Index> &first, const std::vector<Index> &count) const;

    std::string m_path; ///< of the file
    std::int64_t m_handle;
    std::vector<Index> m_shape;
    std::vector<Index> m_chunk; ///< empty if the values are contiguous
    bool m_isComplex = false;
    bool m_isFloat = false;
    bool m_isSigned = false;
    int m_bits = 0;
};

/// An HDF5 file opened for reading, with every feature disabled that reaches outside the file.
///
/// Only hard links are followed, no external or soft ones. Datasets whose values lie in other files (external storage,
/// virtual datasets) are refused. No plug-in is loaded, whatever the file or the environment specify: the only filters
/// are those built into the library, and bitshuffle with or without LZ4, decoded here. Chunks of more than 64 MiB, and
/// lengths that the stored bytes cannot unpack to, are refused. A lock lets one thread at a time use the library, so
/// these classes are thread-safe, and they leave the library's state as they found it for other users in the process.
/// Only this file uses HDF5.
class Hdf5File
{
public:
    /// Throws Error if it is not an HDF5 file or is damaged.
    explicit Hdf5File(const std::string &path);
    ~Hdf5File();
    Hdf5File(const Hdf5File &) = delete;
    Hdf5File &operator=(const Hdf5File &) = delete;

    /// A dataset by its path ("strain/Strain"), or null if there is none. Throws Error if the path may not be followed
    /// or the dataset cannot be read.
    std::unique_ptr<Hdf5Dataset> dataset(const std::string &name) const;

    /// Whether a file has the HDF5 signature.
    static bool recognises(const std::string &path);

    /// For processes in which others use the library as well: keeps its clean-up at exit on, which closes objects left
    /// open. Otherwise it is off, because it prints many lines about damaged files. Call it before the first file is
    /// opened.
    static void shareLibrary();

private:
    std::string m_path;
    std::int64_t m_handle = -1;
};

} // namespace faintline
