#include "bindings/bind.h"

#include "analyse/columns.h"
#include "bindings/HeldTrack.h"
#include "bindings/arrays.h"

#include <algorithm>

namespace faintline::python {

namespace py = pybind11;

namespace {

    /// A number of every reported point.
    template <class Take>
    py::array_t<double> ofPoints(const HeldTrack &self, const Take &take)
    {
        std::vector<double> values;
        for (const std::size_t i : self.track().presentPoints())
            values.push_back(take(i));
        return arrayOf(std::move(values));
    }

    /// A column of the command line's tracks, at every reported point.
    auto column(const char *name)
    {
        return [name = std::string(name)](const HeldTrack &self) {
            const auto columns = trackColumns(self.analysis->grid(), {.secondPass = true});
            const auto named = std::ranges::find_if(columns, [&](const auto &each) { return each.name == name; });
            return ofPoints(self, [&](std::size_t i) {
                return named->number({self.analysis.get(), &self.track(), i});
            });
        };
    }

    py::array lastPositions(const HeldTrack &self)
    {
        const Axis &axis = self.analysis->grid().axes.back();
        return ofPoints(self, [&](std::size_t i) { return axis.value(self.track().lastPosition(i, axis)); });
    }

    py::array positions(const HeldTrack &self)
    {
        const Grid &grid = self.analysis->grid();
        std::vector<double> values;
        const std::vector<std::size_t> present = self.track().presentPoints();
        for (const std::size_t i : present)
            for (const double position : self.track().positionOf(i, grid))
                values.push_back(position);
        return arrayOf(std::move(values), {std::ssize(present), std::ssize(grid.axes)});
    }

    template <class T>
    auto member(T Track::*which)
    {
        return [which](const HeldTrack &self) { return self.track().*which; };
    }

    auto seconds(Index Track::*which)
    {
        return [which](const HeldTrack &self) { return self.analysis->time().value(double(self.track().*which)); };
    }

    std::string trackText(const HeldTrack &self)
    {
        return py::str("<faintline.Track {}: {} points, {:g} … {:g} s>")
            .format(self.track().id, self.track().presentPoints().size(), seconds(&Track::onsetFrame)(self),
                    seconds(&Track::endFrame)(self));
    }

} // namespace

void bindTrack(py::module_ &module)
{
    py::class_<HeldTrack>(
        module, "Track",
        R"(One detected signal, followed from its onset to its end: one point for each frame in which it is present.

f05, f95, p_present and snr_db come from the second pass (forward and backward). They are NaN for tracks without one:
for frames with several axes, for the linear likelihood, and with both_ways=False.)")
        .def_property_readonly("id", member(&Track::id), "Number of the event, as in events['event'].")
        .def_property_readonly("t", column("t"), "Times of the points, s.")
        .def_property_readonly("f", &lastPositions,
                               "Positions along the last axis, to a fraction of a cell if known; Hz for recordings.")
        .def_property_readonly("position", &positions, "Positions on all axes, float64 of shape (points, axes).")
        .def_property_readonly("statistic", column("statistic"),
                               "Score of the path up to each point, nat above background.")
        .def_property_readonly("f05", column("f_low"), "5 % of the position's posterior.")
        .def_property_readonly("f95", column("f_high"), "95 % of the position's posterior.")
        .def_property_readonly("p_present", column("presence"), "Probability that the signal is present.")
        .def_property_readonly("snr_db", column("snr_db"),
                               "Mean power along the path over the noise's in one frame, dB.")
        .def_property_readonly("t_onset", seconds(&Track::onsetFrame), "s")
        .def_property_readonly("t_detect", seconds(&Track::detectFrame),
                               "Time at which the statistic first exceeded the threshold, s.")
        .def_property_readonly("t_end", seconds(&Track::endFrame), "s")
        .def_property_readonly("peak_statistic", member(&Track::peakStatistic), "Largest score of the path, nat.")
        .def_property_readonly("confirmed", member(&Track::isConfirmed))
        .def_property_readonly("open", member(&Track::isOpen),
                               "Whether the track was still followed when the data ended.")
        .def_property_readonly("model", member(&Track::model),
                               "Index in the bank of the model that detected the signal; the track may change it.")
        .def("__len__", [](const HeldTrack &self) { return self.track().presentPoints().size(); })
        .def("__repr__", &trackText);
}

} // namespace faintline::python
