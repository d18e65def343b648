#pragma once

namespace faintline {

/// Opens closed standard streams on the null device. Otherwise the next opened file would take their descriptor, and
/// terminal output would end up in a result. Streams that were closed stay unwritable or silent. Call it before any
/// file is opened.
void openStandardStreams();

/// Flushes standard output; returns false if any of it could not be written (disk full, descriptor closed).
bool flushStandardOutput();

} // namespace faintline
