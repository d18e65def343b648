// Signals beside each other, crossing and meeting: what the tracks make of them.
//
//     faintline-many-signals [--seeds N] [--first N] [--only TEXT] [--tracks] [name=value …]
//
// One row for each scene of tests/support/manySignals.cpp, mean over the seeds: coverage, best single track and largest
// number of fragments of the worse signal (whistles: mean of all), swaps and false tracks in all, 90 % error in cells,
// precision. --tracks lists the tracks.

#include "plan/AnalysisSettings.h"
#include "support/manySignals.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace faintline;

namespace {

struct Row {
    double coverage = 0.0;
    double single = 0.0;
    double fragments = 0.0;
    int most = 0;
    int swaps = 0;
    int falseTracks = 0;
    double error = 0.0;
    double precision = 0.0;
};

void list(const Analysis &analysis)
{
    const Axis &axis = analysis.grid().axes.back();
    for (const Track &track : analysis.tracks)
        std::printf("    %3d  frames %5td to %5td  %9.2f to %9.2f Hz  %8.1f nat\n", track.id, track.onsetFrame,
                    track.endFrame, axis.value(track.lastPosition(0, axis)),
                    axis.value(track.lastPosition(track.points.size() - 1, axis)), track.peakStatistic);
}

} // namespace

int main(int argc, char **argv)
try {
    AnalysisSettings settings;
    int seeds = 5;
    int firstSeed = 101;
    std::string only;
    bool listsTracks = false;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        const auto equals = argument.find('=');
        if (argument == "--seeds" && i + 1 < argc)
            seeds = std::atoi(argv[++i]);
        else if (argument == "--first" && i + 1 < argc)
            firstSeed = std::atoi(argv[++i]);
        else if (argument == "--only" && i + 1 < argc)
            only = argv[++i];
        else if (argument == "--tracks")
            listsTracks = true;
        else if (equals != std::string::npos)
            setSetting(settings, argument.substr(0, equals), argument.substr(equals + 1));
    }
    std::printf("%-46s coverage  single  fragments  swaps  false  error  precision\n", "scene");
    for (std::size_t number = 0; number < test::signalScenes(1).size(); ++number) {
        Row row;
        std::string name;
        for (int seed = firstSeed; seed < firstSeed + seeds; ++seed) {
            const test::SignalScene scene = test::signalScenes(seed)[number];
            name = scene.name;
            if (name.find(only) == std::string::npos)
                break;
            const auto analysis = test::analysisOf(scene, seed, settings);
            const test::SceneScore score = test::scoreOf(scene, *analysis);
            const test::SignalScore one = scene.known.size() > 2 ? score.mean() : score.worst();
            row.coverage += one.coverage / seeds;
            row.single += one.single / seeds;
            row.fragments += double(one.fragments) / seeds;
            row.most = std::max(row.most, score.worst().fragments);
            row.swaps += score.swaps;
            row.falseTracks += score.falseTracks;
            row.error += one.error / seeds;
            row.precision += score.precision / seeds;
            if (listsTracks) {
                std::printf("  seed %d: %.2f %.2f\n", seed, one.coverage, one.single);
                list(*analysis);
            }
        }
        if (name.find(only) != std::string::npos)
            std::printf("%-46s   %.2f     %.2f   %4.1f (%d)   %4d   %4d   %.2f     %.2f\n", name.c_str(), row.coverage,
                        row.single, row.fragments, row.most, row.swaps, row.falseTracks, row.error, row.precision);
        std::fflush(stdout);
    }
    return 0;
} catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
