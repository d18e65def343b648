#pragma once

#include "base/Grid.h"
#include "base/json.h"
#include "detect/Smd.h"
#include "model/SequentialModel.h"

#include <memory>
#include <string>

namespace faintline {

/// A model and its reset rule from a JSON file.
///
///   { "axes": [ { "name", "cells", "cyclic", "rates": [-2, …, 2], "ratesPerCell", "rateChange": [h(0), h(1), …],
///                 "step": [q(0), …], "round": "halfDown" | "trunc", "renormalised": bool } ],
///     "likelihood": { "kind": "rice" | "exponential" | "linear" | "given", "r0" | "snr" },
///     "reset": { "law": "fixed" | "mean" | "half" | "none", "lnK", "K0" }, "initial": "uniform",
///     "semiring": "max" | "sum", "scaleTransitions": bool }
///
/// All keys except axes and likelihood are optional. Rates are integer multiples of 1/ratesPerCell cell per step.
struct ModelFile {
    MarkovModel model;
    ResetRule reset;
    bool isSum = false; ///< semiring "sum": log-sum-exp instead of max
};

/// The detector for such a file: the maximum over paths, or the sum.
std::unique_ptr<PathDetector> makePathDetector(const ModelFile &file);

/// Throws Error naming the file and the key.
ModelFile readModelFile(const std::string &path);

/// Reads the model from such an object; `where` precedes the keys in errors.
ModelFile modelFromJson(const Json &json, const std::string &where);

/// Reads the motion of one coordinate from an element of "axes". Throws Error naming `where.key`.
KinematicAxis kinematicAxisFromJson(const Json &json, const std::string &where);

/// The same file for a sequential test, which has no reset (the key is checked but not used), with additional values:
///
///   axes      "step": "uniform-admissible" | {"gaussian": σ in cells}, both renormalised over the existing cells
///             "integrate": true for an axis of the frames without a state
///             "transition": [[P(from, to)]] instead of a law
///   initial   [P(x1) of each state]
///
/// readModelFile accepts these steps and the matrix as well. Throws Error, also if the cells do not match those of the
/// frames, if known, and before allocating anything of a size that the file specifies.
struct FrameCells {
    std::string path;
    std::vector<Index> cells; ///< for each axis
};
SequentialModel readSequentialModel(const std::string &path, const FrameCells *frames = nullptr);

} // namespace faintline
