#pragma once

#include <cstdint>

namespace faintline {

/// HDF5 file driver that reads through FileBytes, and only bytes that exist.
///
/// The library's own drivers allow a metadata buffer, and the library compares the buffer's range with addresses from
/// the file without checking for overflow (in 1.10 a damaged file of a kilobyte crashed the program). This driver has
/// neither that buffer nor locks, which a read-only folder may not allow.
///
/// Release it with H5FDunregister once the file is open. Returns a negative number if the library refuses it.
std::int64_t registerHdf5Driver();

} // namespace faintline
