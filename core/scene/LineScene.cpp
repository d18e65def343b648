#include "scene/LineScene.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double mostNodes = 6e6; ///< 16 bytes each
    constexpr std::size_t mostLines = 10000;

    std::string lineName(const std::string &list, std::size_t i)
    {
        return list + "[" + std::to_string(i) + "]";
    }

    double durationOf(const LineSettings &line, const RecordingInfo &recording)
    {
        return line.durationSeconds > 0.0 ? line.durationSeconds : recording.durationSeconds() - line.startSeconds;
    }

    /// Number of nodes of a line's frequency path and of its fading, as stored by `Tone`.
    double wanderNodes(const LineSettings &line, double duration)
    {
        return line.wanderHz > 0.0 ? duration / (0.1 * std::min(line.referenceSeconds, line.wanderSeconds)) : 0.0;
    }

    double fadingNodes(const LineSettings &line, double duration)
    {
        return line.fading != Fading::None ? duration / (0.02 * line.fadingSeconds) : 0.0;
    }

    /// Number of powers of a line that fluctuates, as stored by `Tone`.
    double fluctuationNodes(const LineSettings &line, double duration)
    {
        return changesFromFrameToFrame(line.fluctuation) ? duration / line.referenceSeconds : 0.0;
    }

} // namespace

const std::vector<Field<LineSettings>> &LineSettings::fields()
{
    using S = LineSettings;
    static const std::vector<Field<S>> table{
        field(&S::snrDb, "snrDb", "dB", -60.0, 120.0,
              "Power of the line over the noise power in one resolution cell of a rectangular window of "
              "referenceSeconds.")
            .labelled("SNR"),
        field(&S::referenceSeconds, "referenceSeconds", "s", 1e-6, 1e6, "Length of the window to which the SNR refers.")
            .labelled("SNR in a window of"),
        field(&S::startSeconds, "startSeconds", "s", 0.0, 1e9, "Start time of the line.").labelled("Start"),
        field(&S::durationSeconds, "durationSeconds", "s", 0.0, 1e9,
              "Duration of the line; 0 extends it to the end of "
              "the recording.")
            .labelled("Duration"),
        field(&S::frequencyHz, "frequencyHz", "Hz", -1e12, 1e12, "Frequency of the line at its start.")
            .labelled("Frequency"),
        field(&S::driftHzPerSecond, "driftHzPerSecond", "Hz/s", -1e9, 1e9, "Constant drift of the frequency.")
            .labelled("Drift"),
        field(&S::wanderHz, "wanderHz", "Hz", 0.0, 1e9, "Standard deviation of the random wander around the drift.")
            .labelled("Wander"),
        field(&S::wanderSeconds, "wanderSeconds", "s", 1e-6, 1e9, "Correlation time of the wander.")
            .labelled("Time of the wander"),
        field(&S::fading, "fading", fadingNames, "Whether the amplitude is constant or fades."),
        field(&S::fadingSeconds, "fadingSeconds", "s", 1e-6, 1e9, "Correlation time of the fading.")
            .labelled("Time of the fading"),
        field(&S::fluctuation, "fluctuation", fluctuationNames,
              "Fluctuation of the power about its mean: one power for the whole line (Swerling 1 and 3), or one for "
              "each referenceSeconds (2 and 4)."),
    };
    return table;
}

const std::vector<Field<NoiseSettings>> &NoiseSettings::fields()
{
    using S = NoiseSettings;
    static const std::vector<Field<S>> table{
        field(&S::deviation, "deviation", "", 1e-12, 1e6,
              "Standard deviation of the noise in a sample; full scale is 1."),
        field(&S::slopeDbPerOctave, "slopeDbPerOctave", "dB", -6.0, 6.0, "Spectral shape of the noise density."),
        field(&S::levelDriftDb, "levelDriftDb", "dB", 0.0, 20.0,
              "Standard deviation of the slow changes of the noise level."),
        field(&S::levelDriftSeconds, "levelDriftSeconds", "s", 1e-3, 1e9, "Correlation time of these changes."),
    };
    return table;
}

const std::vector<Field<LineScene>> &LineScene::fields()
{
    using S = LineScene;
    static const std::vector<Field<S>> table{
        field(&S::sampleRateHz, "sampleRateHz", "Hz", 1e-6, 1e12, "Sample rate."),
        field(&S::durationSeconds, "durationSeconds", "s", 1e-9, 1e9, "Length of the recording."),
        field(&S::isComplex, "complex",
              "Whether samples are I/Q, so that negative frequencies differ from positive ones."),
        field(&S::centreHz, "centreHz", "Hz", -1e12, 1e12, "Frequency to which 0 Hz of the samples corresponds."),
        field(&S::seed, "seed", "", 0.0, 2147483647.0,
              "Seed of the random numbers; the same seed gives the same recording."),
    };
    return table;
}

RecordingInfo recordingInfo(const LineScene &scene)
{
    RecordingInfo info;
    info.path = "simulated";
    info.container = "simulated";
    info.sampleType = scene.isComplex ? "cf32" : "rf32";
    info.sampleRateHz = scene.sampleRateHz;
    info.sampleCount = Index(std::floor(scene.sampleRateHz * scene.durationSeconds + 1e-6));
    info.channelCount = 1;
    info.isComplex = scene.isComplex;
    info.centreHz = scene.centreHz;
    return info;
}

void checkLine(const LineSettings &line, const RecordingInfo &recording, const std::string &name)
{
    checkFields(line, LineSettings::fields(), name);
    const double recordingEnd = recording.durationSeconds();
    if (line.startSeconds >= recordingEnd)
        throw Error(name + ".startSeconds = " + formatNumber(line.startSeconds),
                    "must lie before the end of the recording, " + formatNumber(recordingEnd) + " s");
    if (line.startSeconds + line.durationSeconds > recordingEnd + 1.0 / recording.sampleRateHz)
        throw Error(name + ".durationSeconds = " + formatNumber(line.durationSeconds),
                    "extends the line beyond the end of the recording, " + formatNumber(recordingEnd) + " s");

    const double duration = durationOf(line, recording);
    const double low = recording.centreHz - (recording.isComplex ? 0.5 * recording.sampleRateHz : 0.0);
    const double high = recording.centreHz + 0.5 * recording.sampleRateHz;
    const double last = line.frequencyHz + line.driftHzPerSecond * duration;
    if (std::min(line.frequencyHz, last) < low || std::max(line.frequencyHz, last) > high)
        throw Error(name + ".frequencyHz = " + formatNumber(line.frequencyHz),
                    "the line must stay within " + formatNumber(low) + " … " + formatNumber(high) + " Hz"
                        + (line.driftHzPerSecond != 0.0 ? ", but drifts to " + formatNumber(last) + " Hz" : ""));

    if (line.fluctuation != Fluctuation::None && line.fading != Fading::None)
        throw Error(name + ".fluctuation = " + std::string(fluctuationNames[std::size_t(line.fluctuation)]),
                    "is not possible with fading; use one of the two");
    if (wanderNodes(line, duration) > mostNodes)
        throw Error(name + ".wanderSeconds = " + formatNumber(line.wanderSeconds),
                    "is too short for a line of " + formatNumber(duration) + " s, or referenceSeconds is");
    if (fadingNodes(line, duration) > mostNodes)
        throw Error(name + ".fadingSeconds = " + formatNumber(line.fadingSeconds),
                    "is too short for a line of " + formatNumber(duration) + " s");
    if (fluctuationNodes(line, duration) > mostNodes)
        throw Error(name + ".referenceSeconds = " + formatNumber(line.referenceSeconds),
                    "is too short for a fluctuating line of " + formatNumber(duration) + " s");
}

void checkLines(std::span<const LineSettings> lines, const RecordingInfo &recording, const std::string &name)
{
    double nodes = 0.0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        checkLine(lines[i], recording, lineName(name, i));
        const double duration = durationOf(lines[i], recording);
        nodes +=
            wanderNodes(lines[i], duration) + fadingNodes(lines[i], duration) + fluctuationNodes(lines[i], duration);
        if (nodes > mostNodes)
            throw Error(lineName(name, i),
                        "wanders, fades or fluctuates too fast for its length, counting all lines before it");
    }
}

void checkScene(const LineScene &scene)
{
    checkFields(scene, LineScene::fields());
    checkFields(scene.noise, NoiseSettings::fields(), "noise");
    const double samples = scene.sampleRateHz * scene.durationSeconds;
    if (!(samples >= 1.0 && samples <= 1e15))
        throw fieldError("durationSeconds", formatNumber(scene.durationSeconds),
                         "gives " + formatNumber(std::floor(samples)) + " samples; must be 1 … 1e15");
    if (scene.noise.levelDriftDb > 0.0 && scene.durationSeconds > 1e6 * scene.noise.levelDriftSeconds)
        throw fieldError("noise.levelDriftSeconds", formatNumber(scene.noise.levelDriftSeconds),
                         "must be at least a millionth of the duration");
    if (scene.lines.size() > mostLines)
        throw Error("lines", "must be at most " + std::to_string(mostLines));
    checkLines(scene.lines, recordingInfo(scene), "lines");
}

LineScene lineSceneFromJson(const Json &json)
{
    LineScene scene;
    readFields(json, LineScene::fields(), scene, {}, {"kind", "noise", "lines"});
    if (const auto kind = json.find("kind"); kind != json.end() && *kind != "lines")
        throw Error("kind", "must be \"lines\" for a scene of lines in noise");
    for (const char *needed : {"sampleRateHz", "durationSeconds"})
        if (!json.contains(needed))
            throw Error(needed, "is missing; every other key has a default");
    if (const auto noise = json.find("noise"); noise != json.end())
        readFields(*noise, NoiseSettings::fields(), scene.noise, "noise");
    for (const Json &entry : listOf(json, "lines")) {
        const std::string name = lineName("lines", scene.lines.size());
        readFields(entry, LineSettings::fields(), scene.lines.emplace_back(), name);
    }
    checkScene(scene);
    return scene;
}

Json toJson(const LineScene &scene)
{
    Json json;
    json["kind"] = "lines";
    json.update(writeFields(scene, LineScene::fields()));
    json["noise"] = writeFields(scene.noise, NoiseSettings::fields());
    json["lines"] = Json::array();
    for (const LineSettings &line : scene.lines)
        json["lines"].push_back(writeFields(line, LineSettings::fields()));
    return json;
}

} // namespace faintline
