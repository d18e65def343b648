#include "exchange/readAnnotations.h"

#include "base/oneLine.h"
#include "base/readingJson.h"
#include "exchange/annotationText.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace faintline {

namespace {

    constexpr std::uintmax_t mostBytes = 64u << 20;
    constexpr std::size_t mostAnnotations = 100000;

    std::string where(const std::string &path, std::size_t line)
    {
        return path + ", line " + std::to_string(line);
    }

    std::string readText(const std::string &path)
    {
        std::ifstream file(path, std::ios::binary);
        if (!file)
            throw Error(path, std::string("cannot be read: ") + std::strerror(errno));
        if (std::error_code code; std::filesystem::is_directory(path, code))
            throw Error(path, "is a folder; expected a file of annotations");
        std::string text;
        std::vector<char> block(1 << 16);
        while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
            text.append(block.data(), std::size_t(file.gcount()));
            if (text.size() > mostBytes)
                throw Error(path, "is larger than 64 MiB; expected annotations, not samples");
        }
        if (text.starts_with("\xef\xbb\xbf"))
            text.erase(0, 3);
        return text;
    }

    /// Iterates over the lines of a text; a million empty lines need no memory.
    class Lines
    {
    public:
        explicit Lines(const std::string &text) : m_text(text) {}

        /// The next line, or false after the last.
        bool next(std::string &line)
        {
            if (m_at >= m_text.size())
                return false;
            const std::size_t end = std::min(m_text.find('\n', m_at), m_text.size());
            line.assign(m_text, m_at, end - m_at);
            if (!line.empty() && line.back() == '\r')
                line.pop_back();
            m_at = end + 1;
            ++m_number;
            return true;
        }

        /// Of the last line read, counted from 1.
        std::size_t number() const { return m_number; }

    private:
        const std::string &m_text;
        std::size_t m_at = 0;
        std::size_t m_number = 0;
    };

    std::vector<std::string> splitAtTabs(const std::string &line)
    {
        std::vector<std::string> cells(1);
        for (const char c : line)
            c == '\t' ? void(cells.emplace_back()) : cells.back().push_back(c);
        return cells;
    }

    std::vector<std::string> splitCsv(const std::string &line)
    {
        std::vector<std::string> cells(1);
        bool isQuoted = false;
        for (std::size_t i = 0; i < line.size(); ++i) {
            const char c = line[i];
            if (isQuoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"')
                cells.back().push_back(line[++i]);
            else if (c == '"')
                isQuoted = !isQuoted;
            else if (c == ',' && !isQuoted)
                cells.emplace_back();
            else
                cells.back().push_back(c);
        }
        return cells;
    }

    double numberOf(const std::string &text, const std::string &place, const std::string &what)
    {
        double value = 0.0;
        const char *begin = text.data() + std::min(text.find_first_not_of(' '), text.size());
        const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
        if (error != std::errc()
            || std::string_view(end, text.data() + text.size()).find_first_not_of(' ') != std::string_view::npos
            || !std::isfinite(value))
            throw Error(place, "\"" + oneLine(text.substr(0, 40)) + "\" is not a number for " + what);
        return value;
    }

    std::optional<double> optionalNumber(const std::string &text, const std::string &place, const std::string &what)
    {
        return text.find_first_not_of(' ') == std::string::npos ? std::nullopt
                                                                : std::optional(numberOf(text, place, what));
    }

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

    /// Column names in a table's first line.
    struct Header {
        std::string path;
        std::vector<std::string> names;

        std::ptrdiff_t column(const std::string &name) const
        {
            const auto found = std::find(names.begin(), names.end(), name);
            return found == names.end() ? -1 : found - names.begin();
        }
        std::ptrdiff_t needed(const std::string &name) const
        {
            if (const std::ptrdiff_t found = column(name); found >= 0)
                return found;
            throw Error(where(path, 1), "missing column \"" + name + "\"");
        }
    };

    /// A row's cell; empty if the row is too short.
    std::string cellOf(const std::vector<std::string> &row, std::ptrdiff_t column)
    {
        return column < 0 || column >= std::ssize(row) ? std::string() : row[std::size_t(column)];
    }

    bool isBlank(const std::vector<std::string> &row)
    {
        return std::all_of(row.begin(), row.end(), [](const std::string &cell) { return cell.empty(); });
    }

    using Split = std::vector<std::string> (*)(const std::string &);

    struct Columns {
        std::ptrdiff_t begin, end, low, high, label, review, note;
        std::ptrdiff_t once = -1; ///< rows with the same value here as the previous row are further views of it
    };

    /// Boxes of the rows after the header, read row by row: only boxes are kept, no cells.
    std::vector<Annotation> fromRows(Lines &lines, const Header &header, Split split, const Columns &columns)
    {
        std::vector<Annotation> all;
        std::string before;
        for (std::string line; lines.next(line);) {
            const std::string place = where(header.path, lines.number());
            const std::vector<std::string> row = split(line);
            if (row.size() > header.names.size())
                throw Error(place, "has more columns than the header");
            if (isBlank(row))
                continue;
            if (const std::string own = cellOf(row, columns.once); !own.empty() && own == before)
                continue;
            else
                before = own;
            Annotation box;
            box.startSeconds = numberOf(cellOf(row, columns.begin), place, "the begin");
            box.endSeconds = numberOf(cellOf(row, columns.end), place, "the end");
            box.lowHz = optionalNumber(cellOf(row, columns.low), place, "the lower frequency");
            box.highHz = optionalNumber(cellOf(row, columns.high), place, "the upper frequency");
            box.label = oneLine(cellOf(row, columns.label));
            box.note = oneLine(cellOf(row, columns.note));
            box.verdict = verdictNamed(cellOf(row, columns.review));
            add(all, std::move(box), place);
        }
        return all;
    }

    Header headerOf(Lines &lines, const std::string &path, Split split)
    {
        std::string first;
        lines.next(first);
        return {path, split(first)};
    }

    std::vector<Annotation> fromRaven(const std::string &path, const std::string &text)
    {
        Lines lines(text);
        const Header header = headerOf(lines, path, splitAtTabs);
        std::ptrdiff_t label = -1;
        for (const char *name : {"Annotation", "Label", "Species", "Common Name", "Type", "Tag"})
            label = label < 0 ? header.column(name) : label;
        return fromRows(lines, header, splitAtTabs,
                        {header.needed("Begin Time (s)"), header.needed("End Time (s)"), header.column("Low Freq (Hz)"),
                         header.column("High Freq (Hz)"), label, header.column("Review"), header.column("Notes"),
                         header.column("Selection")});
    }

    std::vector<Annotation> fromCsv(const std::string &path, const std::string &text)
    {
        Lines lines(text);
        const Header header = headerOf(lines, path, splitCsv);
        // Events without edges are located at their detected frequency.
        const std::ptrdiff_t low = header.column("f_low") >= 0 ? header.column("f_low") : header.column("f");
        const std::ptrdiff_t high = header.column("f_high") >= 0 ? header.column("f_high") : header.column("f");
        const std::ptrdiff_t label = header.column("label");
        std::vector<Annotation> all = fromRows(lines, header, splitCsv,
                                               {header.needed("t_onset"), header.needed("t_end"), low, high, label,
                                                header.column("review"), header.column("note")});
        if (label < 0)
            for (std::size_t i = 0; i < all.size(); ++i)
                all[i].label = "event " + std::to_string(i + 1);
        return all;
    }

    std::vector<Annotation> fromAudacity(const std::string &path, const std::string &text)
    {
        std::vector<Annotation> all;
        Lines lines(text);
        for (std::string line; lines.next(line);) {
            const std::string place = where(path, lines.number());
            if (line.find_first_not_of(" \t") == std::string::npos)
                continue;
            const std::vector<std::string> cells = splitAtTabs(line);
            if (cells[0] == "\\") {
                if (all.empty() || cells.size() < 3)
                    throw Error(place, "a line of frequencies must follow a label and contain a lower and an upper "
                                       "frequency");
                Annotation box = all.back();
                all.pop_back();
                const double low = numberOf(cells[1], place, "the lower frequency");
                const double high = numberOf(cells[2], place, "the upper frequency");
                if (low != -1.0 || high != -1.0) { // Audacity's notation for no frequencies
                    box.lowHz = low;
                    box.highHz = high;
                }
                add(all, std::move(box), place);
                continue;
            }
            if (cells.size() < 2)
                throw Error(place, "is not a label; expected begin, end and text, separated by tabs");
            Annotation box;
            box.startSeconds = numberOf(cells[0], place, "the begin");
            box.endSeconds = numberOf(cells[1], place, "the end");
            takeApart(cells.size() > 2 ? oneLine(cells[2]) : std::string(), box);
            add(all, std::move(box), place);
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

std::vector<Annotation> readAnnotations(const std::string &path, const RecordingInfo &info)
{
    const std::string text = readText(path);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos)
        return {};
    if (text[first] == '{' || text[first] == '[')
        return fromJson(path, text, info);
    const std::string_view line = std::string_view(text).substr(0, text.find('\n'));
    if (line.find("Begin Time (s)") != std::string_view::npos)
        return fromRaven(path, text);
    if (line.starts_with("event,"))
        return fromCsv(path, text);
    return fromAudacity(path, text);
}

} // namespace faintline
