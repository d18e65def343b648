#pragma once

#include "analysis/Review.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// One line of a list of events: an event, or a box somebody drew.
struct ReviewedRow {
    const Event *event = nullptr;
    int signal = 0;
    Annotation box; ///< an event's too: what its track fills
};

/// What an event's track fills on the last axis; its position at detection where there is none.
void fillBox(const Analysis &analysis, const Event &event, Annotation &box);

/// Shortest form that reads back the same; empty for nothing.
std::string numberOrEmpty(const std::optional<double> &value);

/// A Raven selection table, with columns for review and notes.
std::string ravenText(const std::vector<ReviewedRow> &rows);

/// Audacity labels with frequencies, "label [rejected] note".
std::string audacityText(const std::vector<ReviewedRow> &rows);

/// SigMF annotations of a recording of that rate and centre, Hz.
std::string sigmfText(const std::vector<ReviewedRow> &rows, double rate, double centre);

} // namespace faintline
