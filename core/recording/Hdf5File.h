#pragma once

#include "base/Axis.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// A dataset of numbers, or of pairs "r" and "i", in an open HDF5 file: random access to boxes of it.
class Hdf5Dataset
{
public:
    ~Hdf5Dataset();

    const std::vector<Index> &shape() const { return m_shape; }
    bool isComplex() const { return m_isComplex; }
    bool isFloat() const { return m_isFloat; }
    bool isSigned() const { return m_isSigned; }
    int bits() const { return m_bits; } ///< of a number

    /// A number or a text of an attribute; nothing where there is none, or one of another kind.
    std::optional<double> number(const std::string &attribute) const;
    std::optional<std::string> text(const std::string &attribute) const;

    /// Reads a box, last axis contiguous, converted to single precision, two floats a pair. Precondition: it lies within the shape. Throws
    /// Error where the file is damaged there, or packed in chunks of which a small box needs more than are kept.
    void read(const std::vector<Index> &first, const std::vector<Index> &count, std::span<float> out) const;

    /// All values of a table of whole numbers, at most a million. Throws Error as read does.
    std::vector<std::int64_t> readIntegers() const;

private:
    friend class Hdf5File;
    Hdf5Dataset(std::string path, std::int64_t handle);
    void checkChunks(const std::vector<Index> &first, const std::vector<Index> &count) const;

    std::string m_path; ///< of the file
    std::int64_t m_handle;
    std::vector<Index> m_shape;
    std::vector<Index> m_chunk; ///< empty where the values lie in one piece
    bool m_isComplex = false;
    bool m_isFloat = false;
    bool m_isSigned = false;
    int m_bits = 0;
};

/// An HDF5 file, opened to be read, with all shut off by which one reaches beyond itself.
///
/// Only hard links are followed: no external and no soft ones. Datasets whose values lie in other files (external
/// storage, virtual datasets) are refused. No plug-in is ever loaded, wherever the file or the environment say that
/// they are: filters are those that are built into the library, and bitshuffle with or without LZ4, decoded here.
/// Chunks of more than 64 MiB are refused, and lengths that what is stored cannot have been unpacked to. The library
/// is used by one thread at a time (a lock of this class), so the classes are thread-safe, and left as it was found,
/// for others of the process may use it. This is the only place that knows HDF5.
class Hdf5File
{
public:
    /// Throws Error where it is no HDF5 file, or damaged.
    explicit Hdf5File(const std::string &path);
    ~Hdf5File();
    Hdf5File(const Hdf5File &) = delete;
    Hdf5File &operator=(const Hdf5File &) = delete;

    /// A dataset by its path ("strain/Strain"); null where there is none. Throws Error where it may not be followed or
    /// cannot be read.
    std::unique_ptr<Hdf5Dataset> dataset(const std::string &name) const;

    /// Whether a file begins as one.
    static bool recognises(const std::string &path);

    /// For programs in which others use the library as well: its clean-up at exit stays on, which closes what they left
    /// open. Otherwise it is off, for of damaged files it says more than one line. To be called before the first file
    /// is opened.
    static void shareLibrary();

private:
    std::string m_path;
    std::int64_t m_handle = -1;
};

} // namespace faintline
