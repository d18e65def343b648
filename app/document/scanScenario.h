#pragma once

#include "evaluate/sequential/ScanTest.h"

#include <QString>

namespace faintline {

/// The scenario of a radar's scans that comes with the program.
QString radarScenarioPath();

/// Whether a path names a scenario of kind "scans"; what cannot be read is none.
bool isScanScenario(const QString &path);

/// The test that goes with such a scenario. Throws Error.
ScanTest readScanTest(const QString &path);

} // namespace faintline
