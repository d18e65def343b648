#pragma once

namespace faintline {

/// Opens what of standard input, output and error is closed, as nothing: otherwise the next file that is opened takes
/// its number, and what is meant for a terminal ends up in a result. What was closed stays unwritable or silent. Call
/// it before anything is opened.
void openStandardStreams();

/// Sends out what standard output still holds; false where any of it could not be written, be it a full disk or a
/// closed descriptor.
bool flushStandardOutput();

} // namespace faintline
