#pragma once

#include "plan/Analysis.h"
#include "signal/Recording.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace faintline::test {

/// A signal of known frequency and power.
struct KnownSignal {
    double from; ///< seconds
    double to;
    double snrDb; ///< in a rectangular window of the scene's length
    std::function<double(double seconds)> hz;
};

/// Several signals in white noise: beside each other, crossing, meeting.
struct SignalScene {
    std::string name;
    double rateHz;
    double seconds;
    double windowSeconds;
    std::vector<KnownSignal> known;
    int bursts = 0; ///< of white noise, 10 dB above, 20 ms each
    bool isFast = false;

    double cellHz() const { return 1.0 / windowSeconds; }
};

/// All scenes, in the order of the table. Frequencies, places and times vary with the seed.
std::vector<SignalScene> signalScenes(int seed);

/// The scene of that name.
SignalScene signalScene(std::string_view name, int seed);

/// The scene as samples; noise and phases depend on the seed.
RecordingPointer recordingOf(const SignalScene &scene, int seed);

/// The scene through the pipeline, with the scene's window, and the preset for fast signals if they are.
std::shared_ptr<const Analysis> analysisOf(const SignalScene &scene, int seed, AnalysisSettings settings = {});

/// What the tracks say of one signal.
struct SignalScore {
    double coverage = 0.0; ///< share of its time with a track within a resolution cell
    double single = 0.0;   ///< share of its time with the track that has the largest share
    int fragments = 0;     ///< tracks that are on it, and nearest to it, for 3 % of its time or more, while the others
                           ///< are farther than a cell
    double error = 0.0;    ///< 90 % of the distances, in cells, while no other signal is nearer than 2 cells
};

struct SceneScore {
    std::vector<SignalScore> known;
    int swaps = 0;          ///< of a track from one signal to another, for 8 frames or more
    int falseTracks = 0;    ///< less than half of whose points are on a signal
    double precision = 1.0; ///< share of all points of tracks that are on a signal

    /// The worse, or the mean, of all known.
    SignalScore worst() const;
    SignalScore mean() const;
};

/// "On" a signal means within a resolution cell, and half of what the signal moves in a frame.
SceneScore scoreOf(const SignalScene &scene, const Analysis &analysis);

} // namespace faintline::test
