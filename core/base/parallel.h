#pragma once

#include "base/Axis.h"
#include "base/RunContext.h"

#include <functional>
#include <string_view>

namespace faintline {

/// Processes work items 0 … count-1, each exactly once, on up to context.threads threads, and returns when all are
/// done.
///
/// Each thread calls `makeWorker` once, for example to create a detector and scratch memory, and then calls the
/// returned function with the numbers of its items. The assignment of items to threads is not defined. If each item
/// writes to its own place only and uses its own random stream, results do not depend on the number of threads. Threads
/// are reused between calls; in a nested call all may be busy, and the caller then works alone. Reports progress from
/// the calling thread. The first exception of any item, or Cancelled, ends the rest and is rethrown.
void parallelFor(Index count, const RunContext &context, std::string_view what,
                 const std::function<std::function<void(Index)>()> &makeWorker);

} // namespace faintline
