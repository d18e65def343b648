#pragma once

#include <functional>
#include <string>

namespace faintline {

/// What is on disk only while something is being made: half-written files, and folders of a replay. Whoever makes one
/// says so here, so that a program that has to end at once can take them with it.

/// Makes something temporary, of which `make` tells the path; an empty one is nothing. Nothing is made any more once
/// all were removed.
void makeTemporary(const std::function<std::string()> &make);

/// It is gone, or has become a result.
void forgetTemporary(const std::string &path);

/// Removes all temporaries. The program must end after it: later attempts to create one block.
void removeTemporaries();

} // namespace faintline
