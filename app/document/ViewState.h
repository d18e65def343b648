#pragma once

#include "base/json.h"
#include "widgets/base/Viewport.h"

#include <QString>

#include <optional>
#include <utility>
#include <vector>

namespace faintline {

/// View state: saved with a session, without influence on any result.
struct ViewState {
    std::optional<Viewport::Box> visible; ///< nothing: everything
    std::optional<Viewport::Point> cursor;
    QString orientation; ///< "newestOnTop", "oldestOnTop", "leftToRight"; empty: unchanged
    QString colourMap;
    bool isLogarithmic = false; ///< the frequency axis
    bool isRadioAxis = false;   ///< frequencies are labelled with the centre frequency added
    int firstChannel = 0;       ///< of the channels shown beside each other
    int selectedEvent = 0;      ///< 0: none

    // For sonar pings, where the frequency above is the range.
    std::optional<Span> bearing{}; ///< visible
    std::optional<double> cursorBearing{};
    bool isPolar = false;

    // For frames on more than two axes; the frequency and the bearing above are then along and across the map.
    std::optional<std::pair<std::size_t, std::size_t>> axes{}; ///< along, across
    std::vector<double> position{};                            ///< of the cursor, on all axes
    bool isSliced = false;                                     ///< hidden axes are cut at the cursor
};

/// As a session keeps it.
Json toJson(const ViewState &view);

/// Throws Error naming `where` and the key.
ViewState viewFromJson(const Json &json, const std::string &where);

} // namespace faintline
