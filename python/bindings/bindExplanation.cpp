#include "bindings/bind.h"

#include "bindings/arrays.h"
#include "bindings/explanation.h"

#include <pybind11/stl.h>

#include <array>

namespace faintline::python {

namespace py = pybind11;

namespace {

    constexpr std::array<const char *, 3> resetNames{"beginning", "background", "forgotten"};

    const StateSpace &spaceOf(const HeldExplanation &self)
    {
        return self.analysis->modelAt(self.explanation.model).space;
    }

    template <class Take>
    Column column(const HeldExplanation &self, const std::string &name, const Take &take)
    {
        std::vector<double> values;
        for (const PathStep &step : self.explanation.steps)
            values.push_back(take(step));
        return {name, arrayOf(std::move(values))};
    }

    py::array steps(const HeldExplanation &self)
    {
        const Grid &grid = self.analysis->grid();
        const StateSpace &space = spaceOf(self);
        std::vector<Column> columns;
        const auto add = [&](const std::string &name, const auto &take) {
            columns.push_back(column(self, name, take));
        };
        const bool isLine = grid.axes.size() == 1;
        add("t", [&](const PathStep &s) { return self.analysis->time().value(double(s.frame)); });
        for (std::size_t axis = 0; axis < grid.axes.size(); ++axis) {
            add(isLine ? "f" : grid.axes[axis].name, [&](const PathStep &s) {
                return grid.axes[axis].value(double(grid.coordinates(space.cellOf(s.state))[axis]));
            });
            add(isLine ? "rate" : grid.axes[axis].name + "_rate",
                [&](const PathStep &s) { return space.ratesOfPlane(space.planeOf(s.state))[axis]; });
        }
        add("llr", [](const PathStep &s) { return s.logLikelihoodRatio; });
        add("ln_transition", [](const PathStep &s) { return s.lnTransition; });
        add("ln_k", [](const PathStep &s) { return s.lnK; });
        add("sum", [](const PathStep &s) { return s.score; });
        add("runner_up_margin", [](const PathStep &s) { return s.runnerUp; });
        return tableOf(columns);
    }

    template <class T>
    auto member(T Explanation::*which)
    {
        return [which](const HeldExplanation &self) { return self.explanation.*which; };
    }

    std::string explanationText(const HeldExplanation &self)
    {
        const Explanation &e = self.explanation;
        return py::str("<faintline.Explanation: statistic {:.4f} nat, threshold {:.4f}, path of {} frame(s){}>")
            .format(e.statistic, e.threshold, e.steps.size(), e.isTracked ? ", followed by a tracker" : "");
    }

} // namespace

void bindExplanation(py::module_ &module)
{
    py::class_<HeldExplanation>(module, "Explanation",
                                "Explains the statistic of a cell: the best path that ends there, term by term.")
        .def_property_readonly("time", member(&Explanation::seconds), "Time of the frame, s.")
        .def_property_readonly("position", member(&Explanation::position),
                               "Position of the cell, one number for each axis.")
        .def_property_readonly("statistic", member(&Explanation::statistic),
                               "Sum of all terms and the offset, nat above background.")
        .def_property_readonly("displayed", member(&Explanation::displayed),
                               "Value of Result.statistic there, in the detector's unit.")
        .def_property_readonly("threshold", member(&Explanation::threshold), "Threshold, in the detector's unit.")
        .def_property_readonly("offset", member(&Explanation::offset), "nat that all states are given alike.")
        .def_property_readonly("is_tracked", member(&Explanation::isTracked),
                               "Whether a tracker follows this cell; its path is continued without reset.")
        .def_property_readonly("is_explained_by_noise", member(&Explanation::isExplainedByNoise),
                               "On a path that is not reported: cells this strong, or runs of them, are common in "
                               "the recording's noise.")
        .def_property_readonly(
            "reset", [](const HeldExplanation &self) { return resetNames[std::size_t(self.explanation.reset.kind)]; },
            "Why the path begins where it does: 'beginning', 'background' or 'forgotten' (a track took over what came "
            "before).")
        .def_property_readonly("steps", &steps,
                               R"(The path since its last reset, a structured array with one record per frame.

Fields: t (s), f (Hz; with several axes, one field for each), rate (cells per frame), then the terms in nat: llr (λ),
ln_transition (ln P), ln_k, their running sum, and runner_up_margin, the margin over the second-best predecessor (inf if
there is no other).)")
        .def("__repr__", &explanationText);
}

} // namespace faintline::python
