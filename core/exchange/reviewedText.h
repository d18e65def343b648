#pragma once

#include "base/json.h"
#include "inspect/Review.h"
#include "signal/Recording.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// One row of a list of events: an event, a piece of its line drawn by hand, or a box drawn by hand.
struct ReviewedRow {
    const Event *event = nullptr;
    int signal = 0; ///< 0: of a box
    Annotation box; ///< for an event, the extent of its track
};

/// Sets the box to the extent of an event's track along the last axis, or to its position without a track.
void fillBox(const Analysis &analysis, const Event &event, Annotation &box);

/// Shortest form that reads back the same; empty for nothing.
std::string numberOrEmpty(const std::optional<double> &value);

/// A Raven selection table, with columns for review and notes.
std::string ravenText(const std::vector<ReviewedRow> &rows);

/// Audacity labels with frequencies, "label [rejected] note".
std::string audacityText(const std::vector<ReviewedRow> &rows);

/// SigMF metadata of a recording for annotations of it: "global" (with the type of its samples, and the name of the file
/// that holds them), "captures" (its own, or one of each stretch without a gap) and an empty list of "annotations".
Json sigmfMetadata(const RecordingInfo &info, const std::string &description);

/// Adds a box with its label, and its note as the comment; returns the new annotation. SigMF counts the samples of the
/// file, gaps left out, from core:offset on.
Json &addAnnotation(Json &metadata, const Annotation &box, const RecordingInfo &info);

/// The text of metadata, with the annotations in order of their start, as SigMF requires.
std::string sigmfText(Json metadata);

/// SigMF annotations of a recording.
std::string sigmfText(const std::vector<ReviewedRow> &rows, const RecordingInfo &info);

} // namespace faintline
