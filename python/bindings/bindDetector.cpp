#include "bindings/bind.h"

#include "base/oneLine.h"
#include "bindings/arrays.h"
#include "bindings/interruptible.h"
#include "bindings/jsonFromPython.h"
#include "exchange/ModelFile.h"
#include "noise/openFrames.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

namespace faintline::python {

namespace py = pybind11;

namespace {

    using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;

    /// A detector without decisions: frames in, statistic out, as long as frames come.
    class StreamDetector
    {
    public:
        StreamDetector(std::vector<Axis> axes, const ModelFile &file)
            : m_axes(std::move(axes)), m_model(file.model), m_detector(makePathDetector(file))
        {
        }

        py::array update(const FloatArray &frame, int threads, const py::object &progress)
        {
            const auto axes = static_cast<py::ssize_t>(m_axes.size());
            if (frame.ndim() != axes && frame.ndim() != axes + 1)
                throw Error("frame",
                            "must have the shape " + shapeText() + ", or one more axis before it for several frames");
            for (py::ssize_t axis = 0; axis < axes; ++axis)
                if (frame.shape(frame.ndim() - axes + axis) != m_axes[std::size_t(axis)].count)
                    throw Error("frame", "must have the shape " + shapeText()
                                             + ", or one more axis before it for several frames");
            const std::span<const float> y(frame.data(), std::size_t(frame.size()));
            check(y);
            std::vector<float> statistic(y.size());
            const Index atOnce = std::max<Index>(1, (Index(1) << 18) / cells());
            const auto count = Index(y.size()) / cells();
            const auto work = [&](const RunContext &context) {
                m_detector->useThreads(context.threads);
                for (Index first = 0; first < count; first += atOnce) {
                    context.checkpoint(double(first) / double(count), "recursion");
                    const auto from = std::size_t(first * cells());
                    const auto size = std::size_t(std::min(atOnce, count - first) * cells());
                    m_detector->updateBlock(y.subspan(from, size), std::span(statistic).subspan(from, size), cells());
                    m_frames += std::min(atOnce, count - first);
                }
            };
            if (count > atOnce) {
                runInterruptibly({threads, progress}, work);
            } else { // too short for a thread of its own
                const py::gil_scoped_release released;
                RunContext context;
                context.threads = std::max(1, threads);
                work(context);
            }
            return arrayOf(std::move(statistic), {frame.shape(), frame.shape() + frame.ndim()});
        }

        /// Scores of all states, K's share included.
        py::array scores() const
        {
            const std::span<const float> scores = m_detector->scores();
            std::vector<float> values(scores.begin(), scores.end());
            if (const auto offset = float(m_detector->offset()); offset != 0.0f)
                for (float &value : values)
                    value += offset;
            std::vector<py::ssize_t> shape;
            for (const KinematicAxis &axis : m_model.space.axes())
                shape.push_back(axis.rateCount);
            for (const Axis &axis : m_axes)
                shape.push_back(axis.count);
            return arrayOf(std::move(values), shape);
        }

        const std::vector<Axis> &axes() const { return m_axes; }
        Index frames() const { return m_frames; }
        PathDetector::Regulation regulation() const { return m_detector->regulation(); }

    private:
        Index cells() const { return m_model.space.cellCount(); }

        void check(std::span<const float> y) const
        {
            if (m_model.likelihood.kind() != LikelihoodKind::Given)
                return checkFrameValues(y, "frame");
            if (std::any_of(y.begin(), y.end(), [](float value) { return std::isinf(value); }))
                throw Error("frame",
                            "holds infinity; log-likelihood ratios are finite, or NaN where nothing was observed");
        }

        std::string shapeText() const
        {
            const std::string text = listed(m_axes, [](const Axis &axis) { return std::to_string(axis.count); });
            return "(" + text + (m_axes.size() == 1 ? ",)" : ")");
        }

        std::vector<Axis> m_axes;
        MarkovModel m_model;
        std::unique_ptr<PathDetector> m_detector;
        Index m_frames = 0;
    };

    std::vector<Axis> axesOf(const py::object &grid)
    {
        if (py::isinstance<Axis>(grid))
            return {py::cast<Axis>(grid)};
        return py::cast<std::vector<Axis>>(grid);
    }

    /// The model's axes with what the grid says of them; log-likelihoods where no law of the signal is named.
    Json completed(Json model, const std::vector<Axis> &axes, const std::string &where)
    {
        if (!model.is_object())
            throw Error(where, "must be a dict, such as {'axes': [{'rates': [-1, 0, 1], 'rateChange': [0.8, 0.1]}], "
                               "'reset': {'lnK': -0.5}}");
        if (!model.contains("likelihood"))
            model["likelihood"] = {{"kind", "given"}};
        Json &laws = model["axes"];
        if (!laws.is_array() || laws.size() != axes.size())
            throw Error(where + ".axes",
                        "must be a list of one law for each of the grid's " + std::to_string(axes.size()) + " axes");
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const std::string law = where + ".axes[" + std::to_string(i) + "]";
            if (!laws[i].is_object())
                throw Error(law, "must be a dict, such as {'rates': [-1, 0, 1], 'rateChange': [0.8, 0.1]}");
            if (laws[i].contains("cells") && laws[i]["cells"] != axes[i].count)
                throw Error(law + ".cells", "is not the grid's " + std::to_string(axes[i].count));
            laws[i]["cells"] = axes[i].count;
            if (!laws[i].contains("cyclic"))
                laws[i]["cyclic"] = axes[i].cyclic;
        }
        return model;
    }

    std::unique_ptr<StreamDetector> makeDetector(const py::object &grid, const py::object &model)
    {
        std::vector<Axis> axes = axesOf(grid);
        std::string where = "model";
        const Json json = completed(jsonOrFile(model, where), axes, where);
        return std::make_unique<StreamDetector>(std::move(axes), modelFromJson(json, where));
    }

} // namespace

void bindDetector(py::module_ &module)
{
    py::class_<StreamDetector>(module, "Detector",
                               R"(The recursion alone, for streams and for custom likelihoods: frames in, statistic out.

    u(n, t) = λ(n, t) + max(ln K + max over m of [ln P(n|m) + u(m, t-1)], 0),    D(t, cell) = max over rates

grid: an Axis, or a list of them, slowest first.
model: a dict, or the path of a JSON file, with the keys
  "axes": one law for each axis of the grid (keys rates, ratesPerCell, rateChange, step, round, transition,
    renormalised).
  "likelihood": {"kind": "rice", "r0": 0.5}, "exponential", "swerling4" or "linear" for power whose noise has mean 1.
    The default, {"kind": "given"}, takes frames of log-likelihood ratios λ: any finite numbers, NaN for cells that
    were not observed.
  "reset": {"law": "fixed", "lnK": -0.5}, "half", "mean" or "none".
  "semiring": "max" or "sum".

Source: Billon 2005, section 3. Use one object per thread. Raises Error with the name of the key.)")
        .def(py::init(&makeDetector), py::arg("grid"), py::arg("model"))
        .def("update", &StreamDetector::update, py::arg("frame"), py::kw_only(), py::arg("threads") = 1,
             py::arg("progress") = py::none(),
             R"(Processes one frame, an array of the grid's shape, or several along an additional first axis.

Returns the statistic, float32 of that shape. The result does not depend on the number of frames per call or on the
number of threads. Raises Error for an invalid shape or value.)")
        .def_property_readonly("axes", &StreamDetector::axes)
        .def_property_readonly("frames", &StreamDetector::frames, "Number of frames processed.")
        .def_property_readonly("scores", &StreamDetector::scores,
                               "Scores of all states, float32 of shape (rates…, cells…), nat above background.")
        .def_property_readonly(
            "ln_k", [](const StreamDetector &self) { return self.regulation().lnK; },
            "ln K of the last frame, by the reset law, nat.")
        .def_property_readonly(
            "continued_fraction", [](const StreamDetector &self) { return self.regulation().continuedFraction; },
            "Fraction of the states whose path was continued in the last frame instead of being reset.");
}

} // namespace faintline::python
