#pragma once

#include "base/Axis.h"

namespace faintline {

// The numbers of refinement that were chosen and are no settings. Cells are resolution cells, levels are signal power over
// the noise's. Where no derivation is given, none is known.

// ---- a signal's own power ------------------------------------------------------------------------------------------

/// On either side of a position, within which a signal's largest power lies: ½ cell and half a bin of ½ cell.
inline constexpr double ownPowerCells = 0.75;
/// Of what is explained: its power is constant, not exponential, so that 3 dB too little must not gather evidence.
inline constexpr double explainedPowerFactor = 2.0;
inline constexpr double negligiblePowerRatio = 0.02; ///< to the noise, below which a floor is not raised
inline constexpr double steadyCellsPerFrame = 0.1;   ///< up to which a signal's exact leakage is known
inline constexpr float rareNoisePower = 7.0f;        ///< noise exceeds it in one of 1000 cells
inline constexpr double notchCells = 1.0; ///< on either side, within which a subtracted line leaves less than noise
inline constexpr Index explainedBlockFrames = 64;     ///< of a table of signals by time
inline constexpr double leakageEntriesPerCell = 16.0; ///< of a table of leakage …
inline constexpr double leakageCells = 4096.0;        ///< … up to that distance

// ---- presence and position -----------------------------------------------------------------------------------------

inline constexpr double corridorCells = 3.0;   ///< on either side of a path
inline constexpr Index levelHalfFrames = 12;   ///< on either side of a frame, over which its level is measured
inline constexpr double leastChangeNats = 2.0; ///< cost of an onset or end, even with a low threshold
inline constexpr double leastLevelRatio = 0.5; ///< for which evidence of presence is computed …
inline constexpr double keyedLevelRatio = 4.0; ///< … and the largest one for what is one track, so that a keyed line is
inline constexpr double anyLevelRatio = 1e9;   ///< as large as any
inline constexpr double singleFrameLevelRatio = 10.0; ///< from which a frame and its neighbours tell the position
inline constexpr double positionHalfFrames = 8.0;     ///< over which that of a faint signal is averaged, on either side
inline constexpr Index endSlopeFrames = 24;           ///< at either end, with whose slope a path goes on
inline constexpr double strongNatsPerFrame = 2.0;     ///< from which a track has skirts to be read
inline constexpr Index piecesFromFrames = 4096;       ///< of a track; longer ones are refined in pieces …
inline constexpr Index pieceOverlapFrames = 64;       ///< … that also see so much of their neighbours
inline constexpr Index pauseFrames = 24;              ///< between stretches of one signal, at most
inline constexpr double ghostStatisticShare =
    0.08; ///< of a statistic, below which what is left over the floor is a ghost

// ---- behind stronger signals ---------------------------------------------------------------------------------------

inline constexpr double hiddenCells = 1.0;         ///< beside a signal, in which nothing else can be seen
inline constexpr double hidingNatsPerFrame = 0.05; ///< lost there beyond what a path loses in noise
inline constexpr double raisedFloorRatio = 1.5;    ///< from which a cell may have been hidden from the first run …
inline constexpr double hiddenPointsShare = 0.5;   ///< … and of such points, from which a track was
inline constexpr int mostPassesBehind = 3;

// ---- surroundings --------------------------------------------------------------------------------------------------

inline constexpr double besideFromCells = 2.5; ///< beyond the main lobe of any window
inline constexpr double besideToCells = 7.0;
inline constexpr Index besideReachFrames[] = {6, 24, 72}; ///< on either side
inline constexpr Index valuesPerReach = 6;                ///< of levels
inline constexpr double besideQuantile = 0.35;            ///< lines may occupy the cells above it
inline constexpr double chanceDeviations = 1.5;           ///< of a level that chance may contribute
inline constexpr double informativeFramesPerWindow = 2.0; ///< more frames add hardly any information
inline constexpr std::size_t fewestAreaValues = 8;
inline constexpr Index areaSampledFrames = 256; ///< of a piece of time
inline constexpr double flankFromCells = 1.5;   ///< half a main lobe, beyond what a path moves
inline constexpr double flankCells = 2.0;
inline constexpr Index longestRunFrames = 32;      ///< as long as those of NoiseSample
inline constexpr double medianDeviations = 0.6745; ///< median magnitude of a normal value, in standard deviations
inline constexpr double shapeError = 2.33;         ///< times √N, relative: twice that of such a median
inline constexpr double pairsAlike = 1.5;          ///< that count as one, because each shares a mean with the next
inline constexpr double fewestPairs = 4.0;
inline constexpr Index fewestMeans = 6;         ///< of which onset and end of a signal beside change two of five pairs
inline constexpr double lineBandCells = 2.2;    ///< of the 5-95 % band of a line at 0 dB or more
inline constexpr double strongLevelRatio = 4.0; ///< from which no track is taken for a spread one
inline constexpr double slowLawProbability = 0.8; ///< h(0), from which a law is one of lines

// ---- the recording's own noise -------------------------------------------------------------------------------------

inline constexpr double noiseSampleValues = 4e6;
inline constexpr double maskedCells = 4.0;          ///< on either side of a track
inline constexpr Index maskedFrames = 2;            ///< before and after each of its points …
inline constexpr Index maskedFramesBeyond = 10;     ///< … and before and after all
inline constexpr double leastObservedShare = 0.2;   ///< of a bin's frames
inline constexpr double lineMedianRatio = 1.1;      ///< of the median of a bin with a steady line to that of noise
inline constexpr Index mostLawParts = 16;           ///< of the band
inline constexpr Index fewestLawCells = 40;         ///< of a part
inline constexpr std::size_t fewestLawValues = 500; ///< of a part
inline constexpr std::ptrdiff_t fewestQuantileValues = 60; ///< beyond a quantile
inline constexpr double valuesAlike = 4.0;                 ///< that count as one, because windows and bins overlap
inline constexpr double sureLawDeviations = 3.0;           ///< from the assumed law
inline constexpr double quantileErrorShare = 0.03;         ///< up to which quantiles are as assumed …
inline constexpr double runErrorShare = 0.05;              ///< … and variances of runs
inline constexpr float leastTailSlope = 0.05f;             ///< dg/dy beyond the last quantile
inline constexpr float runPowerLimit = 5.0f;               ///< of powers from which runs are measured
inline constexpr Index fewestRunMeans = 60;
inline constexpr double leastNoiseShare = 0.5; ///< of a part's cells, to measure runs

// ---- identities ----------------------------------------------------------------------------------------------------

inline constexpr double followedShare = 0.8;        ///< of a track's frames, from which it lies on a path
inline constexpr double onPathCells = 1.0;          ///< within which a position lies on a path
inline constexpr double comparableLevelRatio = 4.0; ///< 6 dB
inline constexpr double meetingCells = 3.0;         ///< from where on two tracks do not meet
inline constexpr double pathsApartCells = 1.5;      ///< from where on two paths are not the flanks of one line
inline constexpr double jointDesignLevelRatio = 4.0;
inline constexpr double leastJointLevelRatio = 2.0;
inline constexpr Index togetherSlopeLengths = 4; ///< of m, the frames over which a slope is measured
inline constexpr double encounterCells = 1.8;
inline constexpr double endNearCells = 3.0;
inline constexpr std::size_t fewestRunPoints = 4; ///< of an approach
inline constexpr double approachInEndNears = 1.5; ///< of endNear: from there on, an end beside a track was an approach
inline constexpr double joinedSlopeLengths = 0.7; ///< of m, between encounters that are one
inline constexpr Index gapSlopeLengths = 8;       ///< of m, between pieces of one signal, at most
inline constexpr int fitLengthOctaves = 3;        ///< m, 2 m, 4 m
inline constexpr Index fewestPieceFrames = 4;
inline constexpr double crossingHidesCells = 2.5;    ///< within which of a track another signal is not to be seen
inline constexpr double knownWayCells = 0.5;         ///< deviation up to which the way of a lost track is known
inline constexpr double leastErrorCells = 0.05;      ///< of a position
inline constexpr double changedPositionCells = 0.35; ///< standard deviation over a gap …
inline constexpr double changedLevelDb = 3.0;        ///< … and that of the level
inline constexpr double ownWayThresholds = 0.9;      ///< of T, cost of a track's own way, at most
inline constexpr Index seenWithinFrames = 12;        ///< of a bridge

// ---- positions as frequencies --------------------------------------------------------------------------------------

inline constexpr double correlatedFrames = 6.0; ///< over which errors of positions are alike
inline constexpr int highestOvertone = 16; ///< of a source, whose overtones are one call
inline constexpr double curvatureDeviations = 3.0;
inline constexpr std::size_t fewestCurvatureFrames = 8;
inline constexpr double smoothedFrames = 32.0; ///< period that is halved, of usual signals
inline constexpr double shortestPeriodFrames = 2.0;
inline constexpr double mostSmoothedFrames = 4096.0;
inline constexpr double subtractedEndWindows = 4.0;
inline constexpr double subtractedSmoothWindows = 4.0; ///< period of variations that are halved

} // namespace faintline
