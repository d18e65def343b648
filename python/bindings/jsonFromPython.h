#pragma once

#include "base/json.h"

#include <pybind11/pybind11.h>

#include <string>

namespace faintline::python {

/// None, truths, numbers, texts, paths, lists, arrays and mappings as JSON. Throws Error naming `where.key` for
/// anything else.
Json jsonFromPython(pybind11::handle value, const std::string &where);

/// The other way: dicts, lists, texts, numbers, truths, None.
pybind11::object pythonFromJson(const Json &json);

/// What is described by a mapping, or by the JSON file that a path names; `where` becomes the path then.
Json jsonOrFile(pybind11::handle value, std::string &where);

/// The name of a file from a text or a path-like object.
std::string pathFromPython(pybind11::handle path);

/// The other way: bytes that are no text come back as they were from os.fsencode.
pybind11::str pythonPath(const std::string &path);

} // namespace faintline::python
