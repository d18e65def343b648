#pragma once

#include "analysis/analyse.h"
#include "base/json.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// What a person thinks of a detection.
enum class Verdict { None, Accepted, Rejected };

/// "", "accepted", "rejected": as files write it. An unknown name means no verdict.
std::string nameOf(Verdict verdict);
Verdict verdictNamed(const std::string &name);

/// Where a signal ran: positions along every axis at some instants, straight in between.
struct SignalPath {
    std::vector<double> seconds;               ///< ascending, at most 17
    std::vector<std::vector<double>> position; ///< one per instant, of one value per axis (Hz; or m, degrees)
    std::vector<double> tolerance;             ///< per axis: two cells of the run it was seen in

    bool operator==(const SignalPath &) const = default;
};

/// What was said about one signal, whose parts may have been detected as several events.
struct Review {
    std::vector<SignalPath> paths;
    Verdict verdict = Verdict::None;
    std::string note;
    std::string label{}; ///< its class, as the person calls it

    bool operator==(const Review &) const = default;
};

/// A box somebody drew, or brought along from another program.
struct Annotation {
    double startSeconds = 0.0; ///< from the first sample
    double endSeconds = 0.0;
    std::optional<double> lowHz; ///< of both or none: over all frequencies
    std::optional<double> highHz;
    std::string label;
    std::string note;
    Verdict verdict = Verdict::None;

    bool operator==(const Annotation &) const = default;
};

/// All that a person added to a recording: a part of the session, of no influence on any detection.
struct Annotations {
    std::vector<Review> reviews;
    std::vector<Annotation> boxes;

    bool isEmpty() const { return reviews.empty() && boxes.empty(); }
    bool operator==(const Annotations &) const = default;
};

/// What was said about an event.
struct EventReview {
    int event = 0;
    Verdict verdict = Verdict::None;
    std::string note;
    int signal = 0; ///< number of the first event of the same signal: its own where it is alone
    std::string label{};

    bool operator==(const EventReview &) const = default;
};

/// The path of an event's track.
SignalPath pathOf(const Analysis &analysis, const Event &event);

/// Whether two paths are of one signal: they have at least half of the shorter one's time in common, and are there, on
/// average, at most two cells apart on every axis, cells of the coarser run. Events carry no name from one run to the
/// next; this is what a review holds on to when threshold or settings change. The mean distance in tolerances, or
/// nothing.
std::optional<double> distance(const SignalPath &a, const SignalPath &b, const std::vector<Axis> &axes);

/// Of each event the review whose paths are nearest, -1 where none is of its signal. Cost: events × paths.
std::vector<int> matchReviews(const Analysis &analysis, const std::vector<Event> &events,
                              const std::vector<Review> &reviews);

/// What was said about each of the events, in their order.
std::vector<EventReview> eventReviews(const Analysis &analysis, const std::vector<Event> &events,
                                      const std::vector<Review> &reviews);

/// The reviews that belong to none of the events, by their number: what was said of signals that these settings or this
/// threshold do not find.
std::vector<std::size_t> unmatchedReviews(const Analysis &analysis, const std::vector<Event> &events,
                                          const std::vector<Review> &reviews);

// ---- edits: each makes other reviews of the given ones; `ids` are of `events` ---------------------------------------

std::vector<Review> withVerdict(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                                const std::vector<int> &ids, Verdict verdict);
std::vector<Review> withNote(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                             int id, const std::string &note);
std::vector<Review> withLabel(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                              const std::vector<int> &ids, const std::string &label);
/// Several events are one signal from now on, with the first verdict and the first label among theirs, and all notes.
std::vector<Review> merged(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                           const std::vector<int> &ids);
/// Undoes a merge: what was said stays with each.
std::vector<Review> separated(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                              const std::vector<int> &ids);

Json toJson(const Annotations &annotations);
/// Throws Error naming `where.key`, or Json::exception for values of the wrong kind.
Annotations annotationsFromJson(const Json &json, const std::string &where);

} // namespace faintline
