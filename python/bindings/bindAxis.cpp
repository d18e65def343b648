#include "bindings/bind.h"

#include "base/Axis.h"
#include "base/Error.h"
#include "bindings/arrays.h"

#include <cmath>

namespace faintline::python {

namespace py = pybind11;

namespace {

    Axis makeAxis(const std::string &name, Index count, const std::string &unit, double first, double step, bool cyclic)
    {
        if (count < 1)
            throw Error("axis " + name + ": count = " + std::to_string(count), "must be 1 or more");
        if (!(step > 0.0) || !std::isfinite(step) || !std::isfinite(first))
            throw Error("axis " + name, "first must be a number and step a number above 0");
        return {name, unit, first, step, count, cyclic};
    }

    py::array valuesOf(const Axis &axis)
    {
        std::vector<double> values(std::size_t(axis.count));
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = axis.value(double(i));
        return arrayOf(std::move(values));
    }

    std::string axisText(const Axis &axis)
    {
        return py::str("Axis({!r}, {}, unit={!r}, first={!r}, step={!r}, cyclic={!r})")
            .format(axis.name, axis.count, axis.unit, axis.first, axis.step, axis.cyclic);
    }

} // namespace

void bindAxis(py::module_ &module)
{
    py::class_<Axis>(module, "Axis", R"(A sampled dimension: cell i lies at first + i*step, in the axis's unit.

On a cyclic axis, such as a sonar's bearings, the cell after the last one is the first one.)")
        .def(py::init(&makeAxis), py::arg("name"), py::arg("count"), py::kw_only(), py::arg("unit") = "",
             py::arg("first") = 0.0, py::arg("step") = 1.0, py::arg("cyclic") = false)
        .def_readonly("name", &Axis::name)
        .def_readonly("unit", &Axis::unit)
        .def_readonly("first", &Axis::first)
        .def_readonly("step", &Axis::step)
        .def_readonly("count", &Axis::count)
        .def_readonly("cyclic", &Axis::cyclic)
        .def_property_readonly("values", &valuesOf, "The value of every cell, float64 of shape (count,).")
        .def("__len__", [](const Axis &axis) { return axis.count; })
        .def(
            "__eq__", [](const Axis &axis, const Axis &other) { return axis == other; }, py::is_operator())
        .def("__repr__", &axisText);
}

} // namespace faintline::python
