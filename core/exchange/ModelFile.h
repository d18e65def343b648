#pragma once

#include "base/Grid.h"
#include "base/json.h"
#include "detect/Smd.h"
#include "model/SequentialModel.h"
#include "spectrum/NormalisedFrames.h"

#include <memory>
#include <span>
#include <string>

namespace faintline {

/// A model and its reset rule as read from a JSON file.
///
///   { "axes": [ { "name", "cells", "cyclic", "rates": [-2, …, 2], "ratesPerCell", "rateChange": [h(0), h(1), …],
///                 "step": [q(0), …], "round": "halfDown" | "trunc", "renormalised": bool } ],
///     "likelihood": { "kind": "rice" | "exponential" | "linear" | "given", "r0" | "snr" },
///     "reset": { "law": "fixed" | "mean" | "half" | "none", "lnK", "K0" }, "initial": "uniform",
///     "semiring": "max" | "sum", "scaleTransitions": bool }
///
/// Every key but axes and likelihood may be left out. Rates are whole multiples of 1/ratesPerCell cell per step.
struct ModelFile {
    MarkovModel model;
    ResetRule reset;
    bool isSum = false; ///< semiring "sum": log-sum-exp instead of max
};

/// The detector of such a file: the maximum over paths, or the sum.
std::unique_ptr<PathDetector> makePathDetector(const ModelFile &file);

/// Throws Error naming the file and the key.
ModelFile readModelFile(const std::string &path);

/// The model of such an object; `where` stands before the keys in what is thrown.
ModelFile modelFromJson(const Json &json, const std::string &where);

/// How one coordinate moves, from an object as "axes" holds them. Throws Error naming `where.key`.
KinematicAxis kinematicAxisFromJson(const Json &json, const std::string &where);

/// The same file for a sequential test, which knows no reset (the key is checked and not used) and more of these:
///
///   axes      "step": "uniform-admissible" | {"gaussian": σ in cells}, both shared out among the cells that exist
///             "integrate": true, an axis of the frames without a state
///             "transition": [[P(from, to)]] in place of a law
///   initial   [P(x1) of every state]
///
/// readModelFile takes the steps and the matrix as well. Throws Error; also where the cells are not those of the
/// frames, if these are known, and before anything is made as large as the file says.
struct FrameCells {
    std::string path;
    std::vector<Index> cells; ///< of every axis
};
SequentialModel readSequentialModel(const std::string &path, const FrameCells *frames = nullptr);

/// Ready-made frames in double precision, cell after cell, stage after stage, checked as readFrames does.
struct DoubleFrames {
    std::vector<Index> shape; ///< stages, cells…
    std::vector<double> values;
};
DoubleFrames readDoubleFrames(const std::string &path);

/// Grid and time axis of a stack of frames: { "axes": [ { "name", "unit", "first", "step", "count", "cyclic" } ],
/// "time": { "first", "step" }, "values": "normalised" | "power" }; count may be left out where the frames tell it.
/// Throws Error.
struct GridFile {
    Grid grid;
    Axis time;
    bool isPower = false; ///< of a spectrogram in a unit of its own, which is not normalised yet
};
GridFile readGridFile(const std::string &path, const std::vector<Index> &shape);

/// A grid file's text, as readGridFile takes it.
std::string gridFileText(const GridFile &file);

/// Throws Error naming `where` for values that are negative or infinite.
void checkFrameValues(std::span<const float> values, const std::string &where);

/// Ready-made frames from a NumPy file of shape (frames, cells…); `grid` may be empty (axes without units). Values that
/// are negative or infinite are refused; NaN stands for a cell that was not observed.
NormalisedFramesPointer readFrames(const std::string &path, const std::string &gridPath);

} // namespace faintline
