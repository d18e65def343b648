// One program that feeds bytes to any parser of the core: `FAINTLINE_FUZZ=NAME faintline-fuzz CORPUS`. tests/fuzz.sh runs all.
// A new parser is one line in the table.

#include "analysis/AnalysisSettings.h"
#include "analysis/CalibrationStore.h"
#include "analysis/Review.h"
#include "base/Error.h"
#include "base/fileName.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "evaluate/ScanTest.h"
#include "exchange/CampaignFile.h"
#include "exchange/ModelFile.h"
#include "exchange/NumPy.h"
#include "exchange/readAnnotations.h"
#include "recording/PingTruth.h"
#include "recording/ScanScene.h"
#include "recording/SimulatedRecording.h"
#include "recording/Truth.h"
#include "recording/openRecording.h"
#include "spectrum/SimulatedPings.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

using namespace faintline;

namespace {

/// The input, as text and as a file whose name has the parser's ending.
struct Input {
    std::string text;
    std::string path;
};

void readSome(const RecordingPointer &recording)
{
    const RecordingInfo &info = recording->info();
    std::vector<float> samples(static_cast<std::size_t>(4096 * info.floatsPerSample()));
    for (const Index first : {Index(0), info.sampleCount / 2, info.sampleCount - 2048})
        recording->read(info.channelCount - 1, first, 4096, samples);
}

void readRaw(const Input &input)
{
    OpenOptions options;
    const std::size_t end = input.text.find('\n');
    options.rawType = input.text.substr(0, end);
    options.rawRateHz = 1000.0;
    options.rawChannels = 1 + static_cast<int>(input.text.size() % 3);
    options.rawHeaderBytes = static_cast<Index>(input.text.size() % 7);
    readSome(openRecording(input.path, options));
}

void readSigmf(const Input &input)
{
    const std::string data = input.path.substr(0, input.path.size() - 4) + "data";
    if (!std::filesystem::exists(data))
        std::ofstream(data, std::ios::binary) << std::string(4096, '\1');
    readSome(openRecording(input.path));
}

/// A calibration's file is looked for under its key.
void readCalibration(const Input &input)
{
    const CalibrationStore store(std::filesystem::path(input.path).parent_path() / "calibrations");
    std::filesystem::create_directories(store.fileFor("key").parent_path());
    std::ofstream(store.fileFor("key"), std::ios::binary) << input.text;
    store.load("key");
}

void readNames(const Input &input)
{
    if (fileNameFromText(textFromFileName(input.text)) != input.text)
        std::abort();
    const std::string line = oneLine(input.text, 100);
    if (oneLine(line) != line)
        std::abort();
}

struct Parser {
    const char *name;
    const char *ending;
    void (*read)(const Input &);
};

const Parser parsers[]{
    {"audio", ".wav", [](const Input &input) { readSome(openRecording(input.path)); }},
    {"sigmf", ".sigmf-meta", readSigmf},
    {"raw", ".bin", readRaw},
    {"numpy", ".npy", [](const Input &input) { readFrames(input.path, {}); }},
    {"numpyDoubles", ".npy", [](const Input &input) { readDoubleFrames(input.path); }},
    {"grid", ".json", [](const Input &input) { readGridFile(input.path, {3, 40}); }},
    {"model", ".json", [](const Input &input) { readModelFile(input.path); }},
    {"sequentialModel", ".json", [](const Input &input) { readSequentialModel(input.path); }},
    {"lineScene", ".json", [](const Input &input) { SimulatedRecording(lineSceneFromJson(parseJson(input.text, "scene"))); }},
    {"pingScene", ".json", [](const Input &input) { SimulatedPings(pingSceneFromJson(parseJson(input.text, "scene"))); }},
    {"scanScene", ".json", [](const Input &input) { scanSceneFromJson(parseJson(input.text, "scene")); }},
    {"truth", ".json", [](const Input &input) { truthFromJson(parseJson(input.text, "truth")); }},
    {"pingTruth", ".json", [](const Input &input) { pingTruthFromJson(parseJson(input.text, "truth")); }},
    {"settings", ".json", [](const Input &input) { settingsFromJson(input.text, "settings"); }},
    {"reviews", ".json", [](const Input &input) { annotationsFromJson(parseJson(input.text, "reviews"), "reviews"); }},
    {"experiment", ".json", [](const Input &input) { experimentFromJson(parseJson(input.text, "experiment"), "experiment"); }},
    {"campaign", ".json", [](const Input &input) { readCampaign(input.path); }},
    {"curve", ".csv", [](const Input &input) { readCurve(input.path); }},
    {"annotations", ".txt", [](const Input &input) { readAnnotations(input.path, {}); }},
    {"calibration", ".json", readCalibration},
    {"json", ".json", [](const Input &input) { parseJson(input.text, "json"); }},
    {"names", ".txt", readNames},
};

const Parser &chosen()
{
    const char *name = std::getenv("FAINTLINE_FUZZ");
    for (const Parser &parser : parsers)
        if (name && std::string(name) == parser.name)
            return parser;
    for (const Parser &parser : parsers)
        std::printf("%s\n", parser.name);
    std::fflush(stdout);
    std::_Exit(name && std::string(name) == "LIST" ? 0 : 2); // the library takes an exit for a finding
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int *, char ***)
{
    chosen(); // says what there is before the library says anything
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t size)
{
    static const Parser &parser = chosen();
    static const std::string path = "/dev/shm/faintline-fuzz-" + std::to_string(::getpid()) + "/input" + parser.ending;
    static const bool isThere = std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    (void)isThere;
    const Input input{std::string(reinterpret_cast<const char *>(bytes), size), path};
    std::ofstream(path, std::ios::binary) << input.text;
    try {
        parser.read(input);
    } catch (const Error &error) {
        if (oneLine(error.what()).empty())
            std::abort(); // a refusal says something
    }
    return 0; // any other exception is a finding
}
