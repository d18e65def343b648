#include "bindings/bind.h"

#include "base/Error.h"
#include "base/oneLine.h"
#include "bindings/Source.h"
#include "bindings/arrays.h"
#include "bindings/jsonFromPython.h"
#include "noise/openFrames.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

namespace faintline::python {

namespace py = pybind11;

namespace {

    std::vector<py::ssize_t> shapeOf(const NormalisedFrames &frames, Index count)
    {
        std::vector<py::ssize_t> shape{count};
        for (const Axis &axis : frames.grid().axes)
            shape.push_back(axis.count);
        return shape;
    }

    py::array readFramesOf(const HeldFrames &self, Index first, std::optional<Index> count)
    {
        const NormalisedFrames &frames = *self.frames;
        if (first < 0 || first > frames.time().count)
            throw Error("first = " + std::to_string(first),
                        "there are the frames 0 … " + std::to_string(frames.time().count - 1));
        const Index wanted = std::clamp<Index>(count.value_or(frames.time().count), 0, frames.time().count - first);
        std::vector<float> values(std::size_t(wanted * frames.grid().size()));
        {
            const py::gil_scoped_release released;
            frames.read(first, wanted, values);
        }
        return arrayOf(std::move(values), shapeOf(frames, wanted));
    }

    Grid gridOf(const py::array &values, const py::object &axes)
    {
        Grid grid;
        const auto cellAxes = std::size_t(values.ndim() - 1);
        if (!axes.is_none())
            grid.axes = py::cast<std::vector<Axis>>(axes);
        else
            for (std::size_t i = 1; i <= cellAxes; ++i)
                grid.axes.push_back(Axis::unnamed(i, values.shape(static_cast<py::ssize_t>(i))));
        if (grid.axes.size() != cellAxes)
            throw Error("axes", "must be one Axis for each of the frames' " + std::to_string(cellAxes) + " cell axes");
        for (std::size_t i = 0; i < cellAxes; ++i)
            if (grid.axes[i].count != values.shape(static_cast<py::ssize_t>(i + 1)))
                throw Error("axes[" + std::to_string(i) + "].count = " + std::to_string(grid.axes[i].count),
                            "the frames have " + std::to_string(values.shape(static_cast<py::ssize_t>(i + 1)))
                                + " cells there");
        return grid;
    }

    Axis timeOf(const py::array &values, const py::object &time)
    {
        Axis axis{"time", "s", 0.0, 1.0, values.shape(0), false};
        if (time.is_none())
            return axis;
        if (py::isinstance<Axis>(time)) {
            axis.first = py::cast<Axis>(time).first;
            axis.step = py::cast<Axis>(time).step;
        } else {
            axis.step = py::cast<double>(time);
        }
        if (!(axis.step > 0.0) || !std::isfinite(axis.step))
            throw Error("time", "must be the seconds from frame to frame, above 0, or an Axis");
        return axis;
    }

    std::string framesText(const HeldFrames &self)
    {
        const auto cellsOf = [](const Axis &axis) { return std::to_string(axis.count) + " (" + axis.name + ")"; };
        const std::string cells = listed(self.frames->grid().axes, cellsOf, " × ");
        return py::str("<faintline.Frames {} of {} cells, {:g} s a frame>")
            .format(self.frames->time().count, cells, self.frames->time().step);
    }

} // namespace

HeldFrames framesOfArray(const py::object &given, const py::object &axes, const py::object &time)
{
    const auto values = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(given);
    if (!values)
        throw Error("frames", "must be an array of real numbers");
    if (values.ndim() < 2 || values.size() == 0)
        throw Error("frames", "must have the shape (frames, cells…) with at least one of each");
    std::vector<float> copy(values.data(), values.data() + values.size());
    checkFrameValues(copy, "frames");
    return {std::make_shared<FrameArray>(timeOf(values, time), gridOf(values, axes), std::move(copy)), nullptr};
}

void bindFrames(py::module_ &module)
{
    py::class_<HeldFrames>(module, "Frames", R"(Frames of normalised power on a grid, the input of a detector.

Frames(y, axes=None, time=None) creates them from an array.

y: shape (frames, cells…), power over mean noise power, so that noise has mean 1; finite and not negative, NaN for cells
that were not observed.
axes: one Axis per cell axis.
time: seconds from frame to frame, or an Axis.

Raises Error for other values and for axes of a different size.)")
        .def(py::init(&framesOfArray), py::arg("y"), py::arg("axes") = py::none(), py::arg("time") = py::none())
        .def_property_readonly(
            "axes", [](const HeldFrames &self) { return self.frames->grid().axes; }, "The cells' axes, slowest first.")
        .def_property_readonly(
            "time", [](const HeldFrames &self) { return self.frames->time(); }, "The time axis, s.")
        .def_property_readonly("shape",
                               [](const HeldFrames &self) {
                                   return py::tuple(py::cast(shapeOf(*self.frames, self.frames->time().count)));
                               })
        .def_property_readonly(
            "truth", [](const HeldFrames &self) { return pythonFromJson(self.truth); },
            "Truth of simulated pings: positions of the targets, a dict; otherwise None.")
        .def("__len__", [](const HeldFrames &self) { return self.frames->time().count; })
        .def("read", &readFramesOf, py::arg("first") = 0, py::arg("count") = py::none(),
             "Returns frames first … first+count-1, fewer at the end: float32 of shape (frames, cells…).")
        .def("__repr__", &framesText);
}

} // namespace faintline::python
