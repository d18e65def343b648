#pragma once

#include <functional>
#include <string>

namespace faintline {

/// Register of temporary files and folders (half-written files, replay folders), so that a program that must end at
/// once can remove them.

/// Creates a temporary through `make`, which returns its path, or an empty path if it created nothing. Creates nothing
/// once all temporaries were removed.
void makeTemporary(const std::function<std::string()> &make);

/// Removes a path from the register, because it was deleted or became a result.
void forgetTemporary(const std::string &path);

/// Removes all temporaries. The program must end afterwards: later attempts to create one block.
void removeTemporaries();

} // namespace faintline
