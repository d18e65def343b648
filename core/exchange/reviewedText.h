#pragma once

#include "inspect/Review.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// One row of a list of events: an event or a manually drawn box.
struct ReviewedRow {
    const Event *event = nullptr;
    int signal = 0;
    Annotation box; ///< for an event, the extent of its track
};

/// Sets the box to the extent of an event's track along the last axis, or to its position at detection without a track.
void fillBox(const Analysis &analysis, const Event &event, Annotation &box);

/// Shortest form that reads back the same; empty for nothing.
std::string numberOrEmpty(const std::optional<double> &value);

/// A Raven selection table, with columns for review and notes.
std::string ravenText(const std::vector<ReviewedRow> &rows);

/// Audacity labels with frequencies, "label [rejected] note".
std::string audacityText(const std::vector<ReviewedRow> &rows);

/// SigMF annotations of a recording with the given sample rate and centre frequency, Hz.
std::string sigmfText(const std::vector<ReviewedRow> &rows, double rate, double centre);

} // namespace faintline
