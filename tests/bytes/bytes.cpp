// Prints a number for what each stage of the chain makes of simulated input. Linked twice, with the core as it is and
// with one that has no loops for newer processors: what both print must be the same.

#include "base/Random.h"
#include "frames/PeakPyramid.h"
#include "noise/NoiseNormaliser.h"
#include "plan/AnalysisSettings.h"
#include "scene/SimulatedPings.h"
#include "scene/SimulatedRecording.h"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

using namespace faintline;

namespace {

/// Fowler, Noll and Vo's hash, 64 bits.
std::uint64_t hashOf(std::span<const float> values)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (float value : values) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * 0x100000001b3u;
    }
    return hash;
}

void print(const char *what, std::span<const float> values)
{
    std::printf("%-24s %016llx\n", what, static_cast<unsigned long long>(hashOf(values)));
}

std::vector<float> statisticOf(Detector &detector, std::span<const float> frames, Index cells)
{
    std::vector<float> statistic(frames.size());
    detector.updateBlock(frames, statistic, cells);
    return statistic;
}

void printLines()
{
    LineScene scene;
    scene.sampleRateHz = 8000.0;
    scene.durationSeconds = 40.0;
    scene.noise.slopeDbPerOctave = -3.0;
    scene.lines.push_back({});
    const auto recording = std::make_shared<const SimulatedRecording>(scene);
    std::vector<float> samples(8000);
    recording->read(0, 0, 8000, samples);
    print("samples", samples);

    const AnalysisSettings settings;
    const auto spectrogram = std::make_shared<const Spectrogram>(recording, settings.spectrogram);
    const auto background = estimateBackground(*spectrogram, settings.noise);
    print("background", background->lnPower);
    print("levels", background->lnLevel);
    const NormalisedSpectrogram normalised(spectrogram, background, settings.noise);
    const Index cells = normalised.grid().size();
    std::vector<float> frames(std::size_t(normalised.time().count * cells));
    normalised.read(0, normalised.time().count, frames);
    print("normalised frames", frames);

    for (std::size_t kind = 0; kind < detectorNames.size(); ++kind) {
        const MarkovModel model = makeModel(settings.model, normalised.grid());
        const auto detector = makeDetector(detectorOfKind(kind), model, normalised.grid(), {2.0, 2.0},
                                           ResetRule{ResetLaw::Half, 0.7, 0.0, 0.01});
        print(detectorNames[kind].data(), statisticOf(*detector, frames, cells));
    }
    ModelSettings wide = laws::billon();
    wide.lowestSlope = -10;
    wide.highestSlope = 10;
    Smd many(makeModel(wide, normalised.grid()), {ResetLaw::Fixed, 0.7});
    print("smd, 21 slopes", statisticOf(many, frames, cells));

    for (const ByteScale::Kind kind : {ByteScale::Kind::PowerDb, ByteScale::Kind::ScoreNats}) {
        std::vector<std::uint8_t> bytes(frames.size());
        ByteScale(kind).encode(frames, bytes);
        print("bytes of a picture", std::vector<float>(bytes.begin(), bytes.end()));
    }
}

void printPings()
{
    PingScene scene;
    scene.pings = 4;
    scene.rangeCells = 300;
    const SimulatedPings pings(scene);
    const Index cells = pings.grid().size();
    std::vector<float> frames(std::size_t(4 * cells));
    pings.read(0, 4, frames);
    print("pings", frames);
    AnalysisSettings settings = preset("sonar").settings;
    for (const MarkovModel &model : makeModels(settings.model, pings.grid())) {
        Smd detector(model, {ResetLaw::Mean, 0.0, -1.3});
        print("smd, pings", statisticOf(detector, frames, cells));
    }
}

} // namespace

int main()
{
    std::vector<float> random(100'000);
    Random(1, 2).normals(random, 1.0f);
    print("normals", random);
    Random(1, 3).exponentials(random);
    print("exponentials", random);
    printLines();
    printPings();
}
