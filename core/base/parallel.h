#pragma once

#include "base/Axis.h"
#include "base/RunContext.h"

#include <functional>
#include <string_view>

namespace faintline {

/// Does work item 0 … count-1, each exactly once, on up to context.threads threads, and returns when all are done.
///
/// Each thread asks `makeWorker` once for what it works with (a detector, scratch memory) and calls the answer with the
/// numbers of the items it takes. Which thread takes which item is not defined: an item must write to its own place
/// only and draw its random numbers from its own stream; then results do not depend on the number of threads. The other
/// threads are kept from one call to the next; within a call of another they may all be busy, then the caller works
/// alone. Reports progress from the calling thread. The first exception of any item ends the rest and is thrown; so is
/// Cancelled.
void parallelFor(Index count, const RunContext &context, std::string_view what,
                 const std::function<std::function<void(Index)>()> &makeWorker);

} // namespace faintline
