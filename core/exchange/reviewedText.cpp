#include "exchange/reviewedText.h"

#include "base/Field.h"
#include "base/files/fileName.h"
#include "base/utc.h"
#include "exchange/annotationText.h"
#include "signal/formats/AudioDecoder.h"
#include "signal/formats/SigmfRecording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

namespace faintline {

namespace {

    /// A box may lie anywhere; the sample number must be exact as a double, here and in the file.
    long long sampleAt(double seconds, double rate)
    {
        constexpr double exactWholeLimit = 9007199254740992.0; // 2⁵³
        return std::llround(std::clamp(seconds * rate, -exactWholeLimit, exactWholeLimit));
    }

    /// The samples' type by SigMF's name; floats if SigMF has no name for it.
    std::string sigmfTypeOf(const RecordingInfo &info)
    {
        constexpr std::array<std::pair<const char *, const char *>, 6> audio{{{"int8", "i8"},
                                                                              {"uint8", "u8"},
                                                                              {"int16", "i16"},
                                                                              {"int32", "i32"},
                                                                              {"float32", "f32"},
                                                                              {"float64", "f64"}}};
        try {
            return parseSampleType(info.sampleType, {}).name();
        } catch (const Error &) { // the type of an audio file
        }
        const auto known =
            std::find_if(audio.begin(), audio.end(), [&](const auto &each) { return info.sampleType == each.first; });
        const bool isBigEndian = info.container == "AIFF" || info.container == "AU";
        return parseSampleType((info.isComplex ? "c" : "r") + std::string(known == audio.end() ? "f32" : known->second)
                                   + (isBigEndian ? "_be" : "_le"),
                               {})
            .name();
    }

    /// One capture for each stretch without a gap.
    Json sigmfCaptures(const RecordingInfo &info)
    {
        Json captures = Json::array();
        Index sample = 0;
        do {
            Json capture;
            capture["core:sample_start"] = info.firstNumber + info.places.storedAt(sample);
            if (info.places.hasGaps())
                capture["core:global_index"] = sample;
            if (info.isComplex && info.isCentreKnown())
                capture["core:frequency"] = info.centreHz;
            if (info.startUnixSeconds)
                capture["core:datetime"] = formatUtc(*info.startUnixSeconds + double(sample) / info.sampleRateHz);
            captures.push_back(std::move(capture));
            sample = info.places.nextStretch(sample);
        } while (sample < info.places.end());
        return captures;
    }

} // namespace

Json sigmfMetadata(const RecordingInfo &info, const std::string &description)
{
    Json json = info.sigmf.empty() ? Json::object() : parseJson(info.sigmf, info.path);
    Json &global = json["global"];
    global["core:version"] = "1.0.0";
    global["core:sample_rate"] = info.sampleRateHz;
    if (!global.contains("core:datatype")) {
        global["core:datatype"] = sigmfTypeOf(info);
        global["core:num_channels"] = std::max(1, info.channelCount);
    }
    if (info.firstNumber != 0)
        global["core:offset"] = info.firstNumber;
    std::error_code ignored;
    if (!info.path.empty() && std::filesystem::is_regular_file(info.path, ignored))
        global["core:dataset"] =
            textFromFileName(std::filesystem::path(
                                 SigmfRecording::isNamedSo(info.path) ? SigmfRecording::dataPath(info.path) : info.path)
                                 .filename()
                                 .string());
    global["core:description"] = description;
    if (!json.contains("captures") || json["captures"].empty())
        json["captures"] = sigmfCaptures(info);
    if (info.sigmf.empty() && info.container == "WAV" && json["global"].contains("core:dataset"))
        if (const auto place = placeInWav(FileBytes(info.path))) {
            json["captures"][0]["core:header_bytes"] = place->headerBytes;
            if (place->trailingBytes > 0)
                json["global"]["core:trailing_bytes"] = place->trailingBytes;
        }
    json["annotations"] = Json::array();
    return json;
}

Json &addAnnotation(Json &metadata, const Annotation &box, const RecordingInfo &info)
{
    const auto numberAt = [&](double seconds) {
        const long long sample = sampleAt(seconds, info.sampleRateHz);
        const bool isInFile = info.places.end() == info.sampleCount; // and not of a derived recording
        return info.firstNumber + (isInFile ? info.places.storedAt(sample) : sample);
    };
    const long long start = numberAt(box.startSeconds);
    Json &annotation = metadata["annotations"].emplace_back();
    annotation["core:sample_start"] = start;
    annotation["core:sample_count"] = std::max(1LL, numberAt(box.endSeconds) - start);
    if (box.lowHz && box.highHz) {
        annotation["core:freq_lower_edge"] = info.centreHz + *box.lowHz;
        annotation["core:freq_upper_edge"] = info.centreHz + *box.highHz;
    }
    annotation["core:label"] = box.label;
    annotation["core:comment"] = box.note;
    return annotation;
}

std::string sigmfText(Json metadata)
{
    Json &annotations = metadata["annotations"];
    std::stable_sort(annotations.begin(), annotations.end(),
                     [](const Json &a, const Json &b) { return a["core:sample_start"] < b["core:sample_start"]; });
    return metadata.dump(2) + "\n";
}

void fillBox(const Analysis &analysis, const Event &event, Annotation &box)
{
    box.startSeconds = event.onsetSeconds;
    box.endSeconds = event.endSeconds;
    if (!analysis.grid().isSpectrum())
        return;
    box.lowHz = box.highHz = event.position.back();
    const Track *track = trackOfId(analysis.tracks, event.id);
    if (!track)
        return;
    const Axis &frequency = analysis.grid().axes.back();
    for (const std::size_t i : track->presentPoints()) {
        const double hz = frequency.value(track->lastPosition(i, frequency));
        box.lowHz = std::min(*box.lowHz, hz);
        box.highHz = std::max(*box.highHz, hz);
    }
}

std::string numberOrEmpty(const std::optional<double> &value)
{
    return value ? formatNumber(*value) : std::string();
}

std::string ravenText(const std::vector<ReviewedRow> &rows)
{
    std::string text = "Selection\tView\tChannel\tBegin Time (s)\tEnd Time (s)\tLow Freq (Hz)\tHigh Freq "
                       "(Hz)\tAnnotation\tReview\tNotes\n";
    int selection = 0;
    for (const ReviewedRow &row : rows)
        text += std::to_string(++selection) + "\tSpectrogram 1\t1\t" + formatNumber(row.box.startSeconds) + "\t"
                + formatNumber(row.box.endSeconds) + "\t" + numberOrEmpty(row.box.lowHz) + "\t"
                + numberOrEmpty(row.box.highHz) + "\t" + row.box.label + "\t" + nameOf(row.box.verdict) + "\t"
                + row.box.note + "\n";
    return text;
}

std::string audacityText(const std::vector<ReviewedRow> &rows)
{
    std::string text;
    for (const ReviewedRow &row : rows) {
        text += formatNumber(row.box.startSeconds) + "\t" + formatNumber(row.box.endSeconds) + "\t"
                + annotationText(row.box.label, row.box.verdict, row.box.note) + "\n";
        if (row.box.lowHz && row.box.highHz)
            text += "\\\t" + formatNumber(*row.box.lowHz) + "\t" + formatNumber(*row.box.highHz) + "\n";
    }
    return text;
}

std::string sigmfText(const std::vector<ReviewedRow> &rows, const RecordingInfo &info)
{
    Json json = sigmfMetadata(info, "Events found by Faintline, with their reviews");
    Json &extensions = json["global"]["core:extensions"];
    if (!extensions.is_array())
        extensions = Json::array();
    if (!std::any_of(extensions.begin(), extensions.end(),
                     [](const Json &each) { return each.is_object() && each.value("name", Json()) == "faintline"; }))
        extensions.push_back({{"name", "faintline"}, {"version", "1.0.0"}, {"optional", true}});
    for (const ReviewedRow &row : rows) {
        Json &one = addAnnotation(json, row.box, info);
        one["faintline:review"] = nameOf(row.box.verdict);
        if (row.event)
            one["faintline:statistic"] = row.event->statistic;
    }
    return sigmfText(std::move(json));
}

} // namespace faintline
