#include "app/cli/speed/measureSpeed.h"

#include "base/json.h"
#include "base/multiversion.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace faintline {

namespace {

    struct Seconds {
        double clock = 0.0;
        double processor = 0.0;

        static Seconds now()
        {
            timespec used{};
            clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
            return {std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(),
                    double(used.tv_sec) + 1e-9 * double(used.tv_nsec)};
        }
    };

    /// Seconds per item in one round.
    Seconds timeOf(const SpeedForm &form, double atLeast)
    {
        const Seconds start = Seconds::now();
        Seconds end = start;
        double items = 0.0;
        do {
            form.run();
            items += form.items;
            end = Seconds::now();
        } while (end.clock - start.clock < atLeast);
        return {(end.clock - start.clock) / items, (end.processor - start.processor) / items};
    }

    double quantile(std::vector<double> values, double fraction)
    {
        std::sort(values.begin(), values.end());
        const double position = fraction * double(values.size() - 1);
        const auto lower = std::size_t(position);
        const std::size_t upper = std::min(lower + 1, values.size() - 1);
        return values[lower] + (position - double(lower)) * (values[upper] - values[lower]);
    }

    std::size_t indexOf(const std::vector<SpeedForm> &forms, const std::string &name)
    {
        const auto found =
            std::find_if(forms.begin(), forms.end(), [&](const SpeedForm &form) { return form.name == name; });
        return std::size_t(found - forms.begin());
    }

    std::string rateText(double perSecond)
    {
        const char *const prefixes[] = {"", "k", "M", "G"};
        int prefix = 0;
        for (; prefix < 3 && perSecond >= 1000.0; ++prefix)
            perSecond /= 1000.0;
        char text[32];
        std::snprintf(text, sizeof text, "%.3g %s", perSecond, prefixes[prefix]);
        return text;
    }

} // namespace

SpeedResult measureSpeed(const SpeedKernel &kernel, const SpeedOptions &options, const RunContext &context)
{
    SpeedResult result{kernel.name, kernel.title, kernel.unit, {}, {}, {}};
    for (const SpeedCheck &check : kernel.checks)
        result.checks.push_back({check.what, check.largest, check.measure()});
    const std::vector<SpeedForm> forms = kernel.make();
    for (const SpeedForm &form : forms)
        form.run(); // memory and caches are warm before the clock starts
    std::vector<std::vector<Seconds>> times(forms.size());
    for (int round = 0; round < options.rounds; ++round)
        for (std::size_t i = 0; i < forms.size(); ++i) {
            context.checkpoint(double(round) / options.rounds, kernel.name);
            times[i].push_back(timeOf(forms[i], options.secondsPerForm));
        }
    for (std::size_t i = 0; i < forms.size(); ++i) {
        std::vector<double> rates;
        for (const Seconds &seconds : times[i])
            rates.push_back(1.0 / (forms[i].threads > 1 ? seconds.clock : seconds.processor));
        result.rates.push_back({forms[i].name, quantile(rates, 0.5)});
    }
    for (const SpeedGoal &goal : kernel.goals) {
        const std::size_t fast = indexOf(forms, goal.faster);
        const std::size_t slow = indexOf(forms, goal.slower);
        const bool byClock = forms[fast].threads > 1 || forms[slow].threads > 1;
        std::vector<double> ratios;
        for (std::size_t round = 0; round < times[fast].size(); ++round)
            ratios.push_back(byClock ? times[slow][round].clock / times[fast][round].clock
                                     : times[slow][round].processor / times[fast][round].processor);
        result.ratios.push_back({goal, quantile(ratios, 0.5), quantile(ratios, 0.25), quantile(ratios, 0.75)});
    }
    return result;
}

std::string instructionSet()
{
#ifdef FAINTLINE_HAS_VERSIONS
    return vectorBytes() == 64 ? "AVX-512" : vectorBytes() == 32 ? "AVX2" : "SSE2";
#else
    return "the compiler's default";
#endif
}

std::string speedText(const SpeedResult &result)
{
    std::string text = result.name + ": " + result.title + "\n";
    char line[256];
    for (const SpeedResult::Rate &rate : result.rates) {
        std::snprintf(line, sizeof line, "    %-26s %12s%ss/s\n", rate.form.c_str(), rateText(rate.perSecond).c_str(),
                      result.unit.c_str());
        text += line;
    }
    for (const SpeedResult::Ratio &r : result.ratios) {
        std::snprintf(line, sizeof line, "    %-42s %8.2f  (%.2f … %.2f)   goal ≥ %-5.4g %s\n",
                      (r.goal.faster + " over " + r.goal.slower).c_str(), r.measured, r.low, r.high, r.goal.ratio,
                      r.measured >= r.goal.ratio ? "met" : "MISSED");
        text += line;
    }
    for (const SpeedResult::Checked &c : result.checks) {
        std::snprintf(line, sizeof line, "    %-58s %8.2g   goal ≤ %-5.2g %s\n", c.what.c_str(), c.measured, c.largest,
                      c.measured <= c.largest ? "met" : "MISSED");
        text += line;
    }
    return text;
}

std::string speedJson(const std::vector<SpeedResult> &results, const SpeedOptions &options)
{
    Json json;
    json["instructionSet"] = instructionSet();
    json["rounds"] = options.rounds;
    json["kernels"] = Json::array();
    for (const SpeedResult &result : results) {
        Json kernel;
        kernel["name"] = result.name;
        kernel["title"] = result.title;
        kernel["unit"] = result.unit;
        for (const SpeedResult::Rate &rate : result.rates)
            kernel["perSecond"][rate.form] = rate.perSecond;
        kernel["ratios"] = Json::array();
        for (const SpeedResult::Ratio &r : result.ratios)
            kernel["ratios"].push_back({{"of", r.goal.faster},
                                        {"over", r.goal.slower},
                                        {"goal", r.goal.ratio},
                                        {"measured", r.measured},
                                        {"quartiles", {r.low, r.high}},
                                        {"met", r.measured >= r.goal.ratio}});
        kernel["checks"] = Json::array();
        for (const SpeedResult::Checked &c : result.checks)
            kernel["checks"].push_back(
                {{"what", c.what}, {"largest", c.largest}, {"measured", c.measured}, {"met", c.measured <= c.largest}});
        json["kernels"].push_back(kernel);
    }
    return json.dump(2);
}

} // namespace faintline
