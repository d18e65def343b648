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
#include <sstream>
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
            throw Error(path, "is a folder; annotations are a file");
        std::string text;
        std::vector<char> block(1 << 20);
        while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
            text.append(block.data(), static_cast<std::size_t>(file.gcount()));
            if (text.size() > mostBytes)
                throw Error(path, "is longer than 64 MiB; annotations are expected, not samples");
        }
        if (text.starts_with("\xef\xbb\xbf"))
            text.erase(0, 3);
        return text;
    }

    std::vector<std::string> linesOf(const std::string &text)
    {
        std::vector<std::string> lines;
        std::istringstream stream(text);
        for (std::string line; std::getline(stream, line);) {
            if (!line.empty() && line.back() == '\r')
                line.pop_back();
            lines.push_back(std::move(line));
        }
        return lines;
    }

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
        if (error != std::errc() || std::string_view(end, text.data() + text.size()).find_first_not_of(' ') != std::string_view::npos
            || !std::isfinite(value))
            throw Error(place, "\"" + oneLine(text.substr(0, 40)) + "\" is no number for " + what);
        return value;
    }

    std::optional<double> optionalNumber(const std::string &text, const std::string &place, const std::string &what)
    {
        return text.find_first_not_of(' ') == std::string::npos ? std::nullopt : std::optional(numberOf(text, place, what));
    }

    /// Checks a box and puts it to the others.
    void add(std::vector<Annotation> &all, Annotation box, const std::string &place)
    {
        if (!(box.endSeconds >= box.startSeconds) || !std::isfinite(box.startSeconds) || !std::isfinite(box.endSeconds))
            throw Error(place, "an annotation's end must not lie before its begin");
        if (box.lowHz.has_value() != box.highHz.has_value())
            throw Error(place, "an annotation needs both a lower and an upper frequency, or none");
        if (box.lowHz && !(*box.highHz >= *box.lowHz))
            throw Error(place, "an annotation's upper frequency must not lie below its lower one");
        if (all.size() == mostAnnotations)
            throw Error(place, "more than 100000 annotations");
        all.push_back(std::move(box));
    }

    /// A table with named columns.
    struct Table {
        std::string path;
        std::vector<std::string> names;
        std::vector<std::vector<std::string>> rows; ///< as many cells as names
        std::size_t firstLine = 2;

        std::ptrdiff_t column(const std::string &name) const
        {
            const auto found = std::find(names.begin(), names.end(), name);
            return found == names.end() ? -1 : found - names.begin();
        }
        std::ptrdiff_t needed(const std::string &name) const
        {
            if (const std::ptrdiff_t found = column(name); found >= 0)
                return found;
            throw Error(where(path, 1), "there is no column \"" + name + "\"");
        }
        static std::string cell(const std::vector<std::string> &row, std::ptrdiff_t column)
        {
            return column < 0 ? std::string() : row[static_cast<std::size_t>(column)];
        }
    };

    Table readTable(const std::string &path, const std::vector<std::string> &lines, std::vector<std::string> (*split)(const std::string &))
    {
        Table table{path, split(lines.front()), {}};
        for (std::size_t i = 1; i < lines.size(); ++i) {
            std::vector<std::string> cells = split(lines[i]);
            if (cells.size() > table.names.size())
                throw Error(where(path, i + 1), "has more columns than the header");
            cells.resize(table.names.size());
            table.rows.push_back(std::move(cells)); // an empty line too, so that lines keep their numbers
        }
        return table;
    }

    bool isBlank(const std::vector<std::string> &row)
    {
        return std::all_of(row.begin(), row.end(), [](const std::string &cell) { return cell.empty(); });
    }

    struct Columns {
        std::ptrdiff_t begin, end, low, high, label, review, note;
    };

    std::vector<Annotation> fromTable(const Table &table, const Columns &columns)
    {
        std::vector<Annotation> all;
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            const auto &row = table.rows[i];
            if (isBlank(row))
                continue;
            const std::string place = where(table.path, table.firstLine + i);
            Annotation box;
            box.startSeconds = numberOf(Table::cell(row, columns.begin), place, "the begin");
            box.endSeconds = numberOf(Table::cell(row, columns.end), place, "the end");
            box.lowHz = optionalNumber(Table::cell(row, columns.low), place, "the lower frequency");
            box.highHz = optionalNumber(Table::cell(row, columns.high), place, "the upper frequency");
            box.label = oneLine(Table::cell(row, columns.label));
            box.note = oneLine(Table::cell(row, columns.note));
            box.verdict = verdictNamed(Table::cell(row, columns.review));
            add(all, std::move(box), place);
        }
        return all;
    }

    std::vector<Annotation> fromRaven(const std::string &path, const std::vector<std::string> &lines)
    {
        const Table table = readTable(path, lines, splitAtTabs);
        // A selection has a row for each of its views; one is enough.
        std::ptrdiff_t label = -1;
        for (const char *name : {"Annotation", "Label", "Species", "Common Name", "Type", "Tag"})
            label = label < 0 ? table.column(name) : label;
        Table once = table;
        if (const std::ptrdiff_t selection = table.column("Selection"); selection >= 0) {
            std::string before;
            for (auto &row : once.rows) {
                const std::string &own = row[static_cast<std::size_t>(selection)];
                if (!own.empty() && own == before)
                    std::fill(row.begin(), row.end(), std::string());
                else
                    before = own;
            }
        }
        return fromTable(once, {table.needed("Begin Time (s)"), table.needed("End Time (s)"), table.column("Low Freq (Hz)"),
                                table.column("High Freq (Hz)"), label, table.column("Review"), table.column("Notes")});
    }

    std::vector<Annotation> fromCsv(const std::string &path, const std::vector<std::string> &lines)
    {
        Table table = readTable(path, lines, splitCsv);
        // Events without edges are where they were detected.
        const std::ptrdiff_t low = table.column("f_low") >= 0 ? table.column("f_low") : table.column("f");
        const std::ptrdiff_t high = table.column("f_high") >= 0 ? table.column("f_high") : table.column("f");
        const std::ptrdiff_t label = table.column("label");
        std::vector<Annotation> all = fromTable(
            table, {table.needed("t_onset"), table.needed("t_end"), low, high, label, table.column("review"), table.column("note")});
        if (label < 0)
            for (std::size_t i = 0; i < all.size(); ++i)
                all[i].label = "event " + std::to_string(i + 1);
        return all;
    }

    std::vector<Annotation> fromAudacity(const std::string &path, const std::vector<std::string> &lines)
    {
        std::vector<Annotation> all;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const std::string place = where(path, i + 1);
            if (lines[i].find_first_not_of(" \t") == std::string::npos)
                continue;
            const std::vector<std::string> cells = splitAtTabs(lines[i]);
            if (cells[0] == "\\") {
                if (all.empty() || cells.size() < 3)
                    throw Error(place, "a line of frequencies belongs after a label and holds a lower and an upper one");
                Annotation box = all.back();
                all.pop_back();
                const double low = numberOf(cells[1], place, "the lower frequency");
                const double high = numberOf(cells[2], place, "the upper frequency");
                if (low != -1.0 || high != -1.0) { // Audacity's way to say none
                    box.lowHz = low;
                    box.highHz = high;
                }
                add(all, std::move(box), place);
                continue;
            }
            if (cells.size() < 2)
                throw Error(place, "is no label: begin, end and text, separated by tabs, are expected");
            Annotation box;
            box.startSeconds = numberOf(cells[0], place, "the begin");
            box.endSeconds = numberOf(cells[1], place, "the end");
            takeApart(cells.size() > 2 ? oneLine(cells[2]) : std::string(), box);
            add(all, std::move(box), place);
        }
        return all;
    }

    /// The boxes that `boxOf` makes of a list's members, each of which is `name` and its number in messages.
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

    std::vector<Annotation> fromSigmf(const Json &json, const std::string &path, const RecordingInfo &info)
    {
        double rate = info.sampleRateHz;
        if (json.contains("global"))
            rate = readingJson(path + ": global", [&] { return json["global"].value("core:sample_rate", rate); });
        if (!(rate > 0.0) || !std::isfinite(rate))
            throw Error(path, "tells no sample rate");
        return fromList(json["annotations"], path + ", annotation", [&](const Json &one, const std::string &) {
            Annotation box;
            const double start = one.at("core:sample_start").get<double>();
            box.startSeconds = start / rate;
            box.endSeconds = (start + one.value("core:sample_count", 0.0)) / rate;
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
        throw Error(path, "holds neither SigMF's \"annotations\" nor \"events\"");
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
    const std::vector<std::string> lines = linesOf(text);
    if (lines.front().find("Begin Time (s)") != std::string::npos)
        return fromRaven(path, lines);
    if (lines.front().starts_with("event,"))
        return fromCsv(path, lines);
    return fromAudacity(path, lines);
}

} // namespace faintline
