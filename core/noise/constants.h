#pragma once

#include "base/Axis.h"

#include <numbers>

namespace faintline {

// The numbers of the estimate of noise that were chosen, and do not follow from the law of exponential power. The
// settings (NoiseNormaliser.h, pings/PingNoise.h) hold those that users choose: 48 windows a block, 41 cells of the
// running median. Sizes of buffers, and numbers of samples that suffice, stand where they are used.

// ---- one frame -----------------------------------------------------------------------------------------------------

/// √n times the standard deviation of the logarithm of the median of n exponential cells: 1/ln 2, rounded.
inline constexpr double inverseLn2 = 1.44;
/// Power over the noise's from which on a cell is left out of a mean, or is cut to it, so that a line or a burst cannot
/// raise it: noise exceeds it in 0.7 % of cells, and the mean of the others gives the mean of all (truncatedMean).
inline constexpr float lineLimit = 5.0f;
/// Neighbouring cells that count as one, because the window's main lobe correlates them.
inline constexpr double cellsAlike = 1.5;
/// Half the window, in cells, of the running median that recognises a click: 41 cells, as for the colour.
inline constexpr Index clickHalfWidthCells = 20;
/// Cells at the ends of a sequence that define the point of its reflection there.
inline constexpr Index pivotCells = 5;
/// Rounding error of the single-precision transform, relative to the frame's strongest bin; values below it are not
/// noise.
inline constexpr double roundingFloor = 1e-13;
inline constexpr double roundingMarginLn = 4.0; ///< ln above the floor from which a cell tells the level of the band …
inline constexpr double roundingNearnessLn = 0.1; ///< … and from which it is used at all

// ---- blocks --------------------------------------------------------------------------------------------------------

/// Blocks on either side with which a block's colour is averaged while the noise is steady; of the past alone, those
/// before it. As many tell what lines add to a level, and are fitted with sources together.
inline constexpr Index steadyBlocks = 6;
/// Deviation of the noise's own shape from its running median, as a factor: a cell within it holds no line.
inline constexpr double leastNoiseRatio = 1.3;
inline constexpr double fewestRatioCells = 3.0; ///< from which the mean ratio to the running median is taken
/// Frames per window from which levels are measured, at most.
inline constexpr Index levelFramesPerWindow = 4;
/// Difference of the levels of adjacent sub-bands from which the level changes abruptly half-way, as at the edge of a
/// receiver's band: 20 dB.
inline constexpr float abruptLevelLn = 4.6f;
/// B: an excess ε of y multiplies the rate of false alarms by e^(Bε).
inline constexpr double alarmsPerExcess = 30.0;

// ---- levels --------------------------------------------------------------------------------------------------------

inline constexpr std::ptrdiff_t fewestBandCells = 24; ///< without lines, from which the level of a sub-band is known
inline constexpr float medianChanceLn = 0.02f;        ///< of a sub-band's median level that chance alone explains
inline constexpr float lineShareLimitLn = 0.15f;      ///< of a level that lines explain, at most

// ---- sources (Févotte, Bertin and Durrieu 2009) --------------------------------------------------------------------

// Variance of the means of tiles, relative to that of steady noise:
inline constexpr double noticeableVarianceRatio = 1.5; ///< from which a stretch is fitted with sources
inline constexpr double improvedVarianceRatio = 1.1;   ///< by which the fit must reduce it
inline constexpr double remainingVarianceRatio = 1.4;  ///< that it may leave: signals change as well
inline constexpr Index threeSourcesFromCells = 144;    ///< six tiles; below, two sources
inline constexpr float lowestSourcePower = 1e-12f;     ///< of B, relative to frames near 1
inline constexpr float sourceLineLimit = 6.0f;         ///< y of a line in the fit, at most
inline constexpr int sourceSweeps = 16;                ///< over all sources
inline constexpr int sourceLevelUpdates = 12;          ///< of the first levels
inline constexpr Index sourceProfileCells = 24;   ///< a part of the profiles by which frames are compared, as in tiles
inline constexpr double oddestFrameShare = 0.03;  ///< of the frames, left out as bursts when a first source is chosen
inline constexpr std::size_t likeFramesLimit = 5; ///< averaged to a first source
inline constexpr float steepLnPerTwoCells = 1.4f; ///< change of a colour: 6 dB
/// Cells on either side of a steep place in which the colour of a source is not smoothed, and each bin is measured.
inline constexpr Index edgeReachCells = 6;

// ---- edges ---------------------------------------------------------------------------------------------------------

inline constexpr Index fewestEdgeWindows = 1024;     ///< from which bins are measured
inline constexpr Index edgeFrames = 8192;            ///< that are read, at most: a standard error of 1.6 %
inline constexpr float steepLnPerCell = 1.2f;        ///< change of ln B between cells: 5 dB
inline constexpr Index smoothHalfWidthCells = 5;     ///< half the window of the smooth correction
inline constexpr float correctionLimitLn = 0.5f;     ///< of a correction: 2 dB
inline constexpr double significantDeviations = 4.0; ///< standard errors of a smooth correction, once in 16 000 bins
inline constexpr double medianErrorRatio = 1.25;  ///< error of a median over that of a mean of normal values, √(π/2)
inline constexpr double alarmEvidenceNats = 12.0; ///< statistic of a false alarm at usual rates
inline constexpr double alarmsPerRareExcess = 50.0; ///< d ln(rate)/dε of these, for an excess ε of y
inline constexpr Index edgeWindowsTogether = 8;     ///< of a run of frames that are read
inline constexpr Index edgeWindowsApart = 2;        ///< within which frames may still be correlated

// ---- stop bands ----------------------------------------------------------------------------------------------------

inline constexpr Index stopSpectrumSamples = 1024;               ///< of a spectrum: bins 1/512 of the band apart
inline constexpr Index stopSpectraPerTime = 8;                   ///< of which the median is taken
inline constexpr Index fewestStopTimes = 16;                     ///< from which a correlation of ¾ is beyond chance
inline constexpr Index mostStopTimes = 64;                       ///< that are compared, at most
inline constexpr double stopFallNats = 2.0 * std::numbers::ln10; ///< 20 dB
inline constexpr double steadyLevelNats = 0.1;       ///< standard deviation of a level that nothing can follow
inline constexpr double followingCorrelation = 0.75; ///< of the level with that of the band beside it …
inline constexpr double followingSlope = 0.4;        ///< … and its slope, in ln

// ---- power files and pings -----------------------------------------------------------------------------------------

inline constexpr Index powerLevelCells = 500;      ///< of which a tenth to all give a frame's level: all to 6 %
inline constexpr double pingShapeValues = 4000.0;  ///< from which each cell of the beams' common shape is estimated
inline constexpr Index fewestPingLevelCells = 100; ///< from which the level of a ping is estimated: to 14 %
inline constexpr double fewestRangeValues = 16.0;  ///< around a cell, from which its own level is refined
inline constexpr double levelMediansRatio = 2.0;   ///< of the medians of ranges and beams of values that are normalised

} // namespace faintline
