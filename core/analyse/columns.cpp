#include "analyse/columns.h"

#include "base/Overloaded.h"
#include "base/logmath.h"
#include "base/numberText.h"
#include "base/oneLine.h"
#include "refine/secondLook.h"

#include <algorithm>
#include <type_traits>

namespace faintline {

namespace {

    template <class Row, class T>
    TableColumn<Row> columnOf(std::string name, T Row::*member)
    {
        return {std::move(name), [member](const Row &row) -> CellValue { return row.*member; }, T(),
                [member](Row &row, double value) { row.*member = T(value); }};
    }

    /// One of numbers along each axis.
    TableColumn<Event> columnOf(std::string name, std::vector<double> Event::*along, std::size_t axis)
    {
        return {std::move(name), [along, axis](const Event &e) -> CellValue { return (e.*along)[axis]; }, 0.0,
                [along, axis](Event &e, double value) {
                    (e.*along).resize(std::max((e.*along).size(), axis + 1));
                    (e.*along)[axis] = value;
                }};
    }

    std::string modelChangesText(const Event &event)
    {
        const auto textOf = [](const auto &change) {
            const auto &[seconds, model] = change;
            return formatNumber(seconds) + ':' + nameOfBankModel(model);
        };
        return listed(event.modelChanges, textOf, ";");
    }

    /// Whether it is not what isOptional of a column leaves out.
    bool isKnown(const CellValue &value)
    {
        return std::visit(Overloaded{[](const std::string &text) { return !text.empty(); },
                                     [](double number) { return !std::isnan(number); },
                                     [](auto number) { return number != 0; }},
                          value);
    }

} // namespace

std::string cellText(const CellValue &value)
{
    return std::visit(Overloaded{[](const std::string &text) { return text; },
                                 [](double number) { return formatNumber(number); },
                                 [](int number) { return std::to_string(number); }},
                      value);
}

Json cellJson(const CellValue &value)
{
    return std::visit([](const auto &held) { return Json(held); }, value);
}

std::vector<std::string> positionNames(const Grid &grid)
{
    std::vector<std::string> names;
    for (const Axis &axis : grid.axes)
        names.push_back(grid.isSpectrum() ? "f" : axis.name);
    return names;
}

OptionalColumns OptionalColumns::of(const AnalysisPlan &plan)
{
    return {looksTwice(plan), looksTwice(plan), plan.settings.subtract.lines, plan.isBank()};
}

std::vector<TableColumn<Event>> eventColumns(const Grid &grid, OptionalColumns optional)
{
    std::vector<TableColumn<Event>> columns;
    int keyRank = 0;
    bool isOptional = false;
    const auto add = [&](TableColumn<Event> column, const char *heading = "", const char *unit = "",
                         const char *sentence = "") {
        column.heading = heading;
        column.unit = unit;
        column.sentence = sentence;
        column.isOptional = isOptional;
        column.keyRank = keyRank;
        columns.push_back(std::move(column));
    };
    add(columnOf("event", &Event::id), "№", "", "Number, in order of detection");
    add(columnOf("t_onset", &Event::onsetSeconds), "Onset", "s",
        "Onset: time of the last reset of the detecting path, from the first sample");
    add(columnOf("t_detect", &Event::detectSeconds), "Det.", "s",
        "Detected: time at which the statistic first exceeded the threshold");
    add(columnOf("t_end", &Event::endSeconds), "End", "s", "Last frame with evidence");
    const std::vector<std::string> positions = positionNames(grid);
    for (std::size_t axis = 0; axis < positions.size(); ++axis)
        add(columnOf(positions[axis], &Event::position, axis));
    add(columnOf("drift_hz_per_s", &Event::driftPerSecond), "Drift", "Hz/s", "Straight-line slope of the track");
    keyRank = 2;
    add(columnOf("statistic", &Event::statistic), "D", "nat", "Largest statistic");
    add(columnOf("confirmed", &Event::isConfirmed));
    add(columnOf("open", &Event::isOpen));
    keyRank = 1;
    for (std::size_t axis = 0; !grid.isSpectrum() && axis < positions.size(); ++axis)
        add(columnOf(positions[axis] + "_per_s", &Event::ratesPerSecond, axis));
    isOptional = true;
    if (optional.secondPass) {
        keyRank = 5;
        add(columnOf("snr_db", &Event::snrDb), "SNR", "dB", "Mean signal-to-noise power ratio in one window and bin");
        add(columnOf("band_hz", &Event::bandWidth));
        add(columnOf("noise_probability", &Event::noiseProbability), "Chance of noise", "",
            "Probability that noise alone gives an event as significant as this one in this recording");
        add(columnOf("window_s", &Event::windowSeconds), "Window", "s",
            "Length of the window that found the event: the displayed one, or another one that sees it better");
        if (optional.kinds) {
            for (const SignalKind kind : {SignalKind::Keyed, SignalKind::Spread})
                add({nameOf(kind), [kind](const Event &e) { return e.kind == kind; }, false});
            add(columnOf("call", &Event::call), "Call", "",
                "Number of the strongest event among the overtones of one source");
        }
    }
    keyRank = 3;
    if (optional.subtracted)
        add(columnOf("subtracted", &Event::isSubtracted));
    if (optional.bank) {
        keyRank = 6;
        add({"model", [](const Event &e) { return nameOfBankModel(e.model); }, std::string()});
        keyRank = 4;
        add({"model_changes", &modelChangesText, std::string()});
    }
    return columns;
}

Json eventJson(const Event &e, const AnalysisPlan &plan)
{
    auto columns =
        eventColumns(plan.grid(), {.secondPass = true, .kinds = true, .subtracted = true, .bank = plan.isBank()});
    std::ranges::stable_sort(columns, {}, &TableColumn<Event>::keyRank);
    Json json;
    for (const TableColumn<Event> &column : columns)
        if (const CellValue value = column.value(e); !column.isOptional || isKnown(value))
            json[column.name] = cellJson(value);
    if (json.contains("model_changes")) {
        json["model_changes"] = Json::array();
        for (const auto &[seconds, model] : e.modelChanges)
            json["model_changes"].push_back({{"t", seconds}, {"model", nameOfBankModel(model)}});
    }
    return json;
}

std::vector<TableColumn<AreaEvent>> areaColumns()
{
    return {columnOf("t_onset", &AreaEvent::onsetSeconds), columnOf("t_end", &AreaEvent::endSeconds),
            columnOf("f_low", &AreaEvent::low), columnOf("f_high", &AreaEvent::high),
            columnOf("level_db", &AreaEvent::levelDb)};
}

std::vector<TableColumn<TrackPlace>> trackColumns(const Grid &grid, OptionalColumns optional)
{
    std::vector<TableColumn<TrackPlace>> columns;
    const auto add = [&columns](std::string name, const auto &take) {
        columns.push_back({std::move(name), [take](const TrackPlace &at) -> CellValue { return take(at); },
                           std::invoke_result_t<decltype(take), const TrackPlace &>()});
    };
    const auto addSmoothed = [&](const char *name, const auto &take) {
        add(name, [take](const TrackPlace &at) {
            const std::vector<SmoothedPoint> &smoothed = at.track->smoothed;
            return smoothed.empty() ? std::nan("") : take(smoothed[at.point], at.plan->grid().axes.back());
        });
        columns.back().isOptional = true;
    };
    add("t", [](const TrackPlace &at) { return at.plan->time().value(double(at.track->points[at.point].frame)); });
    for (std::size_t axis = 0; const std::string &name : positionNames(grid))
        add(name, [i = axis++](const TrackPlace &at) { return at.track->positionOf(at.point, at.plan->grid())[i]; });
    add("statistic", [](const TrackPlace &at) { return at.track->points[at.point].statistic; });
    if (optional.secondPass) {
        addSmoothed("f_low", [](const SmoothedPoint &p, const Axis &axis) { return axis.value(double(p.low)); });
        addSmoothed("f_high", [](const SmoothedPoint &p, const Axis &axis) { return axis.value(double(p.high)); });
        addSmoothed("presence", [](const SmoothedPoint &p, const Axis &) { return double(p.presence); });
        addSmoothed("snr_db", [](const SmoothedPoint &p, const Axis &) { return dbFromRatio(double(p.level)); });
    }
    if (optional.bank)
        add("model", [](const TrackPlace &at) {
            const Track &track = *at.track;
            return nameOfBankModel(modelAt(track.points[at.point].frame, track.model, track.modelChanges));
        });
    return columns;
}

} // namespace faintline
