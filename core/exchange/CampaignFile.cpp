#include "exchange/CampaignFile.h"
#include "evaluate/experiments/campaignCurve.h"

#include "base/Error.h"
#include "base/files/AtomicFile.h"
#include "base/files/checksum.h"
#include "base/json.h"
#include "base/oneLine.h"
#include "exchange/csvText.h"
#include "exchange/textTable.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

namespace faintline {

namespace {

    constexpr int fileVersion = 1;
    constexpr const char *versionKey = "faintlineCampaign";
    constexpr std::string_view curveHead = "detector,snr_db,pd,pd_low,pd_high,trials,threshold";

    std::string headOf(const Campaign &campaign)
    {
        return Json{
            {versionKey, fileVersion}, {"experiment", toJson(campaign.experiment)}, {"thresholds", campaign.thresholds}}
            .dump();
    }

    std::string lineOf(const RunOutcome &outcome)
    {
        return Json{{"run", outcome.run}, {"noise", outcome.noise}, {"signal", outcome.signal}}.dump();
    }

    /// JSON has no infinity; the maximum of an empty set is written as null.
    float floatFrom(const Json &value)
    {
        return value.is_null() ? -std::numeric_limits<float>::infinity() : value.get<float>();
    }

    std::vector<float> floatsFrom(const Json &list)
    {
        std::vector<float> values;
        for (const Json &value : list)
            values.push_back(floatFrom(value));
        return values;
    }

    RunOutcome outcomeFrom(const Json &json, const Experiment &experiment, const std::string &where)
    {
        RunOutcome outcome;
        outcome.run = runFromJson(json.at("run"), experiment, where + ": run");
        for (const Json &detector : json.at("noise"))
            outcome.noise.push_back(floatsFrom(detector));
        for (const Json &detector : json.at("signal")) {
            outcome.signal.emplace_back();
            for (const Json &snr : detector)
                outcome.signal.back().push_back(floatsFrom(snr));
        }
        return outcome;
    }

    /// Appends lines to a file. A line survives the death of the program at once, and that of the machine after a
    /// second.
    class Lines
    {
    public:
        explicit Lines(const std::string &path)
            : m_path(path), m_descriptor(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC))
        {
            if (m_descriptor < 0)
                fail();
        }
        ~Lines()
        {
            ::fdatasync(m_descriptor);
            ::close(m_descriptor);
        }
        Lines(const Lines &) = delete;
        Lines &operator=(const Lines &) = delete;

        void add(std::string line)
        {
            line += '\n';
            for (std::string_view rest = line; !rest.empty();) {
                const ssize_t written = ::write(m_descriptor, rest.data(), rest.size());
                if (written < 0 && errno != EINTR)
                    fail();
                rest.remove_prefix(std::size_t(std::max<ssize_t>(written, 0)));
            }
            if (const auto now = std::chrono::steady_clock::now(); now > m_synced + std::chrono::seconds(1)) {
                if (::fdatasync(m_descriptor) != 0)
                    fail();
                m_synced = now;
            }
        }

    private:
        [[noreturn]] void fail() const
        {
            throw Error(m_path, std::string("cannot be written: ") + std::strerror(errno), Error::Kind::Failure);
        }

        std::string m_path;
        int m_descriptor;
        std::chrono::steady_clock::time_point m_synced = std::chrono::steady_clock::now();
    };

    std::string partsPath(const std::string &path)
    {
        return path + ".part";
    }

    constexpr std::string_view checkKey = ",\"checksum\":\"";

    /// Appends to a line of JSON the checksum of the original line.
    std::string withChecksum(std::string line)
    {
        const std::string own = checksum(line);
        line.pop_back();
        return line + std::string(checkKey) + own + "\"}";
    }

    /// Whether the checksum of a line is correct.
    bool isAsWritten(const std::string &line)
    {
        const std::size_t at = line.rfind(checkKey);
        return at != std::string::npos && line == withChecksum(line.substr(0, at) + "}");
    }

    /// Of a sweep: number of false alarms and observed seconds.
    bool isCount(const std::vector<float> &noise)
    {
        constexpr float countLimitPerRun = 1e9f; // of either in one run
        return noise.size() == 2 && std::all_of(noise.begin(), noise.end(), [](float value) {
                   return value >= 0.0f && value <= countLimitPerRun;
               });
    }

    /// Every detector and SNR of the experiment must have its answers.
    void checkShape(const Campaign &campaign, const RunOutcome &outcome, const std::string &where)
    {
        const bool isSweep = campaign.experiment.isSweep();
        const std::size_t detectors = isSweep ? 1 : campaign.experiment.detectors.size();
        const std::size_t snrs = campaign.experiment.snrDb.size();
        bool isWhole = outcome.noise.size() == detectors && outcome.signal.size() == detectors;
        for (const auto &noise : outcome.noise)
            isWhole = isWhole && (isSweep ? isCount(noise) : !noise.empty());
        for (const auto &signal : outcome.signal) {
            isWhole = isWhole && signal.size() == snrs;
            for (const auto &values : signal)
                isWhole = isWhole && !values.empty();
        }
        if (!isWhole)
            throw Error(where, "must contain values for each of the " + std::to_string(detectors) + " detectors and "
                                   + std::to_string(snrs) + " SNRs");
    }

    std::string sweepCsv(const Campaign &campaign)
    {
        std::string csv = "parameter,value,pd,pd_low,pd_high,trials,false_alarms,hours,false_alarms_per_hour,false_"
                          "alarms_low,false_alarms_high,"
                          "latency_s,latency_low,latency_high,threshold\n";
        const std::string &parameter = campaign.experiment.parameter;
        for (const SweepPoint &point : sweepCurve(campaign)) {
            csv += parameter;
            for (const double number :
                 {point.value, point.pd, point.pdInterval.low, point.pdInterval.high, double(point.trials),
                  double(point.falseAlarms), point.hours, point.falseAlarmsPerHour, point.falseAlarmInterval.low,
                  point.falseAlarmInterval.high})
                csv += ',' + formatNumber(number);
            for (const double number : {point.latencySeconds, point.latencyInterval.low, point.latencyInterval.high})
                csv += ',' + (point.detections > 0 ? formatNumber(number) : std::string());
            csv += ',' + formatNumber(point.threshold) + "\n";
        }
        return csv;
    }

    /// The last cell, the threshold, may be empty.
    CurvePoint pointFrom(const TextTable &row)
    {
        constexpr double mostTrials = 1e15;
        std::vector<std::optional<double>> values;
        for (std::ptrdiff_t column = 1; column < 7; ++column)
            values.push_back(parseNumber(row.cell(column)));
        const auto isProbability = [](const std::optional<double> &value) {
            return value && *value >= 0.0 && *value <= 1.0;
        };
        if (row.size() != 7 || !values[0] || !std::isfinite(*values[0])
            || !std::all_of(values.begin() + 1, values.begin() + 4, isProbability)
            || !(values[4] && *values[4] >= 0.0 && *values[4] <= mostTrials))
            throw Error(row.place(), "must be " + std::string(curveHead));
        return {row.cell(0), *values[0], *values[1], {*values[2], *values[3]}, std::int64_t(*values[4]), values[5]};
    }

    void writeParts(const Campaign &campaign, const std::string &parts)
    {
        std::string text = withChecksum(headOf(campaign)) + "\n";
        for (const RunOutcome &outcome : campaign.outcomes)
            text += withChecksum(lineOf(outcome)) + "\n";
        writeTextFile(parts, text);
    }

    /// Reads what a killed run left, without damaged lines: their runs are repeated. Empty if the first line is not
    /// ours.
    std::optional<Campaign> readParts(const std::string &parts)
    {
        std::ifstream file(parts);
        std::string line;
        if (!std::filesystem::is_regular_file(parts) || !std::getline(file, line) || !isAsWritten(line))
            return std::nullopt;
        std::string text = line + "\n";
        while (std::getline(file, line) && !file.eof())
            if (isAsWritten(line))
                text += line + "\n";
        writeTextFile(parts, text);
        return readCampaign(parts);
    }

} // namespace

void writeCampaign(const Campaign &campaign, const std::string &path)
{
    std::string text = headOf(campaign) + "\n";
    for (const RunOutcome &outcome : campaign.outcomes)
        text += lineOf(outcome) + "\n";
    writeTextFile(path, text);
}

Campaign readCampaign(const std::string &path)
{
    std::ifstream file(path);
    if (!file)
        throw Error(path, std::string("cannot be read: ") + std::strerror(errno));
    if (std::error_code code; !std::filesystem::is_regular_file(path, code))
        throw Error(path, "is not a file; expected a file of campaign runs");
    std::string line;
    std::getline(file, line);
    const Json head = parseJson(line, path + ", line 1");
    if (!head.is_object() || head.value(versionKey, Json()) != fileVersion || !head.contains("experiment")
        || !head.contains("thresholds"))
        throw Error(path, "is not a campaign: its first line must contain " + std::string(versionKey)
                              + ", experiment and thresholds");
    Campaign campaign{experimentFromJson(head["experiment"], path), {}, {}};
    campaign.thresholds =
        readingJson(path + ", line 1: thresholds", [&] { return head["thresholds"].get<std::vector<double>>(); });
    for (int number = 2; std::getline(file, line); ++number) {
        if (file.eof())
            break; // no line end: truncated
        try {
            const std::string where = path + ", line " + std::to_string(number);
            campaign.outcomes.push_back(outcomeFrom(parseJson(line, where), campaign.experiment, where));
            checkShape(campaign, campaign.outcomes.back(), where);
        } catch (const nlohmann::json::exception &) {
            throw Error(path + ", line " + std::to_string(number),
                        "must be {\"run\": …, \"noise\": [[…]], \"signal\": [[[…]]]}");
        }
    }
    return campaign;
}

bool isCampaignFile(const std::string &path)
{
    std::ifstream file(path);
    std::string beginning(64, '\0');
    file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
    return beginning.find(versionKey) != std::string::npos;
}

bool isCurveFile(const std::string &path)
{
    std::ifstream file(path);
    std::string beginning(curveHead.size(), '\0');
    file.read(beginning.data(), std::ssize(beginning));
    return beginning == curveHead;
}

void writeCurve(const Campaign &campaign, const std::string &path)
{
    if (campaign.experiment.isSweep())
        return writeTextFile(path, sweepCsv(campaign));
    std::string csv = std::string(curveHead) + "\n";
    for (const CurvePoint &point : pdCurve(campaign))
        csv += csvText(oneLine(point.detector)) + "," + formatNumber(point.snrDb) + "," + formatNumber(point.pd) + ","
               + formatNumber(point.interval.low) + "," + formatNumber(point.interval.high) + ","
               + std::to_string(point.trials) + "," + (point.threshold ? formatNumber(*point.threshold) : std::string())
               + "\n";
    writeTextFile(path, csv);
}

void writeRoc(const Campaign &campaign, std::size_t snr, const std::string &path)
{
    const bool isInBlocks = campaign.experiment.isLines();
    std::string csv = "detector,snr_db,threshold,";
    csv += isInBlocks ? "false_alarms_per_block" : "false_alarm_probability";
    csv += ",pd,pd_low,pd_high\n";
    const std::vector<DetectorUnderTest> &detectors = campaign.experiment.detectors;
    const std::string snrDb = formatNumber(campaign.experiment.snrDb.at(snr));
    for (std::size_t d = 0; d < detectors.size(); ++d)
        for (const RocPoint &point : rocPoints(campaign, d, snr)) {
            csv += csvText(oneLine(detectors[d].name)) + "," + snrDb;
            for (const double number :
                 {point.threshold, point.falseAlarms, point.pd, point.interval.low, point.interval.high})
                csv += "," + formatNumber(number);
            csv += "\n";
        }
    writeTextFile(path, csv);
}

std::vector<CurvePoint> readCurve(const std::string &path)
{
    const std::string text = readTableText(path);
    if (!text.starts_with(curveHead))
        throw Error(path, "is not a curve: its first line must be " + std::string(curveHead));
    TextTable table(path, text, true);
    std::vector<CurvePoint> curve;
    while (table.next())
        curve.push_back(pointFrom(table));
    if (curve.empty())
        throw Error(path, "holds no points of a curve");
    return curve;
}

Campaign carryOutResumably(const Experiment &experiment, const std::vector<int> &runs, const std::string &path,
                           const RunContext &context)
{
    const std::string parts = partsPath(path);
    std::optional<Campaign> begun = readParts(parts);
    if (begun && !(begun->experiment == experiment))
        throw Error(parts, "contains runs of a different experiment; remove it or choose another name for the result");
    const auto trials = prepareTrials(experiment, openRecordingOf(experiment), context.part(0.0, 0.1));
    Campaign campaign = begun ? std::move(*begun) : Campaign{experiment, trials->thresholds(), {}};
    if (!begun)
        writeParts(campaign, parts);
    Lines lines(parts);
    carryOut(campaign, runs, *trials, context.part(0.1, 1.0),
             [&](const RunOutcome &outcome) { lines.add(withChecksum(lineOf(outcome))); });
    return campaign;
}

void removeParts(const std::string &path)
{
    std::error_code ignored;
    std::filesystem::remove(partsPath(path), ignored);
}

} // namespace faintline
