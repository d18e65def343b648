#include "app/lessons/lessonMeasures.h"

#include "app/base/VisibilityWatcher.h"
#include "app/features/evaluate/EvaluatePanel.h"
#include "app/features/inspect/WhyPanel.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "app/lessons/truthMeasures.h"
#include "app/views/WindowParts.h"
#include "app/views/WindowViews.h"
#include "base/Error.h"
#include "noise/NoiseNormaliser.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <regex>

namespace faintline {

namespace {

    using Value = std::optional<FieldValue>;
    using Measure = std::function<Value(WindowParts &)>;

    /// A measure of the analysis.
    template <class F>
    Measure ofAnalysis(F f)
    {
        return [f](WindowParts &window) -> Value {
            const auto &analysis = window.document().analysis();
            return analysis ? Value(f(*analysis)) : std::nullopt;
        };
    }

    /// A measure of the document once it has an analysis.
    Measure ofDocument(double (*f)(const Document &))
    {
        return [f](WindowParts &window) -> Value {
            return window.document().analysis() ? Value(f(window.document())) : std::nullopt;
        };
    }

    template <class F>
    Measure ofCursor(F f)
    {
        return [f](WindowParts &window) -> Value {
            const auto &cursor = window.document().viewport().cursor();
            return cursor && window.document().lineAnalysis() ? Value(f(window, *cursor)) : std::nullopt;
        };
    }

    Measure ofPlace(std::optional<double> Bench::Place::*coordinate)
    {
        return [coordinate](WindowParts &window) -> Value {
            const auto value = window.document().analysis() ? window.bench().place().*coordinate : std::nullopt;
            return value ? Value(*value) : std::nullopt;
        };
    }

    double mean(const std::vector<float> &values)
    {
        return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    }

    double shareAboveTwice(const Analysis &analysis)
    {
        constexpr Index mostFrames = 256;
        const auto cells = std::size_t(analysis.grid().size());
        std::vector<float> y(cells);
        const Index count = std::min(mostFrames, analysis.time().count);
        std::size_t above = 0;
        for (Index i = 0; i < count; ++i) {
            analysis.frames->read(i * analysis.time().count / count, 1, y);
            above += std::size_t(std::count_if(y.begin(), y.end(), [](float value) { return value > 2.0f; }));
        }
        return double(above) / double(cells * std::size_t(count));
    }

    double peak(const WindowParts &, const Document &document)
    {
        double largest = 0.0;
        for (const Event &event : document.shownEvents())
            largest = std::max(largest, event.statistic);
        return largest;
    }

    // ---- truth and tracks -------------------------------------------------------------------------------------------

    /// "line.2.followed" and its like.
    Value lineMeasure(WindowParts &window, const std::string &name)
    {
        static const std::regex pattern("line\\.([1-9])\\.(followed|tracks|seconds|peak)");
        std::smatch parts;
        if (!window.document().analysis() || !std::regex_match(name, parts, pattern))
            return {};
        const Following found = following(window.document(), std::size_t(std::stoi(parts[1])) - 1);
        if (parts[2] == "followed")
            return found.share;
        if (parts[2] == "tracks")
            return double(found.tracks);
        if (parts[2] == "peak")
            return found.peak;
        return found.seconds ? Value(*found.seconds) : std::nullopt;
    }

    bool isLineMeasure(const std::string &name)
    {
        static const std::regex pattern("line\\.([1-9])\\.(followed|tracks|seconds|peak)");
        return std::regex_match(name, pattern);
    }

    // ---- experiments ------------------------------------------------------------------------------------------------

    const std::regex &pdPattern()
    {
        static const std::regex pattern("pd\\.([1-9][0-9]?)\\.([1-9][0-9]?)");
        return pattern;
    }

    /// "pd.2.3": of the second detector at the third SNR of the experiment whose curves are shown, once it is complete.
    Value pdMeasure(WindowParts &window, const std::string &name)
    {
        std::smatch parts;
        const Experiments::Entry *shown = window.experiments().entry(window.panel<EvaluatePanel>().shown());
        if (!shown || !shown->campaign || shown->isOpen() || !std::regex_match(name, parts, pdPattern()))
            return {};
        const std::size_t snrs = shown->campaign->experiment.snrDb.size();
        const std::size_t detector = std::stoul(parts[1]) - 1, snr = std::stoul(parts[2]) - 1;
        const std::vector<CurvePoint> curve = pdCurve(*shown->campaign);
        const std::size_t point = detector * snrs + snr;
        return snr < snrs && point < curve.size() ? Value(curve[point].pd) : std::nullopt;
    }

    // ---- sequential tests -------------------------------------------------------------------------------------------

    Measure meanStages(bool hasTarget)
    {
        return [hasTarget](WindowParts &window) -> Value {
            double sum = 0.0;
            int count = 0;
            for (const auto &[run, result] : window.sequentialTests().walks())
                if (run.hasTarget == hasTarget) {
                    sum += double(result.stages);
                    ++count;
                }
            return count ? Value(sum / count) : std::nullopt;
        };
    }

    Value wrongWalks(WindowParts &window)
    {
        int wrong = 0;
        for (const auto &[run, result] : window.sequentialTests().walks())
            wrong += result.decision == (run.hasTarget ? SprtDecision::H0 : SprtDecision::H1);
        return double(wrong);
    }

    /// Mean over the steps of the displayed path.
    Value lnTransitionOfPath(WindowParts &window)
    {
        const auto &explanation = window.panel<WhyPanel>().explanation();
        if (!explanation || explanation->steps.size() < 2)
            return {};
        double sum = 0.0;
        for (auto step = explanation->steps.begin() + 1; step != explanation->steps.end(); ++step)
            sum += step->lnTransition;
        return sum / double(explanation->steps.size() - 1);
    }

    const SequentialTests::Walk *selectedWalk(WindowParts &window)
    {
        const auto &tests = window.sequentialTests();
        return tests.selected() < 0 ? nullptr : &tests.walks()[std::size_t(tests.selected())];
    }

    /// A measure of the selected walk.
    template <class F>
    Measure ofWalk(F f)
    {
        return [f](WindowParts &window) -> Value {
            const auto *walk = selectedWalk(window);
            return walk ? Value(f(*walk)) : std::nullopt;
        };
    }

    const std::map<std::string, Measure> &measures()
    {
        static const std::map<std::string, Measure> table{
            {"cursor.seconds", ofPlace(&Bench::Place::seconds)},
            {"cursor.hz", ofPlace(&Bench::Place::hz)},
            {"cursor.range", ofPlace(&Bench::Place::range)},
            {"cursor.bearing", ofPlace(&Bench::Place::bearing)},
            {"level", ofCursor([](WindowParts &window, const Viewport::Point &at) {
                 return window.workbench().input()->valueAt(at.seconds, at.hz).value_or(-1e9);
             })},
            {"statistic", ofCursor([](WindowParts &window, const Viewport::Point &at) {
                 return window.workbench().output()->valueAt(at.seconds, at.hz).value_or(-1e9);
             })},
            {"visible.seconds",
             [](WindowParts &window) -> Value { return window.document().viewport().time().width(); }},
            {"visible.hz",
             [](WindowParts &window) -> Value { return window.document().viewport().frequency().width(); }},
            {"frameSeconds", ofAnalysis([](const Analysis &analysis) { return analysis.time().step; })},
            {"binHz", ofAnalysis([](const Analysis &analysis) { return analysis.grid().axes.front().step; })},
            {"windowSeconds",
             ofAnalysis([](const Analysis &analysis) { return analysis.frames->geometry().windowSeconds; })},
            {"aboveTwice", ofAnalysis(shareAboveTwice)},
            {"threshold", [](WindowParts &window) -> Value { return window.document().shownThreshold(); }},
            {"events", [](WindowParts &window) -> Value { return double(window.document().shownEvents().size()); }},
            {"events.false", ofDocument(falseEvents)},
            {"lines.found", ofDocument(linesFound)},
            {"peak", [](WindowParts &window) -> Value { return peak(window, window.document()); }},
            {"resetFraction",
             ofAnalysis([](const Analysis &analysis) { return 1.0 - mean(analysis.continuedFraction); })},
            {"lnK", ofAnalysis([](const Analysis &analysis) { return mean(analysis.lnK); })},
            {"walks.noise", meanStages(false)},
            {"walks.target", meanStages(true)},
            {"walks.wrong", wrongWalks},
            {"walks.fixed",
             [](WindowParts &window) -> Value {
                 const auto size = window.sequentialTests().fixedSize();
                 return size ? Value(double(*size)) : std::nullopt;
             }},
            {"survey.saved",
             [](WindowParts &window) -> Value {
                 const auto &rounds = window.sequentialTests().sectorRounds();
                 return rounds ? Value(rounds->saving()) : std::nullopt;
             }},
            {"why.lnP", lnTransitionOfPath},
            {"falseAlarmsPerHour", ofAnalysis([](const Analysis &analysis) {
                 return analysis.calibration
                            ? analysis.calibration->eventRateAt(analysis.threshold) * analysis.cellFramesPerHour
                            : 0.0;
             })},
            {"walks.selected", ofWalk([](const SequentialTests::Walk &walk) {
                 return std::string(walk.first.hasTarget ? "target" : "noise");
             })},
            {"walks.stage", [](WindowParts &window) -> Value { return double(window.sequentialTests().stage()); }},
            {"walks.stages", ofWalk([](const SequentialTests::Walk &walk) { return double(walk.second.stages); })},
        };
        return table;
    }

    bool begins(const std::string &name, const char *prefix)
    {
        return name.rfind(prefix, 0) == 0;
    }

    const Field<ScanTest> *testField(const std::string &name)
    {
        return begins(name, "test.") ? scanTestField(name.substr(5)) : nullptr;
    }

    std::optional<double> numberOf(const FieldValue &value)
    {
        if (const auto *number = std::get_if<double>(&value))
            return *number;
        if (const auto *number = std::get_if<int>(&value))
            return *number;
        if (const auto *flag = std::get_if<bool>(&value))
            return *flag ? 1.0 : 0.0;
        if (const auto *numbers = std::get_if<std::vector<double>>(&value); numbers && !numbers->empty())
            return numbers->front(); // of a law h: h(0)
        return {};
    }

    bool holds(WindowParts &window, const LessonCondition::Part &part)
    {
        const Value value = lessonMeasure(window, part.measure);
        if (!value)
            return false;
        if (!part.text.empty())
            return formatFieldValue(*value) == part.text;
        const auto number = numberOf(*value);
        return number && *number >= part.low && *number <= part.high;
    }

} // namespace

Value lessonMeasure(WindowParts &window, const std::string &name)
{
    if (const auto found = measures().find(name); found != measures().end())
        return found->second(window);
    if (isLineMeasure(name))
        return lineMeasure(window, name);
    if (std::regex_match(name, pdPattern()))
        return pdMeasure(window, name);
    if (begins(name, "view.")) {
        const QWidget *view = window.views().named(QString::fromStdString(name.substr(5)));
        return view && isInSight(*view) ? 1.0 : 0.0;
    }
    if (const auto *field = testField(name))
        return field->get(window.sequentialTests().test());
    return settingField(name).get(window.document().settings());
}

void checkMeasure(const std::string &name, const std::string &where)
{
    const bool isView = begins(name, "view.") && WindowViews::names().contains(QString::fromStdString(name.substr(5)));
    if (isView || measures().contains(name) || isLineMeasure(name) || std::regex_match(name, pdPattern())
        || testField(name))
        return;
    try {
        settingField(name);
    } catch (const Error &) {
        throw Error(where, "is neither a measure nor a setting");
    }
}

bool holds(WindowParts &window, const LessonCondition &condition)
{
    return std::all_of(condition.parts.begin(), condition.parts.end(),
                       [&](const auto &part) { return holds(window, part); });
}

std::string failure(WindowParts &window, const LessonCondition &condition)
{
    for (const LessonCondition::Part &part : condition.parts)
        if (!holds(window, part)) {
            const Value value = lessonMeasure(window, part.measure);
            return part.measure + " is " + (value ? formatFieldValue(*value) : "nothing");
        }
    return {};
}

} // namespace faintline
