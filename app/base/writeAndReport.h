#pragma once

#include "base/Error.h"

#include <QString>

namespace faintline {

/// Calls `write`, which writes a file to `path` and may throw Error, and has `writer` emit the outcome: the signal
/// written(path) or failed(error).
template <class Writer, class Write>
void writeAndReport(Writer &writer, const QString &path, Write write)
{
    try {
        write();
        emit writer.written(path);
    } catch (const Error &error) {
        emit writer.failed(error);
    }
}

} // namespace faintline
