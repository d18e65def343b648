#include "app/cli/commands.h"
#include "app/cli/inRange.h"

#include "analyse/analyse.h"
#include "analyse/chooseWindow.h"
#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "calibrate/CalibrationRequest.h"
#include "calibrate/CalibrationStore.h"
#include "calibrate/calibrate.h"
#include "calibrate/falseAlarmWords.h"
#include "calibrate/keptCalibration.h"
#include "frames/Spectrogram.h"
#include "inspect/surrogates.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

namespace faintline::cli {

namespace {

    struct CalibrateOptions {
        AnalysisOptions analysis;
        int surrogates = 0;
        bool json = false;
        std::string shipped;
    };

    Json toJson(const Calibration &calibration, const DetectorSettings &detector)
    {
        Json json{{"detector", std::string(detectorNames[detector.index()])},
                  {"lnK", calibration.lnK},
                  {"continuedFraction", calibration.continuedFraction},
                  {"tailSlopePerNat", calibration.tailSlope},
                  {"statisticUnit", statisticUnit(detector)}};
        Json pfa = Json::array();
        for (const double probability : {1e-3, 1e-4, 1e-5, 1e-6})
            pfa.push_back({{"pfaPerCell", probability}, {"thresholdNats", calibration.thresholdForPfa(probability)}});
        json["thresholds"] = pfa;
        return json;
    }

    /// The calibration applied to a recording: threshold and false alarms per hour.
    Json onRecording(const Calibration &calibration, const AnalysisSettings &settings, const Spectrogram &spectrogram)
    {
        const double cellFramesPerHour = cellFramesInAnHour(settings, spectrogram);
        const double nats = thresholdNats(settings.decide, calibration, cellFramesPerHour);
        const double rate = calibration.eventRateAt(nats);
        const double half = calibration.thresholdUncertainty(rate);
        return {{"thresholdNats", nats},
                {"intervalNats", {nats - half, nats + half}},
                {"pfaPerCell", calibration.exceedanceAt(nats)},
                {"falseAlarmsPerHour", rate * cellFramesPerHour},
                {"falseAlarms", falseAlarmWords(rate * cellFramesPerHour, calibration.rateUncertaintyAt(nats))},
                {"falseAlarmsPerHourInterval",
                 {calibration.eventRateAt(nats + half) * cellFramesPerHour,
                  calibration.eventRateAt(nats - half) * cellFramesPerHour}}};
    }

    /// `threshold`: the threshold that the counts correct, nat.
    Json toJson(const SurrogateCount &count, double threshold)
    {
        return {{"runs", count.runs},
                {"hours", count.hours},
                {"orderPerHour", count.orderPerHour},
                {"thresholdNats", count.threshold},
                {"ordered", count.ordered},
                {"events", count.events},
                {"ratio", count.ratio},
                {"ratioInterval", {count.interval.low, count.interval.high}},
                {"correctionNats", count.correction},
                {"correctedThresholdNats", threshold + count.correction}};
    }

    void printThresholds(const Json &json, const DetectorSettings &detector)
    {
        std::printf("detector           %s\n", json["detector"].get<std::string>().c_str());
        const auto lnK = json["lnK"].get<double>();
        if (std::holds_alternative<SmdSettings>(detector))
            std::printf("ln K               %.4f (K = %.4f), %.1f %% of the states continued on noise\n", lnK,
                        std::exp(lnK), 100.0 * json["continuedFraction"].get<double>());
        const std::string unit(statisticUnit(detector));
        for (const Json &entry : json["thresholds"])
            std::printf("Pfa per cell %.0e  threshold %.3f %s\n", entry["pfaPerCell"].get<double>(),
                        entry["thresholdNats"].get<double>(), unit.c_str());
    }

    void printRecording(const Json &found, const std::string &unit)
    {
        std::printf("on this recording  threshold %.3f %s (95 %%: %.3f … %.3f), Pfa per cell %.2e, false alarms on "
                    "noise: %s\n",
                    found["thresholdNats"].get<double>(), unit.c_str(), found["intervalNats"][0].get<double>(),
                    found["intervalNats"][1].get<double>(), found["pfaPerCell"].get<double>(),
                    found["falseAlarms"].get<std::string>().c_str());
    }

    void printSurrogates(const Json &s)
    {
        std::printf(
            "surrogates         %d of %.3g h in all, counted at %.3g per hour: %d events of %.3g specified, ratio "
            "%.2f (95 %%: %.2f … %.2f)\n",
            s["runs"].get<int>(), s["hours"].get<double>(), s["orderPerHour"].get<double>(), s["events"].get<int>(),
            s["ordered"].get<double>(), s["ratio"].get<double>(), s["ratioInterval"][0].get<double>(),
            s["ratioInterval"][1].get<double>());
        if (s["correctionNats"].get<double>() == 0.0)
            std::printf("                   as specified: no correction\n");
        else
            std::printf("                   corrected threshold: --set decide.thresholdNats=%.3f\n",
                        s["correctedThresholdNats"].get<double>());
    }

    void print(const Json &json, const DetectorSettings &detector)
    {
        printThresholds(json, detector);
        if (json.contains("recording"))
            printRecording(json["recording"], std::string(statisticUnit(detector)));
        if (json.contains("surrogates"))
            printSurrogates(json["surrogates"]);
    }

    /// Makes the calibrations in the files of a folder again, from their keys: those of wide bands first, from which
    /// those of narrow ones start.
    void makeShipped(const std::filesystem::path &folder, const Common &common)
    {
        if (!std::filesystem::is_directory(folder))
            throw Error(folder.string(), "is not a folder of calibrations");
        std::vector<std::pair<CalibrationRequest, std::string>> files;
        for (const auto &entry : std::filesystem::directory_iterator(folder))
            if (const std::string path = entry.path().string(); path.ends_with(".json"))
                files.emplace_back(requestOf(readJsonFile(path).value("key", "")), path);
        std::sort(files.begin(), files.end(), [](const auto &a, const auto &b) {
            return std::pair(a.first.bins, a.second) < std::pair(b.first.bins, b.second);
        });
        for (const auto &[request, path] : files) {
            const std::clock_t begin = std::clock();
            const auto calibration = makeCalibration(request, thoroughEffort(), common.context());
            rememberCalibration(request.key(), calibration);
            writeTextFile(path, CalibrationStore::toText(request.key(), *calibration));
            std::printf("%s: %.1f s of processor time\n", path.c_str(), double(std::clock() - begin) / CLOCKS_PER_SEC);
            std::fflush(stdout);
        }
    }

    void calibrateFor(const CalibrateOptions &options, const Common &common)
    {
        if (!options.shipped.empty())
            return makeShipped(options.shipped, common);
        const bool hasFile = !options.analysis.file.empty();
        AnalysisSettings settings = options.analysis.settings();
        std::shared_ptr<const Spectrogram> spectrogram;
        if (hasFile && leavesWindowToRecording(settings))
            settings = analyse(options.analysis.recording(), settings, {}, common.context())->settings;
        if (hasFile)
            spectrogram =
                std::make_shared<Spectrogram>(options.analysis.recording(), settings.spectrogram, settings.selection);
        const auto calibration = spectrogram ? calibrateBand(settings, *spectrogram, common.context())
                                             : calibrate(settings, common.context());
        Json json = toJson(*calibration, settings.detector);
        if (spectrogram)
            json["recording"] = onRecording(*calibration, settings, *spectrogram);
        if (options.surrogates > 0 && !hasFile)
            throw Error("--surrogates", "needs FILE, the recording whose noise is to be simulated");
        if (options.surrogates > 0)
            json["surrogates"] =
                toJson(countOnSurrogates(options.analysis.recording(), settings, options.surrogates, common.context()),
                       json["recording"]["thresholdNats"].get<double>());
        if (options.json)
            std::printf("%s\n", json.dump(2).c_str());
        else
            print(json, settings.detector);
    }

} // namespace

void addCalibrate(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<CalibrateOptions>();
    CLI::App *command = app.add_subcommand("calibrate", "Calibrate K for a 50 % reset probability, and thresholds with "
                                                        "their intervals, on simulated noise");
    options->analysis.addTo(*command, common);
    command->get_option("FILE")->required(false);
    command
        ->add_option("--surrogates", options->surrogates,
                     "Number of noise recordings on which to count false alarms, with FILE's length, band, gaps, "
                     "quantisation and background")
        ->check(inRange(1, 10000));
    command->add_flag("--json", options->json, "Print as JSON");
    // For maintenance, so not in the help: plan/calibrationVersion.h.
    addOutput(*command, common, "--shipped", options->shipped, "Folder whose calibrations are made again")->group("");
    command->callback([options, &common] { calibrateFor(*options, common); });
}

} // namespace faintline::cli
