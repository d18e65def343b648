#include "reproduce/writeReproduction.h"

#include "base/Error.h"
#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "exchange/csvText.h"
#include "exchange/writeChart.h"

#include <cstdio>
#include <filesystem>
#include <system_error>

namespace faintline {

namespace {

    /// Four significant digits: more than any interval here supports.
    std::string shortNumber(double value)
    {
        char text[32];
        std::snprintf(text, sizeof text, "%.4g", value);
        return text;
    }

    /// Pads to a width counted in characters, not bytes.
    std::string padded(const std::string &text, std::size_t width, bool toTheRight)
    {
        std::size_t characters = 0;
        for (const char c : text)
            characters += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
        const std::string space(width > characters ? width - characters : 0, ' ');
        return toTheRight ? space + text : text + space;
    }

    bool hasInterval(const ReproducedCell &cell)
    {
        return cell.interval.low < cell.interval.high;
    }

    std::string verdict(const ReproducedCell &cell)
    {
        if (!cell.isJudged())
            return "not judged";
        return cell.isInside() ? "inside" : "OUTSIDE";
    }

    std::string csvNumber(const std::optional<double> &value)
    {
        return value ? formatNumber(*value) : "";
    }

    std::string reproductionCsv(const Reproduction &reproduction)
    {
        std::string csv = "row,column,paper,ours,low,high,reference,tolerance,verdict\n";
        for (const ReproducedCell &cell : reproduction.cells) {
            const bool interval = hasInterval(cell);
            csv += csvText(cell.row) + "," + csvText(cell.column) + "," + csvNumber(cell.paper) + ","
                   + formatNumber(cell.ours) + "," + (interval ? formatNumber(cell.interval.low) : "") + ","
                   + (interval ? formatNumber(cell.interval.high) : "") + "," + csvNumber(cell.reference) + ","
                   + (cell.isJudged() ? formatNumber(cell.tolerance) : "") + "," + verdict(cell) + "\n";
        }
        return csv;
    }

} // namespace

std::string reproductionText(const Reproduction &reproduction)
{
    using Row = std::vector<std::string>;
    std::vector<Row> rows{{"", "", "paper", "ours", "95 % interval", "gap", "z", "reference ± tolerance", ""}};
    for (const ReproducedCell &cell : reproduction.cells) {
        const std::optional<double> z = cell.z();
        rows.push_back(
            {cell.row, cell.column, cell.paper ? shortNumber(*cell.paper) : "-", shortNumber(cell.ours),
             hasInterval(cell) ? shortNumber(cell.interval.low) + " … " + shortNumber(cell.interval.high) : "exact",
             cell.paper ? shortNumber(cell.ours - *cell.paper) : "-", z ? shortNumber(*z) : "-",
             cell.isJudged() ? shortNumber(*cell.reference) + " ± " + shortNumber(cell.tolerance) : "-",
             verdict(cell)});
    }
    std::vector<std::size_t> widths(rows.front().size());
    for (const Row &row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) {
            std::size_t characters = 0;
            for (const char c : row[i])
                characters += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
            widths[i] = std::max(widths[i], characters);
        }
    std::string text = reproduction.name + ": " + reproduction.title + " (" + reproduction.quantity + ")\n";
    for (const Row &row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            line += (i == 0 ? "" : "  ") + padded(row[i], widths[i], i >= 2 && i + 1 < row.size());
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    for (const std::string &note : reproduction.notes)
        text += "note: " + note + "\n";
    return text;
}

std::string reproductionJson(const Reproduction &reproduction)
{
    const auto optional = [](const std::optional<double> &value) { return value ? Json(*value) : Json(nullptr); };
    Json cells = Json::array();
    for (const ReproducedCell &cell : reproduction.cells)
        cells.push_back({{"row", cell.row},
                         {"column", cell.column},
                         {"paper", optional(cell.paper)},
                         {"ours", cell.ours},
                         {"interval", hasInterval(cell) ? Json{cell.interval.low, cell.interval.high} : Json(nullptr)},
                         {"gap", cell.paper ? Json(cell.ours - *cell.paper) : Json(nullptr)},
                         {"z", optional(cell.z())},
                         {"reference", optional(cell.reference)},
                         {"tolerance", cell.isJudged() ? Json(cell.tolerance) : Json(nullptr)},
                         {"inside", cell.isJudged() ? Json(cell.isInside()) : Json(nullptr)}});
    const Json json{{"name", reproduction.name},
                    {"title", reproduction.title},
                    {"quantity", reproduction.quantity},
                    {"inside", reproduction.isInside()},
                    {"cells", cells},
                    {"notes", reproduction.notes}};
    return json.dump(2);
}

void writeReproduction(const Reproduction &reproduction, const std::string &folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw Error(folder, "cannot be created: " + error.message(), Error::Kind::Failure);
    std::string stem = reproduction.name;
    for (char &c : stem)
        c = c == ':' ? '-' : c;
    const std::string base = (std::filesystem::path(folder) / stem).string();
    writeTextFile(base + ".json", reproductionJson(reproduction) + "\n");
    writeTextFile(base + ".csv", reproductionCsv(reproduction));
    for (std::size_t i = 0; i < reproduction.charts.size(); ++i)
        writeTextFile(base + (i == 0 ? "" : '-' + std::to_string(i + 1)) + ".svg", chartSvg(reproduction.charts[i]));
}

} // namespace faintline
