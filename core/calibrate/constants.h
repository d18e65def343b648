#pragma once

#include "base/Axis.h"

#include <array>

namespace faintline {

// The numbers of calibration that were chosen: how much noise is simulated, and what of it is counted. Its effort, which
// depends on the depth, is in CalibrationEffort.cpp. A change of one changes calibrations: calibrationVersion.h.

// ---- noise ---------------------------------------------------------------------------------------------------------

inline constexpr int calibrationWindowSamples = 256; ///< of the simulated recording; noise is independent of it
inline constexpr int segmentWindows = 4096;          ///< of a segment of simulated noise
inline constexpr int settlingFrames = 300;           ///< at the start of a segment, which do not count
inline constexpr Index noiseBlockFrames = 128;       ///< size of the blocks whose maxima are kept, in frames …
inline constexpr Index noiseBlockCells = 64;         ///< … and in cells
/// A grid of more cells is simulated on a part of about so many (calibrationSubgrid).
inline constexpr Index cutFromCells = 20000;
inline constexpr Index simulatedCells = 5000;
/// Of a segment of independent cells, times frames: a sonar's hundred rates per cell add cost but little information,
/// because their paths overlap.
inline constexpr double segmentStates = 1.2e8;

// ---- K -------------------------------------------------------------------------------------------------------------

inline constexpr double lnKLimitNats = 20.0;           ///< |ln K|, at most
inline constexpr double lnKToleranceNats = 5e-4;       ///< of the bisection for half of the states
inline constexpr double lnKBracketNats = 0.01;         ///< on either side of where regulation settles
inline constexpr double lnKSecantToleranceNats = 4e-4; ///< on either side of the secant's root
inline constexpr int regulationFrames = 1500;          ///< of the noise on which K is found

// ---- exceedance and events -----------------------------------------------------------------------------------------

inline constexpr std::size_t levelCount = 2000; ///< at which the exceedance of a statistic is counted
inline constexpr double levelsInView = 300.0;   ///< of them below the largest statistic of the first frames
/// Quantiles of the maxima of blocks from which the law of these is taken, a Gumbel law.
inline constexpr double lowerMaximaQuantile = 0.5;
inline constexpr double upperMaximaQuantile = 0.95;
inline constexpr std::size_t fewestTailMaxima = 40; ///< for which that is possible
/// Block maxima above the thresholds at which events are counted, per cell and frame; after clustering and inhibition
/// a quarter of them are events. A tail from splitting is counted where events crowd each other out, at two thresholds in
/// a tenth of the noise, and where they do not (2500, 600 and 400 events in the usual 8·10⁷ cells × frames). One that is
/// extrapolated along a line is counted at two thresholds far apart.
inline constexpr std::array<double, 3> ratesBeforeSplitting{1e-3, 1.4e-4, 2e-5};
/// At the end of a block of some hundred frames; a rate of 1e-3 a frame would be a tenth of all cells.
inline constexpr std::array<double, 2> ratesOfBlocks{1e-4, 2e-5};
inline constexpr std::array<double, 2> ratesOfLine{2e-5, 2.5e-6};
/// Expected number of maxima at 2·10⁻⁵, a third of which become events of lines; in small volumes the rates are higher.
inline constexpr double expectedTailMaxima = 300.0;
inline constexpr double fewestTailEvents = 20.0; ///< from which a rate is taken
inline constexpr int crowdedEverySegments = 10;  ///< segments in which crowded events are counted: a tenth

// ---- splitting (measureRareRates.h) --------------------------------------------------------------------------------

inline constexpr int splittingReplicates = 4; ///< independent runs, whose scatter includes that of shared ancestors
inline constexpr int quantileStreams = 16;    ///< in which the first level is searched for
inline constexpr int quantileFrames = 2000;   ///< of all of them, for the base and the first level
inline constexpr double baseQuantile = 0.8;
inline constexpr double firstQuantile = 0.96;
inline constexpr double pilotFraction = 0.2; ///< that reaches the next level
/// Frames of a trial, at most; if K is so large that paths do not end, there are no rare excursions.
inline constexpr int trialLimitFrames = 3000;
inline constexpr int searchLimitFrames = 20000; ///< of a stream until the first level is entered
inline constexpr int endlessLimitPilots = 4;    ///< of the pilot trials
inline constexpr int splittingLevelLimit = 60;
inline constexpr int fewestLevelSuccesses = 10;
inline constexpr double acceptedRelativeError = 0.5; ///< of a rate
inline constexpr double acceptedDepthShare = 0.7;    ///< of leastLnRate, which must be reached with this error
inline constexpr Index narrowCells = 64;             ///< of the band of independent cells in which splitting runs
inline constexpr int narrowestBandSamples = 32;      ///< of a window for a band with two ends

// Of a detector that decides at the ends of blocks:
inline constexpr Index tiltRepetitions = 6;      ///< independent ones, whose scatter gives the errors
inline constexpr double framesOfTilt = 120000.0; ///< simulated for one tilt, all repetitions together
inline constexpr Index tiltBlockLimit = 250;     ///< of a repetition
inline constexpr Index fewestTiltBlocks = 40;
inline constexpr std::size_t tiltLimit = 30;
inline constexpr double levelSpacingDeviations = 0.25; ///< between levels, in deviations of V
inline constexpr double firstLevelDeviations = 1.0;    ///< above the mean of V

// ---- bands with two ends -------------------------------------------------------------------------------------------

/// Steps of √2 below the width from which on the ends do not meet, so that one simulation serves many widths, bins.
inline constexpr std::array<Index, 7> simulatedWidths{8, 11, 16, 23, 32, 45, 64};
/// Less than a twentieth of the false alarms is lost at the ends, as many steps away as at one bin a frame.
inline constexpr Index wideFromBins = 256;

} // namespace faintline
