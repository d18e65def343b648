#include "exchange/readAnnotations.h"

#include "base/json.h"
#include "base/oneLine.h"
#include "exchange/annotationText.h"
#include "exchange/textTable.h"
#include "signal/Timeline.h"
#include "signal/openRecording.h"
#include "signal/timeInName.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <utility>

namespace faintline {

namespace {

    constexpr std::size_t mostAnnotations = 100000;

    /// Checks a box and appends it.
    void add(std::vector<Annotation> &all, Annotation box, const std::string &place)
    {
        if (!(box.endSeconds >= box.startSeconds) || !std::isfinite(box.startSeconds) || !std::isfinite(box.endSeconds))
            throw Error(place, "an annotation must not end before it begins");
        if (box.lowHz.has_value() != box.highHz.has_value())
            throw Error(place, "an annotation needs both a lower and an upper frequency, or none");
        if (box.lowHz && !(*box.highHz >= *box.lowHz))
            throw Error(place, "an annotation's upper frequency must not lie below its lower one");
        if (all.size() == mostAnnotations)
            throw Error(place, "more than 100000 annotations");
        all.push_back(std::move(box));
    }

    /// -1 is an open edge, as Audacity writes it. Of I/Q, which that program does not read, it is a frequency.
    void openEdges(Annotation &box, const RecordingInfo &info)
    {
        constexpr double beyondHz = 1e12;
        const auto isOpen = [](const std::optional<double> &edge) { return edge == -1.0; };
        if (isOpen(box.lowHz) && isOpen(box.highHz))
            box.lowHz = box.highHz = std::nullopt;
        if (info.isComplex)
            return;
        if (isOpen(box.lowHz))
            box.lowHz = 0.0;
        if (isOpen(box.highHz))
            box.highHz = std::max(box.lowHz.value_or(0.0), info.sampleRateHz > 0.0 ? info.sampleRateHz / 2 : beyondHz);
    }

    /// A column of frequencies and the factor of its unit: "NAME (Hz)", "NAME (kHz)", "NAME (MHz)".
    struct FrequencyColumn {
        std::ptrdiff_t column = -1;
        double factor = 1.0;

        std::optional<double> in(TextTable &table, const std::string &what) const
        {
            const std::optional<double> value = table.numberIfAny(column, what);
            return value && *value != -1.0 ? std::optional(*value * factor) : value;
        }
    };

    FrequencyColumn frequencyColumn(const TextTable &table, const std::string &name)
    {
        if (table.column(name) >= 0)
            return {table.column(name), 1.0};
        for (const auto &[unit, factor] : {std::pair{"Hz", 1.0}, {"kHz", 1e3}, {"MHz", 1e6}})
            if (const std::ptrdiff_t column = table.column(name + " (" + unit + ")"); column >= 0)
                return {column, factor};
        return {};
    }

    /// The first of these names that is a column.
    std::ptrdiff_t columnOf(const TextTable &table, std::initializer_list<const char *> names)
    {
        for (const char *name : names)
            if (const std::ptrdiff_t column = table.column(name); column >= 0)
                return column;
        return -1;
    }

    struct Columns {
        std::ptrdiff_t begin, end;
        FrequencyColumn low, high;
        std::ptrdiff_t label, review, note;
        std::ptrdiff_t once = -1; ///< rows with the same value here as the previous row are further views of it
    };

    Annotation rowBox(TextTable &table, const Columns &columns, const RecordingInfo &info)
    {
        Annotation box;
        box.startSeconds = table.number(columns.begin, "the begin");
        box.endSeconds = table.number(columns.end, "the end");
        box.lowHz = columns.low.in(table, "the lower frequency");
        box.highHz = columns.high.in(table, "the upper frequency");
        openEdges(box, info);
        box.label = oneLine(table.cell(columns.label));
        box.note = oneLine(table.cell(columns.note));
        box.verdict = verdictNamed(table.cell(columns.review));
        return box;
    }

    /// "Site/CALL.wav" → "call": another copy of a recording may have another ending.
    std::string stemOf(const std::string &path)
    {
        std::string stem = path.substr(path.find_last_of("/\\") + 1);
        stem.resize(std::min(stem.rfind('.'), stem.size()));
        std::ranges::transform(stem, stem.begin(), [](unsigned char c) { return char(std::tolower(c)); });
        return stem;
    }

    /// Places the rows of a table over several files in the recording, which is one of them or consists of them.
    class SeveralFiles
    {
    public:
        SeveralFiles(const TextTable &table, const RecordingInfo &info, const std::vector<std::string> &names)
            : m_file(columnOf(table, {"Begin File", "Begin Path"})), m_offset(table.column("File Offset (s)")),
              m_info(info)
        {
            if (m_file >= 0)
                for (const std::string &path : Timeline::filesOf(names))
                    m_paths.emplace(stemOf(path), path);
        }

        /// Moves the row's box to its place; false if it belongs to another file.
        bool place(TextTable &table, Annotation &box)
        {
            const std::string name = table.cell(m_file);
            if (name.empty())
                return true;
            m_named.insert(stemOf(name));
            const double begin = table.numberIfAny(m_offset, "the offset in its file").value_or(box.startSeconds);
            m_isSequence = m_isSequence || begin != box.startSeconds;
            const auto path = m_paths.find(stemOf(name));
            if (path == m_paths.end()) {
                m_others.insert(oneLine(name));
                ++m_otherCount;
                return false;
            }
            const double start = begin + (m_paths.size() > 1 ? startOf(path->second) : 0.0);
            box.endSeconds += start - box.startSeconds;
            box.startSeconds = start;
            return true;
        }

        /// Whether all rows name one other file, which the recording may have been called.
        bool isRenamed() const
        {
            return m_named.size() == 1 && m_otherCount > 0 && !m_isSequence && m_paths.size() == 1;
        }

        std::string note(const std::string &path) const
        {
            if (m_otherCount == 0)
                return {};
            const std::string first = *m_others.begin() + (m_others.size() > 1 ? " …" : "");
            return isRenamed() ? path + ": names the file " + first + "; its rows are taken for this recording"
                               : path + ": " + std::to_string(m_otherCount) + " row(s) belong to other files (" + first
                                     + ") and are left out";
        }

    private:
        /// Seconds from the recording's first sample to the file's.
        double startOf(const std::string &path)
        {
            const auto known = m_starts.find(path);
            if (known != m_starts.end())
                return known->second;
            std::optional<double> unixSeconds;
            try {
                unixSeconds = openRecording(path)->info().startUnixSeconds;
            } catch (const Error &) { // raw samples, which have the time in their name
            }
            if (!unixSeconds)
                unixSeconds = timeInName(path);
            if (!unixSeconds || !m_info.startUnixSeconds)
                throw Error(path, "has no time stamp, so that its annotations have no place in the recording");
            return m_starts[path] = *unixSeconds - *m_info.startUnixSeconds;
        }

        std::ptrdiff_t m_file;
        std::ptrdiff_t m_offset;
        const RecordingInfo &m_info;
        std::map<std::string, std::string> m_paths; ///< of the recording, by stem
        std::map<std::string, double> m_starts;
        std::set<std::string> m_named, m_others;
        bool m_isSequence = false;
        std::size_t m_otherCount = 0;
    };

    /// Boxes of the rows, read row by row: only boxes are kept, no cells.
    std::vector<Annotation> fromRows(TextTable &table, const Columns &columns, const RecordingInfo &info,
                                     SeveralFiles *files = nullptr)
    {
        std::vector<Annotation> all, others;
        std::string before;
        while (table.next()) {
            if (const std::string own = table.cell(columns.once); !own.empty() && own == before)
                continue;
            else
                before = own;
            Annotation box = rowBox(table, columns, info);
            const bool isOwn = !files || files->place(table, box);
            add(isOwn ? all : others, std::move(box), table.place());
        }
        return files && files->isRenamed() ? others : all;
    }

    std::vector<Annotation> fromRaven(TextTable &table, const AnnotatedRecording &of, std::vector<std::string> *notes,
                                      const std::string &path)
    {
        SeveralFiles files(table, of.info, of.files);
        const std::vector<Annotation> all =
            fromRows(table,
                     {table.neededColumn("Begin Time (s)"), table.neededColumn("End Time (s)"),
                      frequencyColumn(table, "Low Freq"), frequencyColumn(table, "High Freq"),
                      columnOf(table, {"Annotation", "Label", "Species", "Common Name", "Type", "Tag"}),
                      table.column("Review"), table.column("Notes"), table.column("Selection")},
                     of.info, &files);
        if (const std::string note = files.note(path); notes && !note.empty())
            notes->push_back(note);
        return all;
    }

    std::vector<Annotation> fromCsv(TextTable &table, const RecordingInfo &info)
    {
        // Events without edges are located at their detected frequency.
        const auto edge = [&](const char *name) {
            const FrequencyColumn own = frequencyColumn(table, name);
            return own.column >= 0 ? own : frequencyColumn(table, "f");
        };
        const std::ptrdiff_t label = table.column("label");
        std::vector<Annotation> all =
            fromRows(table,
                     {table.neededColumn("t_onset"), table.neededColumn("t_end"), edge("f_low"), edge("f_high"), label,
                      table.column("review"), table.column("note")},
                     info);
        if (label < 0)
            for (std::size_t i = 0; i < all.size(); ++i)
                all[i].label = "event " + std::to_string(i + 1);
        return all;
    }

    std::vector<Annotation> fromAudacity(const std::string &path, const std::string &text, const RecordingInfo &info)
    {
        std::vector<Annotation> all;
        TextTable table(path, text, false);
        while (table.next()) {
            if (table.cell(0) == "\\") {
                if (all.empty() || table.size() < 3)
                    throw Error(table.place(), "a line of frequencies must follow a label and contain a lower and an "
                                               "upper frequency");
                Annotation box = all.back();
                all.pop_back();
                box.lowHz = table.number(1, "the lower frequency");
                box.highHz = table.number(2, "the upper frequency");
                openEdges(box, info);
                add(all, std::move(box), table.place());
                continue;
            }
            if (table.size() < 2)
                throw Error(table.place(), "is not a label; expected begin, end and text, separated by tabs");
            Annotation box;
            box.startSeconds = table.number(0, "the begin");
            box.endSeconds = table.number(1, "the end");
            takeApart(oneLine(table.cell(2)), box);
            add(all, std::move(box), table.place());
        }
        return all;
    }

    /// The boxes that `boxOf` makes of a list's members; messages call them `name` and their number.
    template <class BoxOf>
    std::vector<Annotation> fromList(const Json &list, const std::string &name, const BoxOf &boxOf)
    {
        std::vector<Annotation> all;
        for (const Json &one : list) {
            const std::string number = std::to_string(all.size() + 1);
            readingJson(name + " " + number, [&] { add(all, boxOf(one, number), name + " " + number); });
        }
        return all;
    }

    /// Places in time of SigMF's sample numbers, which count the samples of the file from core:offset on.
    class SigmfTimes
    {
    public:
        SigmfTimes(const Json &json, const std::string &path, const RecordingInfo &info) : m_info(info)
        {
            const Json global = json.value("global", Json::object());
            readingJson(path + ": global", [&] {
                m_rate = global.value("core:sample_rate", info.sampleRateHz);
                m_offset = global.value("core:offset", 0.0);
            });
            if (!(m_rate > 0.0) || !std::isfinite(m_rate))
                throw Error(path, "has no sample rate");
            const Json captures = json.value("captures", Json::array());
            for (const Json &capture : captures)
                if (capture.is_object())
                    m_captures.push_back(
                        readingJson(path + ": captures", [&] { return capture.value("core:sample_start", m_offset); }));
        }

        /// Of a sample.
        double secondsAt(double number) const { return inTime(number - m_offset) / m_rate; }
        /// Of the end of the sample before one.
        double endAt(double number) const { return (inTime(number - m_offset - 1.0) + 1.0) / m_rate; }

        /// Of the end of a sample's capture: where the next one begins, or the recording ends.
        double captureEnd(double number) const
        {
            double next = HUGE_VAL;
            for (const double start : m_captures)
                if (start > number)
                    next = std::min(next, start);
            const double end = std::isinf(next) ? m_info.durationSeconds() : endAt(next);
            return std::max(end, secondsAt(number));
        }

    private:
        double inTime(double stored) const
        {
            const bool isOfFile = m_info.places.hasGaps() && m_rate == m_info.sampleRateHz && std::abs(stored) < 1e15;
            return isOfFile ? double(m_info.places.inTimeOf(Index(std::floor(stored)))) : stored;
        }

        const RecordingInfo &m_info;
        double m_rate = 0.0;
        double m_offset = 0.0;
        std::vector<double> m_captures;
    };

    std::vector<Annotation> fromSigmf(const Json &json, const std::string &path, const RecordingInfo &info)
    {
        const SigmfTimes times(json, path, info);
        return fromList(json["annotations"], path + ", annotation", [&](const Json &one, const std::string &) {
            Annotation box;
            const double start = one.at("core:sample_start").get<double>();
            const auto count = one.find("core:sample_count");
            box.startSeconds = times.secondsAt(start);
            if (count == one.end() || count->is_null())
                box.endSeconds = times.captureEnd(start);
            else if (const double samples = count->get<double>(); samples > 0.0)
                box.endSeconds = times.endAt(start + samples);
            else
                box.endSeconds = samples < 0.0 ? -HUGE_VAL : box.startSeconds; // refused
            if (one.contains("core:freq_lower_edge"))
                box.lowHz = one["core:freq_lower_edge"].get<double>() - info.centreHz;
            if (one.contains("core:freq_upper_edge"))
                box.highHz = one["core:freq_upper_edge"].get<double>() - info.centreHz;
            box.label = oneLine(one.value("core:label", std::string()));
            box.note = oneLine(one.value("core:comment", std::string()));
            if (isEventComment(box.note))
                box.note.clear();
            box.verdict = verdictNamed(one.value("faintline:review", std::string()));
            return box;
        });
    }

    std::vector<Annotation> fromEventsJson(const Json &json, const std::string &path)
    {
        return fromList(json["events"], path + ", event", [](const Json &one, const std::string &number) {
            Annotation box;
            box.startSeconds = one.at("t_onset").get<double>();
            box.endSeconds = one.at("t_end").get<double>();
            const char *low = one.contains("f_low") ? "f_low" : "f";
            const char *high = one.contains("f_high") ? "f_high" : "f";
            if (one.contains(low) && one.contains(high)) {
                box.lowHz = one[low].get<double>();
                box.highHz = one[high].get<double>();
            }
            box.label = oneLine(one.value("label", "event " + number));
            box.note = oneLine(one.value("note", std::string()));
            box.verdict = verdictNamed(one.value("review", std::string()));
            return box;
        });
    }

    std::vector<Annotation> fromJson(const std::string &path, const std::string &text, const RecordingInfo &info)
    {
        const Json json = parseJson(text, path);
        if (json.contains("annotations"))
            return fromSigmf(json, path, info);
        if (json.contains("events"))
            return fromEventsJson(json, path);
        throw Error(path, "contains neither SigMF's \"annotations\" nor \"events\"");
    }

} // namespace

std::vector<Annotation> readAnnotations(const std::string &path, const AnnotatedRecording &of,
                                        std::vector<std::string> *notes)
{
    const std::string text = readTableText(path);
    const std::size_t first = text.find_first_not_of(" \t\n");
    if (first == std::string::npos)
        return {};
    if (text[first] == '{' || text[first] == '[')
        return fromJson(path, text, of.info);
    TextTable table(path, text, true);
    if (table.column("Begin Time (s)") >= 0)
        return fromRaven(table, of, notes, path);
    if (table.column("t_onset") >= 0)
        return fromCsv(table, of.info);
    return fromAudacity(path, text, of.info);
}

} // namespace faintline
