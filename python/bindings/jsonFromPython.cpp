#include "bindings/jsonFromPython.h"

#include <pybind11/numpy.h>

namespace faintline::python {

namespace py = pybind11;

namespace {

    constexpr int deepest = 100;

    std::string typeName(py::handle value)
    {
        return py::str(py::type::handle_of(value).attr("__name__"));
    }

    bool isMapping(py::handle value)
    {
        return py::isinstance<py::dict>(value) || (PyMapping_Check(value.ptr()) && py::hasattr(value, "keys"));
    }

    Json fromAny(py::handle value, const std::string &where, int depth);

    Json fromMapping(py::handle value, const std::string &where, int depth)
    {
        Json object = Json::object();
        for (const py::handle key : py::iter(value.attr("keys")())) {
            if (!py::isinstance<py::str>(key))
                throw Error(where, "has a key that is no text but of type " + typeName(key));
            const std::string name = py::cast<std::string>(key);
            object[name] = fromAny(value[key], jsonName(where, name), depth);
        }
        return object;
    }

    Json fromSequence(py::handle value, const std::string &where, int depth)
    {
        Json list = Json::array();
        for (const py::handle each : value)
            list.push_back(fromAny(each, where + "[" + std::to_string(list.size()) + "]", depth));
        return list;
    }

    /// Whole as far as 64 bits go, which is farther than any setting.
    Json fromInteger(py::handle value)
    {
        const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
        if (!number)
            throw py::error_already_set();
        int overflow = 0;
        const long long whole = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
        return overflow == 0 ? Json(whole) : Json(py::cast<double>(number));
    }

    Json fromAny(py::handle value, const std::string &where, int depth)
    {
        if (depth >= deepest)
            throw Error(where, "is nested more than 100 levels deep");
        if (value.is_none())
            return nullptr;
        if (py::isinstance<py::bool_>(value) || typeName(value) == "bool_")
            return py::cast<bool>(py::bool_(py::reinterpret_borrow<py::object>(value)));
        if (py::isinstance<py::str>(value))
            return py::cast<std::string>(value);
        if (py::isinstance<py::array>(value))
            return fromAny(value.attr("tolist")(), where, depth + 1);
        if (PyIndex_Check(value.ptr()))
            return fromInteger(value);
        if (py::hasattr(value, "__fspath__"))
            return pathFromPython(value);
        if (isMapping(value))
            return fromMapping(value, where, depth + 1);
        if (py::isinstance<py::sequence>(value))
            return fromSequence(value, where, depth + 1);
        if (PyNumber_Check(value.ptr()) && py::hasattr(value, "__float__"))
            return py::cast<double>(py::float_(py::reinterpret_borrow<py::object>(value)));
        throw Error(where,
                    "is of type " + typeName(value) + "; truths, numbers, texts, lists, arrays and dicts are taken");
    }

} // namespace

Json jsonFromPython(py::handle value, const std::string &where)
{
    return fromAny(value, where, 0);
}

py::object pythonFromJson(const Json &json)
{
    switch (json.type()) {
    case Json::value_t::boolean:
        return py::bool_(json.get<bool>());
    case Json::value_t::number_integer:
        return py::int_(json.get<long long>());
    case Json::value_t::number_unsigned:
        return py::int_(json.get<unsigned long long>());
    case Json::value_t::number_float:
        return py::float_(json.get<double>());
    case Json::value_t::string:
        return py::str(json.get<std::string>());
    case Json::value_t::array: {
        py::list list;
        for (const Json &each : json)
            list.append(pythonFromJson(each));
        return list;
    }
    case Json::value_t::object: {
        py::dict dict;
        for (const auto &[key, value] : json.items())
            dict[py::str(key)] = pythonFromJson(value);
        return dict;
    }
    default:
        return py::none();
    }
}

std::string pathFromPython(py::handle path)
{
    return py::cast<std::string>(py::module_::import("os").attr("fsencode")(path));
}

py::str pythonPath(const std::string &path)
{
    return py::module_::import("os").attr("fsdecode")(py::bytes(path));
}

Json jsonOrFile(py::handle value, std::string &where)
{
    if (!py::isinstance<py::str>(value) && !py::hasattr(value, "__fspath__"))
        return jsonFromPython(value, where);
    where = pathFromPython(value);
    return readJsonFile(where);
}

} // namespace faintline::python
