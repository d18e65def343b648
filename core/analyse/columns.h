#pragma once

#include "analyse/events.h"
#include "base/json.h"

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace faintline {

/// What a cell of a table holds.
using CellValue = std::variant<bool, int, double, std::string>;

/// Shortest form that reads back the same, in the C locale; true is 1, false 0.
std::string cellText(const CellValue &value);
Json cellJson(const CellValue &value);

/// A column of a table of events, points of tracks, or areas. CSV, JSON, surveys, Python and the window's table are made
/// from the lists below.
template <class Row>
struct TableColumn {
    std::string name; ///< in files and in Python
    std::function<CellValue(const Row &)> value;
    CellValue kind = 0.0;                      ///< of the type that every value has
    std::function<void(Row &, double)> set{};  ///< of rows that are read back
    std::string heading{}, unit{}, sentence{}; ///< in the window's table, if it shows the column
    bool isOptional = false;                   ///< NaN, false or empty in some rows; JSON leaves it out there
    int keyRank = 0;                           ///< order of JSON's keys; those of one rank stand as in the list

    double number(const Row &row) const { return std::get<double>(value(row)); }
};

/// Names of a position's coordinates: f for a spectrum, else those of the axes.
std::vector<std::string> positionNames(const Grid &grid);

/// Which columns there are of those that not all events and tracks have.
struct OptionalColumns {
    bool secondPass = false; ///< secondLook.h
    bool kinds = false;      ///< of signals, with that; surveys have none
    bool subtracted = false; ///< subtractLines.h
    bool bank = false;       ///< of models

    static OptionalColumns of(const AnalysisPlan &plan);
};

std::vector<TableColumn<Event>> eventColumns(const Grid &grid, OptionalColumns optional);
/// An event with all columns that it has, as files and live runs tell it.
Json eventJson(const Event &event, const AnalysisPlan &plan);

std::vector<TableColumn<AreaEvent>> areaColumns();

/// A point of a track, which plan and track outlive.
struct TrackPlace {
    const AnalysisPlan *plan;
    const Track *track;
    std::size_t point;
};

/// The columns after the track's number.
std::vector<TableColumn<TrackPlace>> trackColumns(const Grid &grid, OptionalColumns optional);

} // namespace faintline
