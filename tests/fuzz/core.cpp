// The parsers of the core and of the command line. A new one is one line in the table.

#include "fuzz/fuzz.h"

#include "analysis/AnalysisSettings.h"
#include "analysis/CalibrationStore.h"
#include "analysis/Review.h"
#include "app/cli/readProvenance.h"
#include "app/cli/windowExport.h"
#include "base/fileName.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "evaluate/sequential/ScanTest.h"
#include "exchange/CampaignFile.h"
#include "exchange/ModelFile.h"
#include "exchange/NumPy.h"
#include "exchange/openFrames.h"
#include "exchange/readAnnotations.h"
#include "live/wavHeader.h"
#include "recording/PingTruth.h"
#include "recording/ScanScene.h"
#include "recording/SimulatedRecording.h"
#include "recording/Truth.h"
#include "recording/openRecording.h"
#include "spectrum/SimulatedPings.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stop_token>
#include <string>
#include <vector>

using namespace faintline;
using faintline::fuzz::Input;
using faintline::fuzz::Parser;

namespace {

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

/// Up to where something is computed of it.
void readWindowExport(const Input &input)
{
    std::stop_source stop;
    stop.request_stop();
    RunContext context;
    context.stop = stop.get_token();
    const Json provenance = parseJson(input.text, "provenance");
    if (!cli::isOfWindow(provenance))
        return;
    try {
        cli::remakeWindowExport(
            provenance, input.path, {}, input.path + ".csv", [](const std::string &) {}, context);
    } catch (const Cancelled &) {
    }
}

void readStream(const Input &input)
{
    std::size_t at = 0;
    readWavHeader(
        [&](std::span<std::byte> bytes) {
            if (input.text.size() - at < bytes.size())
                return false;
            std::memcpy(bytes.data(), input.text.data() + at, bytes.size());
            at += bytes.size();
            return true;
        },
        "stream");
}

void readNames(const Input &input)
{
    if (fileNameFromText(textFromFileName(input.text)) != input.text)
        std::abort();
    const std::string line = oneLine(input.text, 100);
    if (oneLine(line) != line)
        std::abort();
}

} // namespace

const std::vector<Parser> &faintline::fuzz::parsers()
{
    static const std::vector<Parser> all{
        {"audio", ".wav", [](const Input &input) { readSome(openRecording(input.path)); }},
        {"sigmf", ".sigmf-meta", readSigmf},
        {"raw", ".bin", readRaw},
        {"numpy", ".npy", [](const Input &input) { readFrames(input.path, {}); }},
        {"filterbank", ".fil", [](const Input &input) { openFrames(input.path); }},
        {"filterbankHdf5", ".h5", [](const Input &input) { openFrames(input.path); }},
        {"strain", ".hdf5", [](const Input &input) { readSome(openRecording(input.path)); }},
        {"numpyDoubles", ".npy", [](const Input &input) { readDoubleFrames(input.path); }},
        {"grid", ".json",
         [](const Input &input) {
             readGridFile(input.path, {3, 40});
         }},
        {"model", ".json", [](const Input &input) { readModelFile(input.path); }},
        {"sequentialModel", ".json", [](const Input &input) { readSequentialModel(input.path); }},
        {"lineScene", ".json",
         [](const Input &input) { SimulatedRecording(lineSceneFromJson(parseJson(input.text, "scene"))); }},
        {"pingScene", ".json",
         [](const Input &input) { SimulatedPings(pingSceneFromJson(parseJson(input.text, "scene"))); }},
        {"scanScene", ".json", [](const Input &input) { scanSceneFromJson(parseJson(input.text, "scene")); }},
        {"truth", ".json", [](const Input &input) { truthFromJson(parseJson(input.text, "truth")); }},
        {"pingTruth", ".json", [](const Input &input) { pingTruthFromJson(parseJson(input.text, "truth")); }},
        {"settings", ".json", [](const Input &input) { settingsFromJson(input.text, "settings"); }},
        {"reviews", ".json",
         [](const Input &input) { annotationsFromJson(parseJson(input.text, "reviews"), "reviews"); }},
        {"experiment", ".json",
         [](const Input &input) { experimentFromJson(parseJson(input.text, "experiment"), "experiment"); }},
        {"campaign", ".json", [](const Input &input) { readCampaign(input.path); }},
        {"curve", ".csv", [](const Input &input) { readCurve(input.path); }},
        {"annotations", ".txt", [](const Input &input) { readAnnotations(input.path, {}); }},
        {"calibration", ".json", readCalibration},
        {"json", ".json", [](const Input &input) { parseJson(input.text, "json"); }},
        {"names", ".txt", readNames},
        {"wavStream", ".wav", readStream},
        {"provenance", ".json", [](const Input &input) { cli::readProvenance(input.path); }},
        {"windowExport", ".json", readWindowExport},
    };
    return all;
}
