#include "app/cli/commands.h"
#include "app/cli/inRange.h"
#include "app/cli/provenance.h"

#include "analyse/analyse.h"
#include "analyse/events.h"
#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"
#include "base/numberText.h"
#include "exchange/writeChart.h"
#include "exchange/writeDoppler.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>

namespace faintline::cli {

namespace {

    struct DopplerOptions {
        AnalysisOptions analysis;
        std::vector<int> events; ///< none: the strongest that determines a pass
        std::string medium = "air";
        std::optional<double> propagation;
        std::optional<double> centreHz;
        std::string out;
        std::string chart;
    };

    const std::map<std::string, double> media{
        {"air", propagation::air}, {"water", propagation::water}, {"light", propagation::light}};

    void checkNames(const DopplerOptions &options)
    {
        if (!options.out.empty())
            checkEnding(options.out, {".json", ".csv"});
        if (!options.chart.empty())
            checkEnding(options.chart, {".svg"});
        checkOutputs({options.out, options.chart});
    }

    std::shared_ptr<const Analysis> analysed(const DopplerOptions &options, const RunContext &context)
    {
        const AnalysisSettings settings = options.analysis.settings();
        const OpenedSource opened = options.analysis.opened(settings, context);
        return options.analysis.numbered(analyse(opened, settings, {}, context));
    }

    double centreOf(const DopplerOptions &options, const Analysis &analysis)
    {
        const std::optional<double> centreHz = options.centreHz ? options.centreHz : centreOfFrames(analysis);
        if (!centreHz)
            throw Error(options.analysis.file, "is I/Q and does not say its centre frequency; the fit needs absolute "
                                               "frequencies, so give --centre HZ");
        return *centreHz;
    }

    using Fit = std::function<DopplerReport(std::vector<Event> events)>;

    /// The fit of one event that determines a pass, or why there is none.
    struct Attempt {
        std::optional<DopplerReport> report;
        std::string whyNot;
    };

    Attempt attempt(const Fit &fit, const Event &event)
    {
        try {
            DopplerReport report = fit({event});
            if (!report.fit.isDetermined())
                return {{}, "intervals of the fit are open; " + dopplerNotes(report).front()};
            return {std::move(report), {}};
        } catch (const Error &error) {
            return {{}, error.what()};
        }
    }

    /// The strongest event whose track determines a pass. Throws Error if there is none.
    DopplerReport strongestFitted(const DopplerOptions &options, const Analysis &analysis, const Fit &fit)
    {
        const int strongest = chosenEvent(analysis, 0).id;
        std::vector<Event> found = events(analysis);
        std::ranges::stable_sort(found, std::ranges::greater(), &Event::statistic);
        std::string whyNot;
        for (const Event &event : found) {
            Attempt one = attempt(fit, event);
            if (one.report)
                return std::move(*one.report);
            if (event.id == strongest)
                whyNot = std::move(one.whyNot);
        }
        const std::string number = std::to_string(strongest);
        throw Error(options.analysis.file, "none of " + std::to_string(found.size()) + " events can be fitted; event "
                                               + number + ", the strongest (--event " + number + "): " + whyNot);
    }

    /// "; events 2, 5 can be fitted"
    std::string whichCanBe(const Analysis &analysis, const Fit &fit)
    {
        constexpr int most = 10;
        std::string numbers;
        int count = 0;
        for (const Event &event : events(analysis)) {
            if (!attempt(fit, event).report)
                continue;
            if (++count > most)
                break;
            numbers += (numbers.empty() ? "" : ", ") + std::to_string(event.id);
        }
        if (count == 0)
            return analysis.tracks.size() > 1 ? "; no other event can be fitted either" : "";
        return (count == 1 ? "; event " : "; events ") + numbers + (count > most ? " …" : "") + " can be fitted";
    }

    DopplerReport reportOf(const DopplerOptions &options, const Analysis &analysis)
    {
        const Fit fit = [&, centreHz = centreOf(options, analysis)](std::vector<Event> chosen) {
            return dopplerReport(analysis, std::move(chosen), centreHz,
                                 options.propagation.value_or(media.at(options.medium)));
        };
        if (options.events.empty())
            return strongestFitted(options, analysis, fit);
        std::vector<Event> chosen;
        for (const int number : options.events)
            chosen.push_back(chosenEvent(analysis, number));
        try {
            return fit(chosen);
        } catch (const Error &error) {
            throw Error(error.where(), error.why() + whichCanBe(analysis, fit), error.kind());
        }
    }

    /// ", the strongest of 3 that can be fitted"
    std::string howChosen(const DopplerReport &report, const Analysis &analysis)
    {
        const bool isStrongest = report.events.front().id == chosenEvent(analysis, 0).id;
        return ", the strongest of " + std::to_string(analysis.tracks.size())
               + (isStrongest ? "" : " that can be fitted");
    }

    void print(const DopplerReport &report, bool isChosen, const Analysis &analysis)
    {
        const DopplerFit &fit = report.fit;
        const std::vector<DopplerPoint> &points = report.track.points;
        const double step = points.size() > 1 ? points[1].seconds - points[0].seconds : 0.0;
        std::printf("%s %s%s: %s … %s s, %zu points\n", report.events.size() == 1 ? "event" : "events",
                    eventNumbers(report).c_str(), isChosen ? "" : howChosen(report, analysis).c_str(),
                    formatToStep(points.front().seconds, step, 6).c_str(),
                    formatToStep(points.back().seconds, step, 6).c_str(), points.size());
        std::printf("%-28s %-5s %16s   %s\n", "parameter", "unit", "estimate", "90 % interval");
        for (const DopplerRow &row : dopplerRows(fit))
            std::printf("%-28s %-5s %16s   %s\n", row.name.c_str(), row.unit.c_str(),
                        valueText(row.value, row.bounds).c_str(), boundsText(row.bounds).c_str());
        std::printf("%-28s %-5s %16s\n", "  heard at", "s", valueText(fit.heardSeconds(), fit.closestSeconds).c_str());
        std::printf("%-28s %-5s %16.4g\n", "  slope there", "Hz/s", fit.slopeHzPerSecond());
        std::printf(
            "residuals: rms %.3g Hz, %.3g times the track's own errors; they count as %.0f independent points\n",
            fit.rmsHz, fit.deviationScale, fit.effectivePoints);
        if (report.centreHz != 0.0)
            std::printf("note: %s Hz, the centre frequency, is added to the frequencies of the events.\n",
                        formatPlainly(report.centreHz).c_str());
        for (const std::string &sentence : dopplerNotes(report))
            std::printf("note: %s\n", sentence.c_str());
    }

    void doppler(const DopplerOptions &options, const Common &common)
    {
        checkNames(options);
        const auto analysis = analysed(options, common.context());
        const DopplerReport report = reportOf(options, *analysis);
        CommitTogether files;
        writeProvenance(common, options.analysis.inputs(), {options.out, options.chart});
        if (!options.out.empty())
            writeDoppler(report, options.out);
        if (!options.chart.empty())
            writeTextFile(options.chart, chartsSvg(dopplerCharts(report)));
        files.commit();
        print(report, !options.events.empty(), *analysis);
    }

} // namespace

void addDoppler(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<DopplerOptions>();
    CLI::App *command = app.add_subcommand("doppler", "Fit a source that passes at constant speed to an event's track: "
                                                      "rest frequency, speed, range, closest approach");
    options->analysis.addTo(*command, common);
    command
        ->add_option(
            "--event", options->events,
            "Number of the event, as 'detect' lists it; may be repeated for the pieces of one pass; by default "
            "the strongest whose track determines a pass")
        ->take_all()
        ->allow_extra_args(false)
        ->check(inRange(1, 1000000000));
    CLI::Option *medium =
        command->add_option("--medium", options->medium, "Speed of propagation: air (343 m/s), water (1500), light")
            ->check(CLI::IsMember({"air", "water", "light"}))
            ->capture_default_str();
    command->add_option("--speed-of-sound", options->propagation, "Speed of propagation, m/s")
        ->check(inRange(1e-3, 1e12))
        ->excludes(medium);
    command
        ->add_option("--centre", options->centreHz,
                     "Frequency that corresponds to 0 Hz, Hz; by default that of the file, which I/Q requires")
        ->check(inRange(0.0, 1e15));
    addOutput(*command, common, "--out", options->out, "Write the fit: .json, or .csv for the points and residuals");
    addOutput(*command, common, "--chart", options->chart,
              "Chart of the track, the fit and the residuals to write, .svg");
    command->callback([options, &common] { doppler(*options, common); });
}

} // namespace faintline::cli
