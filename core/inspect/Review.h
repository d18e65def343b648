#pragma once

#include "analyse/events.h"
#include "base/json.h"
#include "plan/Analysis.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// A person's judgement of a detection.
enum class Verdict { None, Accepted, Rejected };

/// "", "accepted", "rejected", as in files. An unknown name means no verdict.
std::string nameOf(Verdict verdict);
Verdict verdictNamed(const std::string &name);

/// Path of a signal: positions along each axis at some instants, linear in between.
struct SignalPath {
    std::vector<double> seconds;               ///< ascending; of a detected one at most 17
    std::vector<std::vector<double>> position; ///< one per instant, of one value per axis (Hz; or m, degrees)
    std::vector<double> tolerance;             ///< per axis: two cells of the run in which it was detected

    bool operator==(const SignalPath &) const = default;
};

/// Review of one signal, whose parts may have been detected as several events.
struct Review {
    std::vector<SignalPath> paths;
    Verdict verdict = Verdict::None;
    std::string note;
    std::string label{}; ///< class assigned by the person
    /// Where the person says that the signal is: pieces drawn by hand, in order of time; empty: as detected.
    std::vector<SignalPath> drawn{};

    bool operator==(const Review &) const = default;
};

/// A box drawn by a person or imported from another program.
struct Annotation {
    double startSeconds = 0.0; ///< from the first sample
    double endSeconds = 0.0;
    std::optional<double> lowHz; ///< either both or neither is set; neither: all frequencies
    std::optional<double> highHz;
    std::string label;
    std::string note;
    Verdict verdict = Verdict::None;

    bool operator==(const Annotation &) const = default;
};

/// Everything a person added to a recording: part of the session, without influence on any detection.
struct Annotations {
    std::vector<Review> reviews;
    std::vector<Annotation> boxes;

    bool isEmpty() const { return reviews.empty() && boxes.empty(); }
    bool operator==(const Annotations &) const = default;
};

/// Review of an event.
struct EventReview {
    int event = 0;
    Verdict verdict = Verdict::None;
    std::string note;
    int signal = 0; ///< number of the first event of the same signal, its own if it is alone
    std::string label{};
    std::vector<SignalPath> drawn{}; ///< with the signal's first event

    bool operator==(const EventReview &) const = default;
};

/// The path of a track, and of an event's.
SignalPath pathOf(const Analysis &analysis, const Track &track);
SignalPath pathOf(const Analysis &analysis, const Event &event);

/// Mean distance of two paths in tolerances, or nothing if they are not of the same signal. They are if they share at
/// least half of the shorter one's time and are there, on average, at most two cells (of the coarser run) apart on each
/// axis. Reviews are matched in this way when threshold or settings change, because events have no identity across
/// runs.
std::optional<double> distance(const SignalPath &a, const SignalPath &b, const Grid &grid);

/// For each event the index of the review with the nearest path, or -1 if none is of its signal. Cost: events × paths.
std::vector<int> matchReviews(const Analysis &analysis, const std::vector<Event> &events,
                              const std::vector<Review> &reviews);

/// The review of each event, in the order of the events.
std::vector<EventReview> eventReviews(const Analysis &analysis, const std::vector<Event> &events,
                                      const std::vector<Review> &reviews);

/// Indices of the reviews that match no event: their signals are not detected with these settings or this threshold.
std::vector<std::size_t> unmatchedReviews(const Analysis &analysis, const std::vector<Event> &events,
                                          const std::vector<Review> &reviews);

// ---- edits: each returns changed reviews; `ids` are of `events` -----------------------------------------------------

std::vector<Review> withVerdict(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                                const std::vector<int> &ids, Verdict verdict);
std::vector<Review> withNote(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                             int id, const std::string &note);
std::vector<Review> withLabel(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                              const std::vector<int> &ids, const std::string &label);
/// `drawn` empty: as detected.
std::vector<Review> withDrawn(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                              int id, std::vector<SignalPath> drawn);
/// Merges several events into one signal, with the first verdict and the first label among theirs, and all notes. What
/// was drawn of one of them is joined with the others' paths.
std::vector<Review> merged(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                           const std::vector<int> &ids);
/// Undoes a merge; each part keeps the review, but for what was drawn.
std::vector<Review> separated(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                              const std::vector<int> &ids);

/// Where an event's signal is: as drawn, else as detected, pieces that follow each other joined.
std::vector<SignalPath> piecesOf(const std::vector<Review> &reviews, const Analysis &analysis, const Event &event);
/// The same pieces, the one at that time cut in two.
std::vector<SignalPath> cutAt(const std::vector<SignalPath> &pieces, double seconds);

Json toJson(const SignalPath &path);
/// Throws Error naming `where`, or Json::exception for values of the wrong kind.
SignalPath signalPathFromJson(const Json &json, const std::string &where);
Json toJson(const Annotations &annotations);
/// Throws Error naming `where.key`, or Json::exception for values of the wrong kind.
Annotations annotationsFromJson(const Json &json, const std::string &where);

} // namespace faintline
