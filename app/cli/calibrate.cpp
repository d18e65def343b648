#include "app/cli/commands.h"

#include "analysis/Calibration.h"
#include "analysis/chooseWindow.h"
#include "analysis/surrogates.h"
#include "base/json.h"
#include "spectrum/Spectrogram.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace faintline::cli {

void addCalibrate(CLI::App &app, Common &common)
{
    struct Options {
        AnalysisOptions analysis;
        int surrogates = 0;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CLI::App *command = app.add_subcommand("calibrate", "Calibrate K for a 50 % reset probability, and thresholds with "
                                                        "their intervals, on simulated noise");
    options->analysis.addTo(*command, common);
    command->get_option("FILE")->required(false);
    command
        ->add_option("--surrogates", options->surrogates,
                     "Number of noise recordings on which to count false alarms, with FILE's length, band, gaps, "
                     "quantisation and background")
        ->check(CLI::Range(1, 10000));
    command->add_flag("--json", options->json, "Print as JSON");
    command->callback([options, &common] {
        AnalysisSettings settings = options->analysis.settings();
        std::shared_ptr<const Spectrogram> spectrogram;
        if (!options->analysis.file.empty() && leavesWindowToRecording(settings))
            settings = analyseInChosenWindow(options->analysis.recording(), settings, common.context())->settings;
        if (!options->analysis.file.empty())
            spectrogram =
                std::make_shared<Spectrogram>(options->analysis.recording(), settings.spectrogram, settings.selection);
        const auto calibration = spectrogram ? calibrateBand(settings, *spectrogram, common.context())
                                             : calibrate(settings, common.context());
        Json json{{"detector", std::string(detectorNames[settings.detector.index()])},
                  {"lnK", calibration->lnK},
                  {"continuedFraction", calibration->continuedFraction},
                  {"tailSlopePerNat", calibration->tailSlope},
                  {"statisticUnit", statisticUnit(settings.detector)}};
        Json pfa = Json::array();
        for (const double probability : {1e-3, 1e-4, 1e-5, 1e-6})
            pfa.push_back({{"pfaPerCell", probability}, {"thresholdNats", calibration->thresholdForPfa(probability)}});
        json["thresholds"] = pfa;
        if (spectrogram) {
            const double cellFramesPerHour = cellFramesInAnHour(settings.family, *spectrogram);
            const double nats = thresholdNats(settings.decide, *calibration, cellFramesPerHour);
            const double rate = calibration->eventRateAt(nats);
            const double half = calibration->thresholdUncertainty(rate);
            json["recording"] = {{"thresholdNats", nats},
                                 {"intervalNats", {nats - half, nats + half}},
                                 {"pfaPerCell", calibration->exceedanceAt(nats)},
                                 {"falseAlarmsPerHour", rate * cellFramesPerHour},
                                 {"falseAlarmsPerHourInterval",
                                  {calibration->eventRateAt(nats + half) * cellFramesPerHour,
                                   calibration->eventRateAt(nats - half) * cellFramesPerHour}}};
        }
        if (options->surrogates > 0) {
            if (options->analysis.file.empty())
                throw Error("--surrogates", "needs FILE, the recording whose noise is to be simulated");
            const SurrogateCount count =
                countOnSurrogates(options->analysis.recording(), settings, options->surrogates, common.context());
            json["surrogates"] = {
                {"runs", count.runs},
                {"hours", count.hours},
                {"orderPerHour", count.orderPerHour},
                {"thresholdNats", count.threshold},
                {"ordered", count.ordered},
                {"events", count.events},
                {"ratio", count.ratio},
                {"ratioInterval", {count.interval.low, count.interval.high}},
                {"correctionNats", count.correction},
                {"correctedThresholdNats", json["recording"]["thresholdNats"].get<double>() + count.correction}};
        }
        if (options->json) {
            std::printf("%s\n", json.dump(2).c_str());
            return;
        }
        std::printf("detector           %s\n", json["detector"].get<std::string>().c_str());
        if (std::holds_alternative<SmdSettings>(settings.detector))
            std::printf("ln K               %.4f (K = %.4f), %.1f %% of the states continued on noise\n",
                        calibration->lnK, std::exp(calibration->lnK), 100.0 * calibration->continuedFraction);
        const std::string unit(statisticUnit(settings.detector));
        for (const Json &entry : pfa)
            std::printf("Pfa per cell %.0e  threshold %.3f %s\n", entry["pfaPerCell"].get<double>(),
                        entry["thresholdNats"].get<double>(), unit.c_str());
        if (const auto found = json.find("recording"); found != json.end())
            std::printf("on this recording  threshold %.3f %s (95 %%: %.3f … %.3f), Pfa per cell %.2e, %.3g false "
                        "alarms per hour (95 %%: %.3g … %.3g)\n",
                        (*found)["thresholdNats"].get<double>(), unit.c_str(),
                        (*found)["intervalNats"][0].get<double>(), (*found)["intervalNats"][1].get<double>(),
                        (*found)["pfaPerCell"].get<double>(), (*found)["falseAlarmsPerHour"].get<double>(),
                        (*found)["falseAlarmsPerHourInterval"][0].get<double>(),
                        (*found)["falseAlarmsPerHourInterval"][1].get<double>());
        if (const auto found = json.find("surrogates"); found != json.end()) {
            const Json &s = *found;
            std::printf("surrogates         %d of %.3g h in all, counted at %.3g per hour: %d events of %.3g "
                        "specified, ratio %.2f (95 %%: %.2f … %.2f)\n",
                        s["runs"].get<int>(), s["hours"].get<double>(), s["orderPerHour"].get<double>(),
                        s["events"].get<int>(), s["ordered"].get<double>(), s["ratio"].get<double>(),
                        s["ratioInterval"][0].get<double>(), s["ratioInterval"][1].get<double>());
            if (s["correctionNats"].get<double>() == 0.0)
                std::printf("                   as specified: no correction\n");
            else
                std::printf("                   corrected threshold: --set decide.thresholdNats=%.3f\n",
                            s["correctedThresholdNats"].get<double>());
        }
    });
}

} // namespace faintline::cli
