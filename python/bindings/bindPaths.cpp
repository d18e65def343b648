#include "bindings/bind.h"

#include "bindings/arrays.h"
#include "bindings/interruptible.h"
#include "bindings/jsonFromPython.h"
#include "detect/MapTrajectory.h"
#include "exchange/ModelFile.h"
#include "recursion/ForwardBackward.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline::python {

namespace py = pybind11;

namespace {

    using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

    KinematicAxis axisOfMatrix(const DoubleArray &matrix, Index cells, const std::string &where)
    {
        if (matrix.ndim() != 2 || matrix.shape(0) != cells || matrix.shape(1) != cells)
            throw Error(where, "must have the shape (" + std::to_string(cells) + ", " + std::to_string(cells)
                                   + "): P(from, to)");
        KinematicAxis axis;
        axis.cells = cells;
        axis.transition.assign(matrix.data(), matrix.data() + matrix.size());
        axis.check(where);
        return axis;
    }

    KinematicAxis axisOf(const py::handle &law, Index cells, const std::string &where)
    {
        if (py::isinstance<py::array>(law))
            return axisOfMatrix(DoubleArray::ensure(law), cells, where);
        Json json = jsonFromPython(law, where);
        if (!json.is_object())
            throw Error(where, "must be a dict, such as {'rates': [-1, 0, 1], 'rateChange': [0.8, 0.1]} or {'step': "
                               "[0.6, 0.2]}, or a matrix P(from, to)");
        if (json.contains("cells") && json["cells"] != cells)
            throw Error(where + ".cells", "is not the log-likelihoods' " + std::to_string(cells));
        json["cells"] = cells;
        return kinematicAxisFromJson(json, where);
    }

    /// Log-likelihoods and the transition law of paths.
    struct Lattice {
        StateSpace space;
        std::vector<double> lambda;  ///< frames × cells
        std::vector<double> initial; ///< of every state
        Index frames = 0;
    };

    std::vector<double> lambdaOf(const DoubleArray &logLikelihood)
    {
        std::vector<double> lambda(logLikelihood.data(), logLikelihood.data() + logLikelihood.size());
        for (double &value : lambda) {
            if (value == std::numeric_limits<double>::infinity())
                throw Error("loglik",
                            "contains +inf; log-likelihoods must be finite, -inf for impossible cells, or NaN "
                            "for cells that were not observed");
            if (std::isnan(value))
                value = 0.0;
        }
        return lambda;
    }

    std::vector<double> initialOf(const py::object &given, const StateSpace &space)
    {
        const auto states = std::size_t(space.stateCount());
        const auto cells = std::size_t(space.cellCount());
        if (given.is_none())
            return std::vector<double>(states, 1.0 / double(states));
        const auto array = DoubleArray::ensure(given);
        if (!array || (std::size_t(array.size()) != states && std::size_t(array.size()) != cells))
            throw Error("initial", "must contain the probability of each of the " + std::to_string(cells)
                                       + " cells, or of each of the " + std::to_string(states) + " states");
        std::vector<double> initial(states);
        const auto size = std::size_t(array.size());
        const double share = double(size) / double(states); // of a cell's probability for each of its rates
        for (std::size_t n = 0; n < states; ++n)
            initial[n] = array.data()[n % size] * share;
        if (!std::all_of(initial.begin(), initial.end(), [](double p) { return p >= 0.0 && p <= 1.0; }))
            throw Error("initial", "contains a value that is not a probability");
        return initial;
    }

    Lattice latticeOf(const DoubleArray &logLikelihood, const py::object &law, const py::object &initial)
    {
        if (logLikelihood.ndim() < 2 || logLikelihood.size() == 0)
            throw Error("loglik", "must have the shape (frames, cells…) with at least one of each");
        const auto axes = std::size_t(logLikelihood.ndim() - 1);
        const bool isList = py::isinstance<py::list>(law) || py::isinstance<py::tuple>(law);
        const py::list laws = isList ? py::list(law) : py::list(py::make_tuple(law));
        if (laws.size() != axes)
            throw Error("law",
                        "must be one law for each of the log-likelihoods' " + std::to_string(axes) + " cell axes");
        std::vector<KinematicAxis> motion;
        for (std::size_t i = 0; i < axes; ++i)
            motion.push_back(axisOf(laws[i], logLikelihood.shape(static_cast<py::ssize_t>(i + 1)),
                                    isList ? "law[" + std::to_string(i) + "]" : "law"));
        Lattice lattice{StateSpace(std::move(motion)), lambdaOf(logLikelihood), {}, logLikelihood.shape(0)};
        lattice.initial = initialOf(initial, lattice.space);
        return lattice;
    }

    /// The most probable path, as returned to Python.
    struct Path {
        py::array cells;
        py::array rates;
        double score = 0.0;
    };

    Path pathOf(const Lattice &lattice, const MapTrajectory &map)
    {
        const auto axes = lattice.space.axes().size();
        std::vector<std::int64_t> cells;
        std::vector<double> rates;
        for (const Index state : map.states) {
            for (const Index cell : lattice.space.coordinates(state).cells)
                cells.push_back(cell);
            for (const double rate : lattice.space.ratesOfPlane(lattice.space.planeOf(state)))
                rates.push_back(rate);
        }
        std::vector<py::ssize_t> shape{lattice.frames};
        if (axes > 1)
            shape.push_back(static_cast<py::ssize_t>(axes));
        return {arrayOf(std::move(cells), shape), arrayOf(std::move(rates), shape), map.lnScore};
    }

    Path viterbi(const DoubleArray &logLikelihood, const py::object &law, const py::object &initial,
                 const py::object &progress)
    {
        const Lattice lattice = latticeOf(logLikelihood, law, initial);
        SequentialModel model;
        model.markov = {lattice.space, Likelihood(LikelihoodKind::Given), 1.0};
        model.initial = lattice.initial;
        const auto cells = std::size_t(lattice.space.cellCount());
        MapTrajectory map;
        runInterruptibly({1, progress}, [&](const RunContext &context) {
            MapEstimator estimator(model);
            const auto evidence = [&](Index stage, std::span<double> lambda) {
                std::copy_n(lattice.lambda.begin() + Index(cells) * stage, cells, lambda.begin());
            };
            map = estimator.estimate(lattice.frames, evidence, context);
        });
        if (!std::isfinite(map.lnScore))
            throw Error("log-likelihoods and law", "allow no path with a probability above 0");
        return pathOf(lattice, map);
    }

    struct HeldPosterior {
        py::array states;
        py::array cells;
        double logEvidence = 0.0;
    };

    HeldPosterior forwardBackwardOf(const DoubleArray &logLikelihood, const py::object &law, const py::object &initial,
                                    const py::object &progress)
    {
        const Lattice lattice = latticeOf(logLikelihood, law, initial);
        Posterior posterior;
        std::vector<double> ofCells(lattice.lambda.size(), 0.0);
        runInterruptibly({1, progress}, [&](const RunContext &context) {
            posterior = forwardBackward(lattice.space, lattice.initial, lattice.lambda, context);
            const Index cells = lattice.space.cellCount();
            const Index states = lattice.space.stateCount();
            for (Index i = 0; i < std::ssize(posterior.probability); ++i)
                ofCells[std::size_t(i / states * cells + i % states % cells)] += posterior.probability[std::size_t(i)];
        });
        std::vector<py::ssize_t> shape{lattice.frames};
        for (const KinematicAxis &axis : lattice.space.axes())
            shape.push_back(axis.rateCount);
        for (const KinematicAxis &axis : lattice.space.axes())
            shape.push_back(axis.cells);
        return {arrayOf(std::move(posterior.probability), shape),
                arrayOf(std::move(ofCells), {logLikelihood.shape(), logLikelihood.shape() + logLikelihood.ndim()}),
                posterior.lnEvidence};
    }

    constexpr const char *viterbiText =
        R"(Finds the most probable path through log-likelihoods with a given transition law.

    F(t, n) = loglik(t, n) + max over m of [F(t-1, m) + ln P(n|m)],    F(0, n) = loglik(0, n) + ln initial(n)

loglik: shape (frames, cells…), log-likelihoods or ratios of them; -inf for impossible cells, NaN for cells that were
not observed.
law: the motion of a state along the cells, a dict; with several axes, a list of dicts:
  {"rates": [-1, 0, 1], "rateChange": [h0, h1]}: states of cell and rate; r' = r ± i with probability h_i, moved by the
    mean of both rates ("ratesPerCell": q for rates in 1/q cell per frame);
  {"step": [q0, q1]}: a random walk;
  "cyclic": True for an axis that wraps;
  "renormalised": True to distribute the probability of moves off the ends over the others instead of losing it;
  or a matrix P(from, to).
initial: probability of every cell, or of every state (rates…, cells…); None for uniform.

Returns a Path: cells, int64 of shape (frames,), with several axes (frames, axes); rates, cells per frame; score, ln of
the path's probability with its evidence. Ties are resolved to the lowest state. Computed in double precision. The law
is never expanded to a matrix, so a frame costs states × moves.

Source: Viterbi 1967; Grossi and Lops 2006, Algorithm 3.2. Raises Error if no path is possible.)";

    constexpr const char *forwardBackwardText =
        R"(Computes the posterior of every cell in every frame, given all frames.

loglik, law, initial: as for faintline.viterbi.

Returns a Posterior: p, float64 of the shape of loglik, which sums to 1 in each frame; p_states, the same for every
state (frames, rates…, cells…); log_evidence, ln of the sum over all paths. Computed in logarithms.

Source: Baum and others 1970. Raises Error if no path is possible.)";

} // namespace

void bindPaths(py::module_ &module)
{
    py::class_<Path>(module, "Path", "The most probable path (faintline.viterbi).")
        .def_readonly("cells", &Path::cells, "int64 of shape (frames,), with several axes (frames, axes).")
        .def_readonly("rates", &Path::rates, "Cells per frame, float64 of the same shape.")
        .def_readonly("score", &Path::score, "ln of the path's probability with its evidence.");
    py::class_<HeldPosterior>(module, "Posterior",
                              "Posterior of the position, given all frames (faintline.forward_backward).")
        .def_readonly("p", &HeldPosterior::cells, "float64 of shape (frames, cells…) with a sum of 1 in each frame.")
        .def_readonly("p_states", &HeldPosterior::states, "float64 of shape (frames, rates…, cells…).")
        .def_readonly("log_evidence", &HeldPosterior::logEvidence, "ln of the sum over all paths.");
    module.def("viterbi", &viterbi, py::arg("loglik"), py::arg("law"), py::kw_only(), py::arg("initial") = py::none(),
               py::arg("progress") = py::none(), viterbiText);
    module.def("forward_backward", &forwardBackwardOf, py::arg("loglik"), py::arg("law"), py::kw_only(),
               py::arg("initial") = py::none(), py::arg("progress") = py::none(), forwardBackwardText);
}

} // namespace faintline::python
