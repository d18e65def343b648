#include "bindings/bind.h"

#include "base/logmath.h"
#include "bindings/HeldTrack.h"
#include "bindings/arrays.h"

#include <limits>

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

    /// A number of what the look from both ends knows of every point, NaN of tracks that were not looked at so.
    template <class Take>
    auto smoothed(const Take &take)
    {
        return [take](const HeldTrack &self) {
            const Track &track = self.track();
            const Axis &axis = self.analysis->grid().axes.back();
            return ofPoints(self, [&](std::size_t i) {
                return track.smoothed.empty() ? std::numeric_limits<double>::quiet_NaN()
                                              : take(track.smoothed[i], axis);
            });
        };
    }

    py::array times(const HeldTrack &self)
    {
        return ofPoints(
            self, [&](std::size_t i) { return self.analysis->time().value(double(self.track().points[i].frame)); });
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
        .def_property_readonly("t", &times, "Times of the points, s.")
        .def_property_readonly("f", &lastPositions,
                               "Positions along the last axis, to a fraction of a cell if known; Hz for recordings.")
        .def_property_readonly("position", &positions, "Positions on all axes, float64 of shape (points, axes).")
        .def_property_readonly(
            "statistic",
            [](const HeldTrack &self) {
                return ofPoints(self, [&](std::size_t i) { return self.track().points[i].statistic; });
            },
            "Score of the path up to each point, nat above background.")
        .def_property_readonly(
            "f05", smoothed([](const SmoothedPoint &p, const Axis &axis) { return axis.value(double(p.low)); }),
            "5 % of the position's posterior.")
        .def_property_readonly(
            "f95", smoothed([](const SmoothedPoint &p, const Axis &axis) { return axis.value(double(p.high)); }),
            "95 % of the position's posterior.")
        .def_property_readonly("p_present",
                               smoothed([](const SmoothedPoint &p, const Axis &) { return double(p.presence); }),
                               "Probability that the signal is present.")
        .def_property_readonly(
            "snr_db", smoothed([](const SmoothedPoint &p, const Axis &) { return dbFromRatio(double(p.level)); }),
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
