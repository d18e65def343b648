#pragma once

#include "base/Error.h"

#include <QString>

namespace faintline {

/// Calls `act`, which may throw Error; `self` then emits its signal failed(error).
template <class Object, class Act>
void actOrReport(Object &self, Act act)
{
    try {
        act();
    } catch (const Error &error) {
        emit self.failed(error);
    }
}

/// Calls `write`, which writes a file to `path` and may throw Error, and has `writer` emit the outcome: the signal
/// written(path) or failed(error).
template <class Writer, class Write>
void writeAndReport(Writer &writer, const QString &path, Write write)
{
    actOrReport(writer, [&] {
        write();
        emit writer.written(path);
    });
}

} // namespace faintline
