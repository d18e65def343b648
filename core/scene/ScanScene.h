#pragma once

#include "base/Grid.h"
#include "base/json.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

enum class ScanMoves {
    Uniform, ///< to any existing cell within one, with equal probability
    Gaussian ///< a discretised Gaussian step, restricted to existing cells
};
inline constexpr std::array<std::string_view, 2> scanMovesNames{"uniform", "gaussian"};

/// A surveillance radar's look into one sector: consecutive scans (stages) of azimuth × elevation × range × Doppler
/// cells.
///
/// A cell is exponential, of mean 1 on noise and 1 + SNR where the target is. The target starts anywhere and moves over
/// azimuth, elevation and range without leaving them; its Doppler cell is uniform and independent at each stage
/// (ambiguous). Source: Grossi and Lops 2006, section 4.
struct ScanScene {
    int azimuthCells = 3;
    int elevationCells = 3;
    int rangeCells = 100;
    int dopplerCells = 16;
    int stages = 20;
    bool hasTarget = true;
    double snrDb = 12.0; ///< mean power of the target over the noise in its cell
    ScanMoves moves = ScanMoves::Uniform;
    double moveCells = 0.5; ///< Gaussian: standard deviation of a step along each axis, cells
    double secondsPerStage = 1.0;
    int seed = 1;

    static const std::vector<Field<ScanScene>> &fields();
    bool operator==(const ScanScene &) const = default;
};

/// Cell of a target at a stage: azimuth, elevation, range, Doppler.
using ScanCell = std::array<Index, 4>;

/// Checks the ranges, and that a scan has at most 2²⁸ cells. Throws Error naming the key.
void checkScene(const ScanScene &scene);

/// Reads a scene from {"kind": "scans", …}. Unknown keys are errors; missing ones take their defaults. Throws Error.
ScanScene scanSceneFromJson(const Json &json);

Json toJson(const ScanScene &scene);

/// Axes of a scan, range and Doppler last.
Grid scanGrid(const ScanScene &scene);

/// The target's cells at all stages of a run; empty without a target. A pure function of (seed, run).
std::vector<ScanCell> scanTrajectory(const ScanScene &scene, int run = 0);

/// Writes the scan of a stage, scanGrid().size() values, for the run's trajectory. A pure function of (seed, run,
/// stage).
void readScan(const ScanScene &scene, const std::vector<ScanCell> &trajectory, int run, Index stage,
              std::span<float> y);

/// {"snrDb": …, "axes": […], "cells": [[azimuth, elevation, range, Doppler] per stage]}
Json scanTruth(const ScanScene &scene, const std::vector<ScanCell> &trajectory);

} // namespace faintline
