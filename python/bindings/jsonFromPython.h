#pragma once

#include "base/json.h"

#include <pybind11/pybind11.h>

#include <string>

namespace faintline::python {

/// Converts None, booleans, numbers, strings, paths, lists, arrays and mappings to JSON. Throws Error with `where.key`
/// for anything else.
Json jsonFromPython(pybind11::handle value, const std::string &where);

/// Converts JSON to dicts, lists, strings, numbers, booleans and None.
pybind11::object pythonFromJson(const Json &json);

/// JSON of a mapping, or of the file at a path; `where` is then set to the path.
Json jsonOrFile(pybind11::handle value, std::string &where);

/// The file name in a string or path-like object.
std::string pathFromPython(pybind11::handle path);

/// The inverse; bytes that are not valid text are preserved, as by os.fsdecode.
pybind11::str pythonPath(const std::string &path);

} // namespace faintline::python
