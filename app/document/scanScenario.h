#pragma once

#include "evaluate/sequential/ScanTest.h"

#include <QString>

namespace faintline {

/// Path of the bundled scenario of radar scans.
QString radarScenarioPath();

/// Whether a path names a scenario of kind "scans"; false if it cannot be read.
bool isScanScenario(const QString &path);

/// The test for such a scenario. Throws Error.
ScanTest readScanTest(const QString &path);

} // namespace faintline
