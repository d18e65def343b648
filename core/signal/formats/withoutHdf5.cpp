// Stands in for Hdf5File.cpp where libhdf5 or liblz4 is not installed: HDF5 files are recognised, and refused.

#include "base/Error.h"
#include "signal/FileBytes.h"
#include "signal/formats/Hdf5File.h"

namespace faintline {

bool Hdf5File::recognises(const std::string &path)
{
    return FileBytes(path).hasAt(0, "\x89HDF\r\n\x1a\n");
}

Hdf5File::Hdf5File(const std::string &path)
{
    throw Error(path, "is an HDF5 file, which this build of Faintline cannot read; it needs libhdf5 and liblz4");
}

Hdf5File::~Hdf5File() = default;
void Hdf5File::shareLibrary() {}
std::unique_ptr<Hdf5Dataset> Hdf5File::dataset(const std::string &) const
{
    return nullptr;
}

Hdf5Dataset::~Hdf5Dataset() = default;
std::optional<double> Hdf5Dataset::number(const std::string &) const
{
    return {};
}
std::optional<std::string> Hdf5Dataset::text(const std::string &) const
{
    return {};
}
void Hdf5Dataset::read(const std::vector<Index> &, const std::vector<Index> &, std::span<float>) const {}
std::vector<std::int64_t> Hdf5Dataset::readIntegers() const
{
    return {};
}

} // namespace faintline
