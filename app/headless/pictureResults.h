#pragma once

#include "app/headless/comparePictures.h"

#include <string>
#include <vector>

namespace faintline {

/// Compared pictures for programs that run tests: one test case a picture, a failure where it differs, is missing or is
/// new. Nothing in them depends on when or where they were compared.

/// JUnit XML: one `testsuite` named check-pictures.
std::string junitText(const std::vector<CheckedPicture> &pictures);

/// JSON: "pictures" (name, state: same, different, missing or new; expected and actual size; changedPixels,
/// toleratedPixels, places around groups of changed pixels), "compared" and "differing", their numbers.
std::string resultsJson(const std::vector<CheckedPicture> &pictures);

/// checkPictures as a command: a line for each picture that is not the same, or the results as JSON; throws Error{Failure}
/// if there is one.
void runCheckPictures(const CheckOptions &options);

} // namespace faintline
