#pragma once

#include <cstdint>

namespace faintline {

/// How the library reads: through FileBytes, and nothing but what is there.
///
/// Its own drivers let it keep what it last read of a file's structure in a buffer, whose reach it compares with
/// addresses that a damaged file chose, without looking whether their sum wraps (1.10: a file of a kilobyte ended
/// the program). This one has no such buffer, and no locks, which a read-only folder need not allow.
///
/// To be given back with H5FDunregister once the file is open; negative where the library refuses it.
std::int64_t registerHdf5Driver();

} // namespace faintline
