// The parsers of the core and of the command line. A new one is one line in the table.

#include "fuzz/fuzz.h"

#include "app/cli/readProvenance.h"
#include "app/cli/windowExport.h"
#include "base/files/checksum.h"
#include "base/files/fileName.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "base/utc.h"
#include "calibrate/CalibrationStore.h"
#include "evaluate/sequential/ScanTest.h"
#include "exchange/CampaignFile.h"
#include "exchange/ModelFile.h"
#include "exchange/Session.h"
#include "exchange/TopHits.h"
#include "exchange/readAnnotations.h"
#include "exchange/survey/exportSurvey.h"
#include "inspect/Review.h"
#include "live/sources/PipeSource.h"
#include "live/sources/UdpSource.h"
#include "live/sources/sockets.h"
#include "noise/openFrames.h"
#include "plan/AnalysisSettings.h"
#include "plan/calibrationVersion.h"
#include "scene/PingTruth.h"
#include "scene/ScanScene.h"
#include "scene/SimulatedPings.h"
#include "scene/SimulatedRecording.h"
#include "scene/Truth.h"
#include "signal/Timeline.h"
#include "signal/formats/KiwiRecording.h"
#include "signal/formats/bitshuffle.h"
#include "signal/formats/gridFile.h"
#include "signal/openRecording.h"
#include "signal/timeInName.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stop_token>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

using namespace faintline;
using faintline::fuzz::Input;
using faintline::fuzz::Parser;

namespace {

void readSome(const RecordingPointer &recording)
{
    const RecordingInfo &info = recording->info();
    std::vector<float> samples(std::size_t(4096 * info.floatsPerSample()));
    for (const Index first : {Index(0), info.sampleCount / 2, info.sampleCount - 2048})
        recording->read(info.channelCount - 1, first, 4096, samples);
}

void readRaw(const Input &input)
{
    OpenOptions options;
    const std::size_t end = input.text.find('\n');
    options.rawType = input.text.substr(0, end);
    options.rawRateHz = 1000.0;
    options.rawChannels = 1 + int(input.text.size() % 3);
    options.rawHeaderBytes = Index(input.text.size() % 7);
    readSome(openRecording(input.path, options));
}

void readSigmf(const Input &input)
{
    const std::string data = input.path.substr(0, input.path.size() - 4) + "data";
    if (!std::filesystem::exists(data))
        std::ofstream(data, std::ios::binary) << std::string(4096, '\1');
    readSome(openRecording(input.path));
}

void writeFile(const std::filesystem::path &path, const std::string &bytes)
{
    std::ofstream(path, std::ios::binary) << bytes;
}

std::string fromTo(const std::string &text, std::size_t begin, std::size_t end)
{
    return text.substr(std::min(begin, text.size()), end - begin);
}

/// The chunks in which receivers and recorders tell when and where, in a WAV file that is otherwise sound. The first
/// byte chooses one.
void readReceiverChunk(const Input &input)
{
    constexpr std::array<const char *, 4> names{"harp", "auxi", "bext", "LIST"};
    const unsigned choice = input.text.empty() ? 0 : static_cast<unsigned char>(input.text.front());
    const auto littleEndian = [](std::uint32_t value) {
        std::string bytes;
        for (unsigned i = 0; i < 4; ++i)
            bytes += static_cast<char>(value >> (8 * i));
        return bytes;
    };
    const auto chunk = [&](const std::string &name, const std::string &content) {
        return name + littleEndian(std::uint32_t(content.size())) + content + std::string(content.size() % 2, '\0');
    };
    constexpr std::array<char, 16> stereo{1, 0, 2, 0, -24, 3, 0, 0, -96, 15, 0, 0, 4, 0, 16, 0}; // 16 bits, 1000 Hz
    writeFile(input.path,
              chunk("RIFF", "WAVE" + chunk("fmt ", {stereo.data(), stereo.size()})
                                + chunk(names[choice % names.size()], fromTo(input.text, 1, input.text.size()))
                                + chunk("data", std::string(400, '\1'))));
    OpenOptions options;
    options.iq = choice >= 128;
    readSome(openRecording(input.path, options));
}

void readSomeFrames(const NormalisedFramesPointer &frames)
{
    if (!frames)
        return;
    constexpr Index values = 1 << 16;
    const Index cells = frames->grid().size();
    const Index count = std::min(frames->time().count, std::max<Index>(1, values / cells));
    std::vector<float> out(std::size_t(count * cells));
    for (const Index first : {Index(0), frames->time().count - count})
        frames->read(first, count, out);
}

void readFrameFile(const Input &input)
{
    readSomeFrames(openFrames(input.path));
}

/// The axes in a line of their own, then the stack.
void readPowerStack(const Input &input)
{
    const std::size_t end = input.text.find('\n');
    writeFile(gridPathOf(input.path), input.text.substr(0, end));
    writeFile(input.path, end == std::string::npos ? std::string() : input.text.substr(end + 1));
    readSomeFrames(openFrames(input.path));
}

/// The layout in the first three bytes, then a chunk.
void unpackBitshuffle(const Input &input)
{
    if (input.text.size() < 3)
        return;
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(input.text[i]); };
    const BitshuffleLayout layout{byte(0), byte(1), byte(2) % 2 == 1};
    constexpr std::size_t most = 1 << 20;
    const std::span<const char> chunk(input.text);
    if (undoBitshuffle(std::as_bytes(chunk.subspan(3)), layout, most).size() > most)
        std::abort();
}

/// A calibration's file is looked for under its key, and counts with the checksum of what it holds: both are given to
/// what has the rest.
void readCalibration(const Input &input)
{
    const CalibrationStore store(std::filesystem::path(input.path).parent_path() / "calibrations");
    std::filesystem::create_directories(store.fileFor("key").parent_path());
    std::string text = input.text;
    if (Json json = Json::parse(text, nullptr, false); json.is_object() && json.contains("calibration")) {
        json["version"] = calibrationVersion;
        json["key"] = "key";
        json.erase("checksum");
        json["checksum"] = checksum(json.dump(-1, ' ', false, Json::error_handler_t::replace));
        text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
    writeFile(store.fileFor("key"), text);
    if (const auto calibration = store.load("key")) {
        for (const double nats : {-5.0, 3.0, 40.0})
            calibration->eventRateAt(nats), calibration->exceedanceAt(nats);
        for (const double rate : {1e-12, 1e-3, 0.9})
            calibration->thresholdForEventRate(rate), calibration->thresholdForPfa(rate);
    }
}

/// A shard, and what its curve is made of.
void readShard(const Input &input)
{
    const Campaign campaign = readCampaign(input.path);
    writeCurve(campaign, input.path + ".csv");
    merge({campaign});
}

/// What a killed campaign left, whose lines count with their checksums: they are given to it.
void readCampaignParts(const Input &input)
{
    std::istringstream lines(input.text);
    std::string text;
    std::optional<Experiment> experiment;
    for (std::string line; std::getline(lines, line);) {
        if (line.ends_with('}')) {
            const std::string own = checksum(line);
            line.pop_back();
            line += ",\"checksum\":\"" + own + "\"}";
        }
        if (!experiment) {
            const Json head = parseJson(line, "head");
            if (!head.is_object() || !head.contains("experiment"))
                return;
            experiment = experimentFromJson(head["experiment"], "experiment");
        }
        text += line + '\n';
    }
    if (!experiment)
        return;
    const std::string parts = input.path + ".part";
    writeFile(parts, text);
    std::stop_source stop;
    stop.request_stop();
    RunContext context;
    context.stop = stop.get_token();
    try {
        carryOutResumably(*experiment, {}, input.path, context);
    } catch (const Cancelled &) {
    }
    std::filesystem::remove(parts);
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
        cli::remake({provenance, input.path, {}, [](const std::string &) {}}, input.path + ".csv", context);
    } catch (const Cancelled &) {
    }
}

void readSurvey(const Input &input)
{
    SurveyDatabase survey(input.path);
    settingsOf(survey.origin(), input.path);
    exportEvents(survey, input.path + ".csv");
    exportTracks(survey, input.path + ".csv");
    exportStoneSoup(survey, input.path + ".csv", 0.0);
    for (const SurveyRecording &one : survey.recordings())
        survey.areas(one.id), pathBelow(one.file.path, input.path);
}

/// A table as the first and the last observation of a cadence, with nothing between them.
void readCadence(const Input &input)
{
    TopHits on = readTopHits(input.path);
    TopHits off = on;
    off.hits.clear();
    cadenceCsv(findCadence({on, off, on}, double(input.text.size() % 5)));
}

void hearAll(SampleSource &source)
{
    const Index frameBytes = source.format().frameBytes();
    for (int calls = 0; calls < 1000; ++calls) {
        const Heard heard = source.hear(std::chrono::milliseconds(0));
        if (std::ssize(heard.bytes) % frameBytes != 0 || heard.lostSamples < 0)
            std::abort();
        if (heard.isOver)
            return;
        if (heard.bytes.empty() && !source.isPatient())
            return;
    }
}

void hearPipe(const Input &input)
{
    PipeSource source(input.path, std::nullopt);
    hearAll(source);
}

/// The first byte chooses how datagrams are numbered; then each has its length in a byte of its own.
void hearDatagrams(const Input &input)
{
    constexpr std::array<const char *, 7> numbers{"", "u16le", "u16be", "u32le", "u32be", "u64le", "u64be"};
    constexpr std::size_t mostDatagrams = 200; // that wait to be heard
    static const int port = 20000 + ::getpid() % 10000;
    const unsigned choice = input.text.empty() ? 0 : static_cast<unsigned char>(input.text.front());
    UdpSource source("127.0.0.1:" + std::to_string(port), {parseSampleType("ci16_le", "fuzz"), 8000.0, 1, 0.0, {}},
                     parseSequenceNumbers(numbers[choice % numbers.size()]));
    const int sender = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in to = {};
    to.sin_family = AF_INET;
    to.sin_port = htons(std::uint16_t(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    std::size_t at = 1;
    for (std::size_t sent = 0; sent < mostDatagrams && at < input.text.size(); ++sent) {
        const std::string datagram = fromTo(input.text, at + 1, at + 1 + static_cast<unsigned char>(input.text[at]));
        at += 1 + datagram.size();
        (void)!::sendto(sender, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr *>(&to),
                        sizeof to);
    }
    ::close(sender);
    hearAll(source);
}

/// What command lines say of sources and of times. Each refuses most of it.
void readWords(const Input &input)
{
    const auto tryTo = [](const auto &read) {
        try {
            read();
        } catch (const Error &) {
        }
    };
    tryTo([&] { parseHostAndPort(input.text, ""); });
    tryTo([&] { parseHostAndPort(input.text, "1234"); });
    tryTo([&] { parseSequenceNumbers(input.text); });
    tryTo([&] { parseSampleType(input.text, "words"); });
    constexpr double yearOne = -62135596800.0;
    constexpr double mostSeconds = 2e11; // that formatUtc writes
    constexpr double tolerance = 1e-4;   // of a double at the most
    const double seconds = parseUtc(input.text).value_or(0.0);
    if (seconds >= yearOne && seconds < mostSeconds
        && !(std::abs(parseUtc(formatUtc(seconds)).value_or(1e99) - seconds) <= tolerance))
        std::abort();
}

/// Sessions and what recovery leaves. What was read is written as something that can be read.
void readSessions(const Input &input)
{
    parseJson(sessionText(readSession(input.path), std::filesystem::path(input.path).parent_path().string()),
              "what was written");
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
        {"receiverChunk", ".wav", readReceiverChunk},
        {"kiwi", ".wav", [](const Input &input) { readSome(std::make_shared<KiwiRecording>(input.path)); }},
        {"sigmf", ".sigmf-meta", readSigmf},
        {"raw", ".bin", readRaw},
        {"numpy", ".npy", [](const Input &input) { readFrames(input.path, {}); }},
        {"numpyPower", ".npy", readPowerStack},
        {"filterbank", ".fil", readFrameFile},
        {"filterbankHdf5", ".h5", readFrameFile},
        {"bitshuffle", ".bin", unpackBitshuffle},
        {"strain", ".hdf5", [](const Input &input) { readSome(openRecording(input.path)); }},
        {"digitalRf", ".h5", [](const Input &input) { readSome(openRecording(input.path)); }},
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
        {"source", ".json", [](const Input &input) { sourceOf(input.path); }},
        {"session", ".faintline", readSessions},
        {"scanScene", ".json", [](const Input &input) { scanSceneFromJson(parseJson(input.text, "scene")); }},
        {"truth", ".json", [](const Input &input) { truthFromJson(parseJson(input.text, "truth")); }},
        {"pingTruth", ".json", [](const Input &input) { pingTruthFromJson(parseJson(input.text, "truth")); }},
        {"settings", ".json", [](const Input &input) { settingsFromJson(input.text, "settings"); }},
        {"reviews", ".json",
         [](const Input &input) { annotationsFromJson(parseJson(input.text, "reviews"), "reviews"); }},
        {"experiment", ".json",
         [](const Input &input) { experimentFromJson(parseJson(input.text, "experiment"), "experiment"); }},
        {"campaign", ".json", readShard},
        {"campaignParts", ".json", readCampaignParts},
        {"curve", ".csv", [](const Input &input) { readCurve(input.path); }},
        {"annotations", ".txt", [](const Input &input) { readAnnotations(input.path, RecordingInfo()); }},
        {"calibration", ".json", readCalibration},
        {"survey", ".sqlite", readSurvey},
        {"json", ".json", [](const Input &input) { parseJson(input.text, "json"); }},
        {"hits", ".dat", [](const Input &input) { topHitsText(readTopHits(input.path)); }},
        {"cadence", ".dat", readCadence},
        {"timeline", ".timeline", [](const Input &input) { Timeline::filesOf({input.path}); }},
        {"timeInName", ".txt", [](const Input &input) { timeInName(input.text.substr(0, 255)); }},
        {"names", ".txt", readNames},
        {"pipe", ".wav", hearPipe},
        {"datagrams", ".bin", hearDatagrams},
        {"words", ".txt", readWords},
        {"provenance", ".json", [](const Input &input) { cli::readProvenance(input.path); }},
        {"windowExport", ".json", readWindowExport},
    };
    return all;
}
