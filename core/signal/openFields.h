#pragma once

#include "base/json.h"
#include "signal/fileFormats.h"

namespace faintline {

/// How to read a file, for forms and JSON. The types are those of a list, each with its byte order.
const std::vector<Field<OpenOptions>> &openFields();

/// Only what differs from a file that describes itself.
Json toJson(const OpenOptions &options);

/// Reads the keys of `openFields`; an empty type, and a rate of 0, are not given. Throws Error naming `where.key` for one
/// that is in neither the table nor `otherKeys`.
OpenOptions openOptionsFromJson(Json json, const std::string &where,
                                std::initializer_list<const char *> otherKeys = {});

} // namespace faintline
