#include "inspect/Review.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace faintline {

namespace {

    constexpr std::size_t mostInstants = 17;
    constexpr double toleranceCells = 2.0;
    constexpr double leastShare = 0.5; ///< of the shorter path's time

    double wrapped(double difference, const Axis &axis)
    {
        const double period = double(axis.count) * axis.step;
        return axis.cyclic && period > 0.0 ? std::remainder(difference, period) : difference;
    }

    /// Position along an axis at a time within the path.
    double at(const SignalPath &path, double seconds, std::size_t axis)
    {
        const auto after = std::upper_bound(path.seconds.begin(), path.seconds.end(), seconds);
        if (after == path.seconds.begin())
            return path.position.front()[axis];
        if (after == path.seconds.end())
            return path.position.back()[axis];
        const auto i = std::size_t(after - path.seconds.begin());
        const double share = (seconds - path.seconds[i - 1]) / (path.seconds[i] - path.seconds[i - 1]);
        return std::lerp(path.position[i - 1][axis], path.position[i][axis], share);
    }

    std::vector<double> tolerancesOf(const Grid &grid)
    {
        std::vector<double> tolerances;
        for (const Axis &axis : grid.axes)
            tolerances.push_back(toleranceCells * axis.step);
        return tolerances;
    }

    const Event &eventOf(const std::vector<Event> &events, int id)
    {
        const auto found =
            std::find_if(events.begin(), events.end(), [id](const Event &event) { return event.id == id; });
        if (found == events.end())
            throw Error("event " + std::to_string(id), "does not exist");
        return *found;
    }

    /// Removes reviews without content that join no events.
    void dropEmpty(std::vector<Review> &reviews)
    {
        std::erase_if(reviews, [](const Review &review) {
            return review.paths.empty()
                   || (review.verdict == Verdict::None && review.note.empty() && review.label.empty()
                       && review.drawn.empty() && review.paths.size() == 1);
        });
    }

    /// The review of an event, created if necessary.
    Review &reviewOf(std::vector<Review> &reviews, const Analysis &analysis, const Event &event)
    {
        const int index = matchReviews(analysis, {event}, reviews).front();
        if (index >= 0)
            return reviews[std::size_t(index)];
        return reviews.emplace_back(Review{{pathOf(analysis, event)}, Verdict::None, {}, {}});
    }

    /// In order of time, a path that begins after the one before it has ended joined to it.
    std::vector<SignalPath> joined(std::vector<SignalPath> paths)
    {
        std::ranges::stable_sort(paths, {}, [](const SignalPath &path) { return path.seconds.front(); });
        std::vector<SignalPath> pieces;
        for (SignalPath &path : paths) {
            if (pieces.empty() || path.seconds.front() <= pieces.back().seconds.back()) {
                pieces.push_back(std::move(path));
                continue;
            }
            SignalPath &before = pieces.back();
            std::ranges::move(path.seconds, std::back_inserter(before.seconds));
            std::ranges::move(path.position, std::back_inserter(before.position));
        }
        return pieces;
    }

    Json toJson(const std::vector<SignalPath> &paths)
    {
        Json json = Json::array();
        for (const SignalPath &path : paths)
            json.push_back(toJson(path));
        return json;
    }

    Json toJson(const Review &review)
    {
        Json json = Json::object();
        if (review.verdict != Verdict::None)
            json["verdict"] = nameOf(review.verdict);
        if (!review.note.empty())
            json["note"] = review.note;
        if (!review.label.empty())
            json["label"] = review.label;
        json["paths"] = toJson(review.paths);
        if (!review.drawn.empty())
            json["drawn"] = toJson(review.drawn);
        return json;
    }

    Verdict verdictFromJson(const Json &json, const std::string &where)
    {
        const std::string name = json.value("verdict", std::string());
        if (verdictNamed(name) == Verdict::None && !name.empty())
            throw Error(where + ".verdict", "must be accepted or rejected");
        return verdictNamed(name);
    }

    SignalPath pathFromJson(const Json &json, const std::string &where)
    {
        checkKeys(json, where, {"seconds", "position", "tolerance"});
        SignalPath path{json.at("seconds"), json.at("position"), json.at("tolerance")};
        if (path.seconds.empty() || path.seconds.size() != path.position.size()
            || !std::is_sorted(path.seconds.begin(), path.seconds.end(), std::less_equal<>()))
            throw Error(where, "must have ascending seconds and a position for each");
        for (const std::vector<double> &position : path.position)
            if (position.size() != path.tolerance.size() || position.empty())
                throw Error(where + ".position", "must have a value and a tolerance for every axis");
        return path;
    }

    /// `read`: of a detected path, or of one drawn by hand, which may have any number of instants.
    std::vector<SignalPath> pathsFromJson(const Json &json, const std::string &where,
                                          SignalPath (*read)(const Json &json, const std::string &where))
    {
        std::vector<SignalPath> paths;
        for (const Json &path : json)
            paths.push_back(read(path, where + "[" + std::to_string(paths.size()) + "]"));
        return paths;
    }

    Review reviewFromJson(const Json &json, const std::string &where)
    {
        checkKeys(json, where, {"verdict", "note", "label", "paths", "drawn"});
        Review review{
            {}, verdictFromJson(json, where), json.value("note", std::string()), json.value("label", std::string())};
        review.paths = pathsFromJson(json.at("paths"), where + ".paths", signalPathFromJson);
        review.drawn = pathsFromJson(json.value("drawn", Json::array()), where + ".drawn", pathFromJson);
        return review;
    }

    Json toJson(const Annotation &box)
    {
        Json json = {{"seconds", {box.startSeconds, box.endSeconds}}};
        if (box.lowHz && box.highHz)
            json["hz"] = {*box.lowHz, *box.highHz};
        json["label"] = box.label;
        if (!box.note.empty())
            json["note"] = box.note;
        if (box.verdict != Verdict::None)
            json["verdict"] = nameOf(box.verdict);
        return json;
    }

    Annotation boxFromJson(const Json &json, const std::string &where)
    {
        checkKeys(json, where, {"seconds", "hz", "label", "note", "verdict"});
        Annotation box;
        box.startSeconds = json.at("seconds").at(0);
        box.endSeconds = json.at("seconds").at(1);
        if (json.contains("hz")) {
            box.lowHz = json["hz"].at(0).get<double>();
            box.highHz = json["hz"].at(1).get<double>();
        }
        box.label = json.value("label", std::string());
        box.note = json.value("note", std::string());
        box.verdict = verdictFromJson(json, where);
        if (box.endSeconds < box.startSeconds || (box.lowHz && *box.highHz < *box.lowHz))
            throw Error(where, "ends before it begins");
        return box;
    }

} // namespace

std::string nameOf(Verdict verdict)
{
    return verdict == Verdict::Accepted ? "accepted" : verdict == Verdict::Rejected ? "rejected" : "";
}

Verdict verdictNamed(const std::string &name)
{
    return name == "accepted" ? Verdict::Accepted : name == "rejected" ? Verdict::Rejected : Verdict::None;
}

Json toJson(const SignalPath &path)
{
    return {{"seconds", path.seconds}, {"position", path.position}, {"tolerance", path.tolerance}};
}

SignalPath signalPathFromJson(const Json &json, const std::string &where)
{
    SignalPath path = pathFromJson(json, where);
    if (path.seconds.size() > mostInstants)
        throw Error(where, "must have 17 instants at most");
    return path;
}

SignalPath pathOf(const Analysis &analysis, const Event &event)
{
    if (const Track *track = trackOfId(analysis.tracks, event.id); track && !track->points.empty())
        return pathOf(analysis, *track);
    return {{event.detectSeconds}, {event.detectedPosition}, tolerancesOf(analysis.grid())};
}

SignalPath pathOf(const Analysis &analysis, const Track &track)
{
    SignalPath path;
    const std::vector<Axis> &axes = analysis.grid().axes;
    path.tolerance = tolerancesOf(analysis.grid());
    const std::size_t last = track.points.size() - 1;
    const std::size_t steps = std::min(last, mostInstants - 1);
    for (std::size_t i = 0; i <= steps; ++i) {
        const TrackPoint &point = track.points[steps == 0 ? 0 : i * last / steps];
        path.seconds.push_back(analysis.time().value(double(point.frame)));
        path.position.push_back(analysis.grid().position(point.cell));
        if (i == 0)
            continue;
        // Across the seam of a cyclic axis a path continues smoothly.
        for (std::size_t axis = 0; axis < axes.size(); ++axis) {
            const double before = path.position[i - 1][axis];
            double &now = path.position[i][axis];
            now = before + wrapped(now - before, axes[axis]);
        }
    }
    return path;
}

std::optional<double> distance(const SignalPath &a, const SignalPath &b, const Grid &grid)
{
    if (!grid.fits(a.tolerance) || !grid.fits(b.tolerance))
        return {};
    const double begin = std::max(a.seconds.front(), b.seconds.front());
    const double end = std::min(a.seconds.back(), b.seconds.back());
    const double shorter = std::min(a.seconds.back() - a.seconds.front(), b.seconds.back() - b.seconds.front());
    if (end < begin || end - begin < leastShare * shorter)
        return {};
    double sum = 0.0;
    for (std::size_t axis = 0; axis < grid.axes.size(); ++axis) {
        double mean = 0.0;
        for (std::size_t i = 0; i < mostInstants; ++i) {
            const double seconds = std::lerp(begin, end, double(i) / double(mostInstants - 1));
            mean +=
                std::abs(wrapped(at(a, seconds, axis) - at(b, seconds, axis), grid.axes[axis])) / double(mostInstants);
        }
        const double inTolerances = mean / std::max(a.tolerance[axis], b.tolerance[axis]);
        if (!(inTolerances <= 1.0))
            return {};
        sum += inTolerances;
    }
    return sum;
}

std::vector<int> matchReviews(const Analysis &analysis, const std::vector<Event> &events,
                              const std::vector<Review> &reviews)
{
    std::vector<int> result;
    for (const Event &event : events) {
        int nearest = -1;
        double least = std::numeric_limits<double>::infinity();
        const SignalPath path = reviews.empty() ? SignalPath() : pathOf(analysis, event);
        for (std::size_t i = 0; i < reviews.size(); ++i)
            for (const SignalPath &known : reviews[i].paths)
                if (const auto apart = distance(path, known, analysis.grid()); apart && *apart < least) {
                    nearest = int(i);
                    least = *apart;
                }
        result.push_back(nearest);
    }
    return result;
}

std::vector<std::size_t> unmatchedReviews(const Analysis &analysis, const std::vector<Event> &events,
                                          const std::vector<Review> &reviews)
{
    const std::vector<int> matched = matchReviews(analysis, events, reviews);
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < reviews.size(); ++i)
        if (std::find(matched.begin(), matched.end(), int(i)) == matched.end())
            left.push_back(i);
    return left;
}

std::vector<EventReview> eventReviews(const Analysis &analysis, const std::vector<Event> &events,
                                      const std::vector<Review> &reviews)
{
    const std::vector<int> matches = matchReviews(analysis, events, reviews);
    std::vector<int> first(reviews.size(), 0);
    std::vector<EventReview> result;
    for (std::size_t i = 0; i < events.size(); ++i) {
        EventReview &one = result.emplace_back(EventReview{events[i].id, Verdict::None, {}, events[i].id, {}});
        if (matches[i] < 0)
            continue;
        const auto index = std::size_t(matches[i]);
        if (first[index] == 0) {
            first[index] = events[i].id;
            one.drawn = reviews[index].drawn;
        }
        one.verdict = reviews[index].verdict;
        one.note = reviews[index].note;
        one.label = reviews[index].label;
        one.signal = first[index];
    }
    return result;
}

std::vector<Review> withVerdict(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                                const std::vector<int> &ids, Verdict verdict)
{
    for (int id : ids)
        reviewOf(reviews, analysis, eventOf(events, id)).verdict = verdict;
    dropEmpty(reviews);
    return reviews;
}

std::vector<Review> withNote(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                             int id, const std::string &note)
{
    reviewOf(reviews, analysis, eventOf(events, id)).note = note;
    dropEmpty(reviews);
    return reviews;
}

std::vector<Review> withLabel(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                              const std::vector<int> &ids, const std::string &label)
{
    for (int id : ids)
        reviewOf(reviews, analysis, eventOf(events, id)).label = label;
    dropEmpty(reviews);
    return reviews;
}

std::vector<Review> withDrawn(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                              int id, std::vector<SignalPath> drawn)
{
    reviewOf(reviews, analysis, eventOf(events, id)).drawn = std::move(drawn);
    dropEmpty(reviews);
    return reviews;
}

std::vector<Review> merged(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                           const std::vector<int> &ids)
{
    if (ids.size() < 2)
        return reviews;
    Review one;
    bool isDrawn = false;
    for (int id : ids) {
        const Event &event = eventOf(events, id);
        if (matchReviews(analysis, {event}, {one}).front() == 0)
            continue; // already included
        Review &own = reviewOf(reviews, analysis, event);
        one.paths.insert(one.paths.end(), own.paths.begin(), own.paths.end());
        std::ranges::copy(own.drawn.empty() ? own.paths : own.drawn, std::back_inserter(one.drawn));
        isDrawn = isDrawn || !own.drawn.empty();
        if (one.verdict == Verdict::None)
            one.verdict = own.verdict;
        if (one.label.empty())
            one.label = own.label;
        if (!own.note.empty())
            one.note += (one.note.empty() ? "" : "; ") + own.note;
        own.paths.clear(); // so that no event matches it again
        dropEmpty(reviews);
    }
    one.drawn = isDrawn ? joined(std::move(one.drawn)) : std::vector<SignalPath>();
    reviews.push_back(one);
    return reviews;
}

std::vector<Review> separated(std::vector<Review> reviews, const Analysis &analysis, const std::vector<Event> &events,
                              const std::vector<int> &ids)
{
    for (int id : ids) {
        const int index = matchReviews(analysis, {eventOf(events, id)}, reviews).front();
        if (index < 0)
            continue;
        const Review whole = reviews[std::size_t(index)];
        reviews.erase(reviews.begin() + index);
        for (const SignalPath &path : whole.paths)
            reviews.push_back({{path}, whole.verdict, whole.note, whole.label});
    }
    dropEmpty(reviews);
    return reviews;
}

std::vector<SignalPath> piecesOf(const std::vector<Review> &reviews, const Analysis &analysis, const Event &event)
{
    const int index = matchReviews(analysis, {event}, reviews).front();
    if (index < 0)
        return {pathOf(analysis, event)};
    const Review &review = reviews[std::size_t(index)];
    return review.drawn.empty() ? joined(review.paths) : review.drawn;
}

std::vector<SignalPath> cutAt(const std::vector<SignalPath> &pieces, double seconds)
{
    std::vector<SignalPath> cut;
    for (const SignalPath &piece : pieces) {
        cut.push_back(piece);
        if (!(piece.seconds.front() < seconds && seconds < piece.seconds.back()))
            continue;
        std::vector<double> place;
        for (std::size_t axis = 0; axis < piece.tolerance.size(); ++axis)
            place.push_back(at(piece, seconds, axis));
        const auto before = std::ranges::lower_bound(piece.seconds, seconds) - piece.seconds.begin();
        const auto behind = std::ranges::upper_bound(piece.seconds, seconds) - piece.seconds.begin();
        cut.back().seconds.resize(std::size_t(before));
        cut.back().position.resize(std::size_t(before));
        cut.back().seconds.push_back(seconds);
        cut.back().position.push_back(place);
        SignalPath rest{{seconds}, {place}, piece.tolerance};
        rest.seconds.insert(rest.seconds.end(), piece.seconds.begin() + behind, piece.seconds.end());
        rest.position.insert(rest.position.end(), piece.position.begin() + behind, piece.position.end());
        cut.push_back(std::move(rest));
    }
    return cut;
}

Json toJson(const Annotations &annotations)
{
    Json json = {{"reviews", Json::array()}, {"boxes", Json::array()}};
    for (const Review &review : annotations.reviews)
        json["reviews"].push_back(toJson(review));
    for (const Annotation &box : annotations.boxes)
        json["boxes"].push_back(toJson(box));
    return json;
}

Annotations annotationsFromJson(const Json &json, const std::string &where)
{
    checkKeys(json, where, {"reviews", "boxes"});
    Annotations annotations;
    for (const Json &review : json.value("reviews", Json::array()))
        annotations.reviews.push_back(
            reviewFromJson(review, where + ".reviews[" + std::to_string(annotations.reviews.size()) + "]"));
    for (const Json &box : json.value("boxes", Json::array()))
        annotations.boxes.push_back(
            boxFromJson(box, where + ".boxes[" + std::to_string(annotations.boxes.size()) + "]"));
    return annotations;
}

} // namespace faintline
