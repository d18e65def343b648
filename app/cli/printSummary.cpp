#include "app/cli/printSummary.h"

#include "analyse/events.h"
#include "analyse/regulation.h"
#include "base/numberText.h"
#include "base/oneLine.h"
#include "calibrate/falseAlarmWords.h"
#include "inspect/advice.h"
#include "inspect/noiseLaw.h"
#include "plan/makeDetector.h"
#include "refine/subtractLines.h"

#include <cstdio>
#include <set>

namespace faintline::cli {

std::string secondsOf(double seconds, const Axis &time)
{
    return formatToStep(seconds, time.step, 6);
}

std::string positionText(double position, const Axis &axis)
{
    return formatToStep(position, axis.step, 8);
}

namespace {

    void printThreshold(const Analysis &analysis)
    {
        const DetectorSettings &detector = analysis.settings.detector;
        const std::string unit(statisticUnit(detector));
        std::printf("ln K %.4f (%.1f %% of noise states continued%s), threshold %.2f %s", analysis.calibration->lnK,
                    100.0 * analysis.calibration->continuedFraction,
                    isScoreOfPaths(detector) ? "" : ", of the detector that guides the tracks", analysis.threshold,
                    unit.c_str());
        const double perHour = analysis.calibration->eventRateAt(analysis.threshold) * analysis.cellFramesPerHour;
        std::printf(", false alarms on noise: %s\n",
                    falseAlarmWords(perHour, analysis.calibration->rateUncertaintyAt(analysis.threshold)).c_str());
    }

    void printWarnings(const Analysis &analysis, const std::vector<std::string> &notes)
    {
        if (const std::vector<Index> dragged = draggedFrames(analysis); !dragged.empty())
            std::printf("warning: ln K left its noise band %.3f … %.3f in %zu frame(s), the first at %s s; strong "
                        "signals lower it\n",
                        analysis.lnKBand.low(), analysis.lnKBand.high(), dragged.size(),
                        secondsOf(analysis.time().value(double(dragged.front())), analysis.time()).c_str());
        if (const auto law = checkNoiseLaw(analysis); law && !law->isFollowed())
            std::printf("warning: %s\n", law->warning().c_str());
        for (const std::string &note : notes)
            std::printf("note: %s\n", oneLine(note).c_str());
        for (const Advice &advice : advise(analysis))
            std::printf("note: %s%s%s\n", advice.sentence.c_str(), advice.remedy.empty() ? "" : "; ",
                        advice.remedy.c_str());
    }

    /// " Hz"; nothing for an axis without a unit.
    std::string withBlank(const std::string &unit)
    {
        return unit.empty() ? unit : ' ' + oneLine(unit);
    }

    void printEvent(const Analysis &analysis, const Event &e)
    {
        const DetectorSettings &detector = analysis.settings.detector;
        std::printf("%5d  %s … %s s, detected at %s s, at", e.id, secondsOf(e.onsetSeconds, analysis.time()).c_str(),
                    secondsOf(e.endSeconds, analysis.time()).c_str(),
                    secondsOf(e.detectSeconds, analysis.time()).c_str());
        for (std::size_t axis = 0; axis < e.position.size(); ++axis)
            std::printf(" %s%s", positionText(e.position[axis], analysis.grid().axes[axis]).c_str(),
                        withBlank(analysis.grid().axes[axis].unit).c_str());
        for (std::size_t axis = 0; axis < e.position.size(); ++axis)
            std::printf(", %s%.3g%s/s", axis == 0 ? "drift " : "", e.ratesPerSecond[axis],
                        withBlank(analysis.grid().axes[axis].unit).c_str());
        std::printf(", %.*f %s%s%s%s", statisticDecimals(detector), e.statistic,
                    std::string(statisticUnit(detector)).c_str(), e.isConfirmed ? "" : ", not confirmed",
                    e.isOpen ? ", present at the end" : "",
                    analysis.isBank() ? (e.model == 0 ? ", non-manoeuvring" : ", manoeuvring") : "");
        if (trackOfId(analysis.tracks, e.id)->windowSeconds > 0.0)
            std::printf(", found with a window of %.4g s", e.windowSeconds);
        if (e.isSubtracted)
            std::printf(", subtracted");
        std::printf("\n");
    }

    void printAreas(const Analysis &analysis)
    {
        const std::vector<AreaEvent> areas = areaEvents(analysis);
        if (areas.empty())
            return;
        std::printf("%zu area(s) of raised level without a line\n", areas.size());
        const std::string unit = oneLine(analysis.grid().axes.back().unit);
        for (const AreaEvent &area : areas)
            std::printf("       %s … %s s, %s … %s %s, %.1f dB or more above the noise\n",
                        secondsOf(area.onsetSeconds, analysis.time()).c_str(),
                        secondsOf(area.endSeconds, analysis.time()).c_str(),
                        positionText(area.low, analysis.grid().axes.back()).c_str(),
                        positionText(area.high, analysis.grid().axes.back()).c_str(), unit.c_str(), area.levelDb);
    }

    /// ", 11 of them overtones of 4 calls", or nothing.
    std::string callWords(const std::vector<Event> &events)
    {
        std::set<int> calls;
        std::size_t overtones = 0;
        for (const Event &event : events)
            if (event.call != 0) {
                calls.insert(event.call);
                ++overtones;
            }
        return calls.empty() ? std::string()
                             : ", " + std::to_string(overtones) + " of them overtones of "
                                   + std::to_string(calls.size()) + (calls.size() == 1 ? " call" : " calls");
    }

} // namespace

void printSummary(const Analysis &analysis, const std::vector<std::string> &notes)
{
    const Axis &time = analysis.time();
    const std::vector<Event> found = events(analysis);
    std::printf("%td frames of %td cells, %s s per frame\n", time.count, analysis.grid().size(),
                formatNumber(time.step).c_str());
    if (analysis.choice)
        std::printf("%s\n", windowChoiceWords(*analysis.choice).c_str());
    if (const std::string words = subtractionWords(analysis); !words.empty())
        std::printf("%s\n", words.c_str());
    printThreshold(analysis);
    printWarnings(analysis, notes);
    std::printf("%zu event(s)%s\n", found.size(), callWords(found).c_str());
    for (const Event &event : found)
        printEvent(analysis, event);
    if (const std::string words = unreportedWords(analysis); !words.empty())
        std::printf("%s\n", words.c_str());
    printAreas(analysis);
}

} // namespace faintline::cli
