#include "exchange/writeReport.h"

#include "base/numberText.h"
#include "base/utc.h"
#include "exchange/csvText.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr std::size_t mostLadders = 10;
    constexpr std::size_t mostRungs = 60;

    std::string base64(const std::string &bytes)
    {
        static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (std::size_t i = 0; i < bytes.size(); i += 3) {
            unsigned block = 0;
            for (std::size_t j = 0; j < 3; ++j)
                block = block << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
            for (std::size_t j = 0; j < 4; ++j)
                text += i + j <= bytes.size() ? digits[block >> (18 - 6 * j) & 63] : '=';
        }
        return text;
    }

    /// Replaces hyphens by minus signs, in the exponent as well.
    std::string withMinus(std::string text)
    {
        for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at))
            text.replace(at, 1, "\u2212");
        return text;
    }

    /// Fixed number of decimals in the C locale.
    std::string fixed(double value, int decimals)
    {
        const double scale = std::pow(10.0, decimals);
        if (std::abs(value) * scale < 1e15)
            value = std::round(value * scale) / scale;
        std::string text = formatPlainly(value + 0.0);
        if (text.find('e') == std::string::npos && decimals > 0) {
            std::size_t point = text.find('.');
            if (point == std::string::npos) {
                point = text.size();
                text += '.';
            }
            text.append(std::size_t(std::max<std::ptrdiff_t>(0, decimals - std::ptrdiff_t(text.size() - point - 1))),
                        '0');
        }
        return withMinus(text);
    }

    /// Decimals that tell values a tenth of an axis's step apart, at least `fewest`.
    int decimalsOn(const Axis &axis, int fewest)
    {
        const double needed = std::ceil(-std::log10(0.1 * axis.step) - 1e-9);
        return std::clamp(std::isfinite(needed) ? int(needed) : fewest, fewest, 9);
    }

    /// Rounded to three significant digits.
    std::string rough(double value)
    {
        if (value == 0.0 || !std::isfinite(value))
            return formatNumber(value);
        const double magnitude = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2.0);
        const std::string text = formatNumber(std::round(value / magnitude) * magnitude);
        return text.size() < 12 ? withMinus(text) : fixed(value, int(std::clamp(-std::log10(magnitude), 0.0, 12.0)));
    }

    std::string cells(const std::vector<std::string> &texts, const char *tag = "td")
    {
        std::string row = "<tr>";
        for (const std::string &text : texts)
            row += std::string("<") + tag + ">" + xmlText(text) + "</" + tag + ">";
        return row + "</tr>\n";
    }

    /// A row whose first `count` cells are numbers.
    std::string rowOfNumbers(const std::vector<std::string> &texts, std::size_t count, const char *tag = "td")
    {
        std::string row = "<tr>";
        for (std::size_t i = 0; i < texts.size(); ++i)
            row += std::string("<") + tag + (i < count ? " class=\"n\">" : ">") + xmlText(texts[i]) + "</" + tag + ">";
        return row + "</tr>\n";
    }

    std::string capitalised(std::string name)
    {
        if (!name.empty() && name.front() >= 'a' && name.front() <= 'z')
            name.front() = static_cast<char>(name.front() - 'a' + 'A');
        return name;
    }

    std::string inUnit(const std::string &name, const std::string &unit)
    {
        return unit.empty() ? name : name + " (" + unit + ")";
    }

    /// A unit in which rates along an axis need few digits.
    struct RateUnit {
        std::string name;
        double scale = 1.0;
    };
    RateUnit rateUnit(const Axis &axis, const std::vector<Event> &events, std::size_t i)
    {
        double largest = 0.0;
        for (const Event &event : events)
            largest = std::max(largest, std::abs(event.ratesPerSecond[i]));
        if (axis.unit != "Hz" || largest >= 0.1 || largest == 0.0)
            return {axis.unit.empty() ? "1/s" : axis.unit + "/s", 1.0};
        return largest >= 1e-4 ? RateUnit{"mHz/s", 1e3} : RateUnit{"\u00b5Hz/s", 1e6};
    }

    std::string fact(const std::string &name, const std::string &value)
    {
        return "<tr><th scope=\"row\">" + xmlText(name) + "</th><td>" + xmlText(value) + "</td></tr>\n";
    }

    std::string recordingFacts(const Analysis &analysis)
    {
        std::string text = "<table class=\"facts\">\n";
        if (analysis.recording) {
            const RecordingInfo &info = analysis.recording->info();
            text += fact("Format", info.container + ", " + info.sampleType + (info.isComplex ? ", I/Q" : ""));
            text += fact("Sample rate", formatPlainly(info.sampleRateHz) + " Hz");
            text += fact("Length",
                         fixed(info.durationSeconds(), 3) + " s, " + std::to_string(info.sampleCount) + " samples");
            text += fact("Channels", std::to_string(info.channelCount));
            if (info.centreHz != 0.0)
                text += fact("Centre frequency", formatPlainly(info.centreHz) + " Hz");
            if (info.startUnixSeconds)
                text += fact("Begins", formatUtc(*info.startUnixSeconds));
            for (const std::string &note : info.notes)
                text += fact("Note", note);
        }
        text += fact("Frames", std::to_string(analysis.time().count) + ", every " + rough(analysis.time().step) + " "
                                   + analysis.time().unit);
        for (const Axis &axis : analysis.grid().axes)
            text += fact(capitalised(axis.name),
                         std::to_string(axis.count) + " cells of " + rough(axis.step) + " " + axis.unit);
        return text + "</table>\n";
    }

    std::string settingsTable(const AnalysisSettings &settings)
    {
        std::string rows;
        for (const Field<AnalysisSettings> &field : AnalysisSettings::fields()) {
            const std::optional<FieldValue> value = field.get(settings);
            if (!value || *value == defaultValue(field))
                continue;
            rows += cells({field.name, formatFieldValue(field, *value), formatFieldValue(field, defaultValue(field)),
                           field.unit, field.sentence});
        }
        if (rows.empty())
            return "<p>All settings have their defaults.</p>\n";
        return "<table>\n" + cells({"Setting", "Value", "Default", "Unit", "Meaning"}, "th") + rows + "</table>\n";
    }

    std::string calibrationFacts(const Analysis &analysis)
    {
        const Calibration &calibration = *analysis.calibration;
        const double eventRate = calibration.eventRateAt(analysis.threshold);
        const double perHour = eventRate * analysis.cellFramesPerHour;
        const double halfWidth = calibration.thresholdUncertainty(eventRate);
        const std::string unit = " " + std::string(statisticUnit(analysis.settings.detector));
        std::string text = "<table class=\"facts\">\n";
        text += fact("Threshold", fixed(analysis.threshold, 2) + unit + "; accuracy of its simulation \u00b1"
                                      + fixed(halfWidth, 2) + unit + " (95 %)");
        const double factor = std::exp(calibration.tailSlope * halfWidth);
        text += fact("False alarms on noise", rough(perHour) + " per hour; 95 % interval " + rough(perHour / factor)
                                                  + " \u2026 " + rough(perHour * factor));
        text += fact("Pfa per cell", rough(calibration.exceedanceAt(analysis.threshold)));
        text += fact("ln K", fixed(calibration.lnK, 3) + " nat; " + fixed(100.0 * calibration.continuedFraction, 1)
                                 + " % of noise's paths continued");
        text += fact("Tail e^(\u2212\u03b8T)", "\u03b8 = " + fixed(calibration.tailSlope, 3) + " \u00b1 "
                                                   + fixed(calibration.slopeError, 3) + " per" + unit);
        return text + "</table>\n";
    }

    std::string eventsTable(const Analysis &analysis, const ReportMaterial &material)
    {
        if (material.events.empty())
            return "<p>No event at this threshold.</p>\n";
        const std::vector<Axis> &axes = analysis.grid().axes;
        std::vector<std::string> names{"No.", "Onset (s)", "Detected (s)", "End (s)"};
        for (const Axis &axis : axes)
            names.push_back(inUnit(capitalised(axis.name), axis.unit));
        std::vector<RateUnit> units;
        for (const Axis &axis : axes) {
            units.push_back(rateUnit(axis, material.events, units.size()));
            names.push_back((analysis.grid().isSpectrum() ? "Drift" : capitalised(axis.name) + " rate") + " ("
                            + units.back().name + ")");
        }
        names.push_back("D (" + std::string(statisticUnit(analysis.settings.detector)) + ")");
        const std::size_t numeric = names.size();
        names.insert(names.end(), {"State", "Review", "Note"});
        std::string text = "<table class=\"numbers\">\n" + rowOfNumbers(names, numeric, "th");
        const std::vector<EventReview> said = eventReviews(analysis, material.events, material.annotations.reviews);
        for (std::size_t i = 0; i < material.events.size(); ++i) {
            const Event &event = material.events[i];
            std::vector<std::string> row{std::to_string(event.id)};
            for (const double seconds : {event.onsetSeconds, event.detectSeconds, event.endSeconds})
                row.push_back(fixed(seconds, decimalsOn(analysis.time(), 2)));
            for (std::size_t axis = 0; axis < axes.size(); ++axis)
                row.push_back(fixed(event.position[axis], decimalsOn(axes[axis], 2)));
            std::string review = said[i].label;
            if (said[i].verdict != Verdict::None)
                review += (review.empty() ? "" : ", ") + nameOf(said[i].verdict);
            if (said[i].signal != event.id)
                review += (review.empty() ? "part of " : ", part of ") + std::to_string(said[i].signal);
            for (std::size_t axis = 0; axis < units.size(); ++axis)
                row.push_back(rough(units[axis].scale * event.ratesPerSecond[axis]));
            row.insert(row.end(),
                       {fixed(event.statistic, statisticDecimals(analysis.settings.detector)),
                        std::string(event.isConfirmed ? "confirmed" : "tentative") + (event.isOpen ? ", open" : ""),
                        review, said[i].note});
            std::string line = rowOfNumbers(row, numeric);
            if (said[i].verdict == Verdict::Rejected)
                line.insert(3, " class=\"rejected\"");
            text += line;
        }
        return text + "</table>\n";
    }

    std::string areasTable(const Analysis &analysis)
    {
        const std::vector<AreaEvent> areas = areaEvents(analysis);
        if (areas.empty())
            return {};
        const std::string &unit = analysis.grid().axes.back().unit;
        const int time = decimalsOn(analysis.time(), 2), frequency = decimalsOn(analysis.grid().axes.back(), 2);
        std::string text = "<h2>Areas of raised level without a line</h2>\n<table class=\"numbers\">\n"
                           + rowOfNumbers({"From (s)", "To (s)", inUnit("Lowest", unit), inUnit("Highest", unit),
                                           "Level, at least (dB)"},
                                          5, "th");
        for (const AreaEvent &area : areas)
            text += rowOfNumbers({fixed(area.onsetSeconds, time), fixed(area.endSeconds, time),
                                  fixed(area.low, frequency), fixed(area.high, frequency), fixed(area.levelDb, 1)},
                                 5);
        return text + "</table>\n";
    }

    std::string annotationsTable(const std::vector<Annotation> &boxes)
    {
        if (boxes.empty())
            return {};
        std::string text =
            "<h2>Annotations</h2>\n<table class=\"numbers\">\n"
            + rowOfNumbers({"From (s)", "To (s)", "Lowest (Hz)", "Highest (Hz)", "Label", "Review", "Note"}, 4, "th");
        for (const Annotation &box : boxes)
            text += rowOfNumbers({fixed(box.startSeconds, 2), fixed(box.endSeconds, 2),
                                  box.lowHz ? fixed(*box.lowHz, 2) : "", box.highHz ? fixed(*box.highHz, 2) : "",
                                  box.label, nameOf(box.verdict), box.note},
                                 4);
        return text + "</table>\n";
    }

    std::string ladder(const Analysis &analysis, const ReportMaterial::Ladder &one)
    {
        const Explanation &why = one.explanation;
        const StateSpace &space = analysis.modelAt(why.model).space;
        const std::vector<Axis> &axes = analysis.grid().axes;
        // For a detector without paths: its statistic, and the path of the detector that guides its tracks.
        const bool isScore = isScoreOfPaths(analysis.settings.detector);
        const double decided = isScore ? why.statistic : why.displayed;
        const std::string unit = " " + std::string(statisticUnit(analysis.settings.detector));
        std::string text = "<details>\n<summary>Event " + std::to_string(one.event) + ": "
                           + (isScore ? "" : fixed(decided, 2) + unit + "; the path of its guide has ")
                           + fixed(why.statistic, 2) + " nat over " + std::to_string(why.steps.size()) + " frames, "
                           + (isScore ? "" : "the statistic is ") + fixed(std::abs(decided - why.threshold), 2) + unit
                           + (decided > why.threshold ? " above" : " below") + " the threshold</summary>\n";
        std::vector<std::string> names{"t (s)"};
        for (const Axis &axis : axes)
            names.push_back(inUnit(capitalised(axis.name), axis.unit));
        names.insert(names.end(), {"ln likelihood ratio", "ln P(transition)", "ln K", "Sum (nat)"});
        text += "<table class=\"numbers\">\n" + rowOfNumbers(names, names.size(), "th");
        const std::size_t first = why.steps.size() > mostRungs ? why.steps.size() - mostRungs : 0;
        if (first > 0) {
            std::vector<std::string> row{std::to_string(first) + " frames before"};
            row.resize(names.size() - 1);
            row.push_back(fixed(why.steps[first - 1].score, 4));
            text += rowOfNumbers(row, row.size());
        }
        for (std::size_t i = first; i < why.steps.size(); ++i) {
            const PathStep &step = why.steps[i];
            std::vector<std::string> row{
                fixed(analysis.time().value(double(step.frame)), decimalsOn(analysis.time(), 3))};
            const std::vector<double> position = analysis.grid().position(space.cellOf(step.state));
            for (std::size_t axis = 0; axis < position.size(); ++axis)
                row.push_back(fixed(position[axis], decimalsOn(analysis.grid().axes[axis], 3)));
            row.insert(row.end(), {fixed(step.logLikelihoodRatio, 4), fixed(step.lnTransition, 4), fixed(step.lnK, 4),
                                   fixed(step.score, 4)});
            text += rowOfNumbers(row, row.size());
        }
        text += "</table>\n";
        if (why.offset != 0.0)
            text += "<p>And " + fixed(why.offset, 4) + " nat common to all states.</p>\n";
        return text + "</details>\n";
    }

    const char *const style =
        "body{font:15px/1.5 system-ui,sans-serif;color:#1c2127;background:#fff;max-width:72em;margin:2em "
        "auto;padding:0 1.5em}"
        "h1{font-size:1.6em}h2{margin-top:2em;border-bottom:1px solid #dde1e6}"
        "table{border-collapse:collapse;margin:.5em 0}td,th{padding:.2em 1em .2em "
        "0;text-align:left;vertical-align:top;border-bottom:1px "
        "solid #edf0f3}"
        ".numbers td{font-variant-numeric:tabular-nums}.n{text-align:right}tr.rejected "
        "td{color:#8a939d;text-decoration:line-through}"
        ".pictures{display:flex;flex-wrap:wrap;gap:1em;align-items:flex-end}figure{margin:0;flex:0 1 "
        "auto;min-width:18em;max-width:48%}img{max-width:100%;height:auto;border:1px solid "
        "#dde1e6}figcaption{color:#59636e}"
        "pre{background:#f4f6f8;padding:1em;white-space:pre-wrap;overflow-wrap:anywhere}summary{cursor:pointer}"
        "@media print{body{margin:0;max-width:none}figure,tr{break-inside:avoid}}";

} // namespace

std::vector<Event> eventsToExplain(const Analysis &analysis, const std::vector<Event> &events,
                                   const Annotations &annotations)
{
    const std::vector<EventReview> said = eventReviews(analysis, events, annotations.reviews);
    std::vector<Event> accepted;
    std::vector<Event> others;
    for (std::size_t i = 0; i < events.size(); ++i)
        if (said[i].verdict != Verdict::Rejected)
            (said[i].verdict == Verdict::Accepted ? accepted : others).push_back(events[i]);
    if (!accepted.empty())
        return accepted;
    std::stable_sort(others.begin(), others.end(),
                     [](const Event &a, const Event &b) { return a.statistic > b.statistic; });
    others.resize(std::min(others.size(), mostLadders));
    return others;
}

std::string reportHtml(const Analysis &analysis, const ReportMaterial &material)
{
    std::string text = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
                       "content=\"width=device-width\">\n"
                       "<meta name=\"generator\" content=\"Faintline "
                       + xmlText(material.version) + "\">\n<title>" + xmlText(material.title) + "</title>\n<style>"
                       + style + "</style>\n</head>\n<body>\n<h1>" + xmlText(material.title) + "</h1>\n";
    text += "<h2>Recording</h2>\n" + recordingFacts(analysis);
    text += "<h2>Pictures</h2>\n<div class=\"pictures\">\n";
    for (const ReportMaterial::Picture &picture : material.pictures)
        text += "<figure><img alt=\"" + xmlText(picture.title) + "\" width=\"" + std::to_string(picture.width)
                + "\" height=\"" + std::to_string(picture.height) + "\" src=\"data:image/png;base64,"
                + base64(picture.png) + "\"><figcaption>" + xmlText(picture.title) + "</figcaption></figure>\n";
    text += "</div>\n<h2>Events</h2>\n" + eventsTable(analysis, material) + areasTable(analysis)
            + annotationsTable(material.annotations.boxes);
    text += "<h2>Threshold and calibration</h2>\n" + calibrationFacts(analysis);
    if (!material.ladders.empty()) {
        text += "<h2>Path breakdown of detections</h2>\n<p>The best path up to the moment of detection, term by term "
                "from its last reset; the terms add up to the statistic.</p>\n";
        for (const ReportMaterial::Ladder &one : material.ladders)
            text += ladder(analysis, one);
    }
    text += "<h2>Settings that differ from the defaults</h2>\n" + settingsTable(analysis.settings);
    text += "<h2>Provenance</h2>\n<p>Faintline " + xmlText(material.version)
            + ". The same recording with these "
              "settings gives the same "
              "results.</p>\n<pre>"
            + xmlText(material.provenance) + "</pre>\n";
    return text + "</body>\n</html>\n";
}

} // namespace faintline
