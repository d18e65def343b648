#include "track/DetectionChain.h"

#include "track/Cluster.h"
#include "track/closeTrackers.h"
#include "track/constants.h"

#include <algorithm>
#include <cmath>

namespace faintline {

DetectionChain::DetectionChain(const MarkovModel &model, const Grid &grid, std::unique_ptr<PathDetector> detector,
                               ChainSettings settings)
    : DetectionChain(std::vector{model}, grid, std::move(detector), std::move(settings))
{
}

DetectionChain::DetectionChain(std::vector<MarkovModel> models, const Grid &grid,
                               std::unique_ptr<PathDetector> detector, ChainSettings settings)
    : m_models(std::move(models)), m_grid(grid), m_detector(std::move(detector)), m_settings(std::move(settings)),
      m_recent(m_models, grid, m_settings.onsetFrames == 1), m_lambda(std::size_t(grid.size()))
{
    for (const MarkovModel &model : m_models)
        m_trackerModels.push_back(std::make_unique<TrackerModel>(
            model, grid, m_settings.track, m_settings.trackThreshold.value_or(m_settings.threshold)));
    for (const auto &tracker : m_trackerModels)
        tracker->measuresOffsets = m_settings.skirtStep > 0 && m_grid.isSpectrum();
    m_rivals = RivalModels(m_trackerModels);
}

void DetectionChain::update(Index frame, std::span<const float> y, std::span<float> statistic)
{
    if (!m_settings.feedback) {
        m_detector->update(y, statistic);
        return;
    }
    forgetBoxes();
    updateTrackers(frame, y);

    RecentFrames::Seen seen;
    seen.y.assign(y.begin(), y.end());
    keepExcursions();
    for (const HmmTracker &tracker : m_trackers) {
        m_boxes.push_back(boxRound(tracker.coordinates(), y));
        m_boxTracks.push_back(tracker.track().id);
    }
    addExcluded(y);
    const std::size_t leftAlone = m_settings.inhibits ? 0 : m_excursions + m_trackers.size();
    m_detector->inhibit(inhibit(std::span(m_boxes).subspan(leftAlone), seen.y));
    m_detector->update(seen.y, statistic);
    for (std::size_t i = 0; i < m_detector->modelCount(); ++i)
        seen.lnK.push_back(m_detector->regulation(i).stepLnK);
    m_recent.add(frame, std::move(seen), *m_detector);

    const auto clusters =
        findClusters(m_grid, statistic, m_settings.threshold, m_settings.shoulder, m_settings.linkCells);
    for (const Cluster &cluster : clusters)
        startTrack(frame, cluster, y);
    if (m_settings.resets)
        m_recent.newest().forgotten.assign(forgottenBoxes().begin(), forgottenBoxes().end());
    if (m_settings.trackThreshold)
        return showStatistic(y, statistic);
    for (const HmmTracker &tracker : m_trackers)
        tracker.paint(statistic);
}

Index DetectionChain::updateSome(Index frame, std::span<const float> y, std::span<float> statistic)
{
    const std::size_t cells = m_lambda.size();
    const Index count = takenTogether(frame, y);
    const std::size_t size = std::size_t(count) * cells;
    if (count > 1 && advanceTogether(frame, y.first(size), statistic.first(size)))
        return count;
    update(frame, y.first(cells), statistic.first(cells));
    m_regulations = {m_detector->regulation()};
    return 1;
}

void DetectionChain::updateAll(Index frame, std::span<const float> y, std::span<float> statistic)
{
    while (!y.empty()) {
        const Index taken = updateSome(frame, y, statistic);
        frame += taken;
        y = y.subspan(std::size_t(taken) * m_lambda.size());
        statistic = statistic.subspan(std::size_t(taken) * m_lambda.size());
    }
}

Index DetectionChain::takenTogether(Index frame, std::span<const float> y) const
{
    const bool forgetsExcluded = m_settings.excluded.empty() || (m_settings.resets && m_settings.forgetCells.empty());
    if (frame < m_singlyBefore || !m_trackers.empty() || !forgetsExcluded || !m_settings.feedback
        || m_settings.trackThreshold)
        return 1;
    const Index count = std::min(m_recent.framesToScores(frame), std::ssize(y) / m_grid.size());
    return m_detector->takenTogether(y.first(std::size_t(count * m_grid.size())));
}

/// Returns false, and leaves all as it was, if a track starts in one of the frames, on which those after it depend.
bool DetectionChain::advanceTogether(Index frame, std::span<const float> y, std::span<float> statistic)
{
    forgetBoxes();
    std::vector<float> taken(y.begin(), y.end());
    std::vector<std::vector<Index>> inhibited;
    std::vector<std::vector<CellBox>> boxes;
    for (std::size_t at = 0; at < y.size(); at += m_lambda.size()) {
        m_boxes.clear();
        m_boxTracks.clear();
        addExcluded(y.subspan(at, m_lambda.size()));
        inhibited.push_back(inhibit(m_boxes, std::span(taken).subspan(at, m_lambda.size())));
        boxes.push_back(m_boxes);
    }
    m_regulations = m_detector->updateTogether(taken, statistic, inhibited);
    if (anyAbove(statistic, m_settings.threshold)) {
        m_detector->takeBack();
        m_boxes.clear(); // those before have been forgotten
        m_boxTracks.clear();
        m_singlyBefore = frame + std::ssize(m_regulations);
        return false;
    }
    auto row = taken.begin();
    for (std::size_t i = 0; i < boxes.size(); ++i, row += m_grid.size())
        m_recent.add(frame + Index(i), {{row, row + m_grid.size()}, {m_regulations[i].stepLnK}, std::move(boxes[i])},
                     *m_detector);
    return true;
}

/// Cells that the last frame's tracks took over are forgotten only now, so that between frames the scores are those
/// displayed.
void DetectionChain::forgetBoxes()
{
    if (m_settings.resets)
        for (const CellBox &box : forgottenBoxes())
            m_detector->forget(m_grid, box);
}

void DetectionChain::addExcluded(std::span<const float> y)
{
    for (const std::vector<Index> &place : m_settings.excluded) {
        m_boxes.push_back(boxRound(place, y, constantLeakageFactor));
        m_boxTracks.push_back(0);
    }
}

void DetectionChain::showStatistic(std::span<const float> y, std::span<float> statistic)
{
    std::vector<float> received(y.begin(), y.end());
    for (const std::vector<Index> &place : m_settings.excluded)
        boxRound(place, y, constantLeakageFactor).forEachCell(m_grid, [&](Index cell) {
            received[std::size_t(cell)] = 0.0f;
        });
    m_detector->showStatistic(received, statistic);
}

std::span<const CellBox> DetectionChain::forgottenBoxes() const
{
    return m_settings.forgetCells.empty() ? std::span(m_boxes).subspan(m_excursions) : std::span(m_newBoxes);
}

void DetectionChain::keepExcursions()
{
    // A whole excursion is forgotten when its track starts, and in the following frame all of it is inhibited, even if
    // it is wider than the track's box by then.
    m_excursions = m_settings.trackThreshold && m_settings.forgetCells.empty() ? m_newBoxes.size() : 0;
    const auto begun = std::ptrdiff_t(m_excursions);
    m_boxes.erase(m_boxes.begin(), m_boxes.end() - begun);
    m_boxTracks.erase(m_boxTracks.begin(), m_boxTracks.end() - begun);
    m_newBoxes.clear();
}

/// Sets y to 0 in the boxes; returns their cells, ascending.
std::vector<Index> DetectionChain::inhibit(std::span<const CellBox> boxes, std::span<float> y) const
{
    std::vector<Index> cells;
    for (const CellBox &box : boxes)
        box.forEachCell(m_grid, [&](Index cell) {
            y[std::size_t(cell)] = 0.0f;
            cells.push_back(cell);
        });
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
}

std::vector<DetectionChain::Inhibition> DetectionChain::inhibitions() const
{
    std::vector<Inhibition> result;
    for (std::size_t i = 0; i < m_boxes.size(); ++i)
        result.push_back({m_boxTracks[i], m_boxes[i]});
    return result;
}

void DetectionChain::updateTrackers(Index frame, std::span<const float> y)
{
    if (m_trackers.empty())
        return;
    m_models.front().likelihood.apply(y, m_lambda);
    for (const std::vector<Index> &place : m_settings.excluded) {
        const CellBox box = boxRound(place, y, constantLeakageFactor);
        if (box.halfWidth.back() > m_settings.inhibitCells.back()) // there is a constant with side lobes
            box.forEachCell(m_grid, [this](Index cell) { m_lambda[std::size_t(cell)] = nothingSeen(); });
    }
    std::vector<HmmTracker> going;
    std::vector<std::vector<Index>> places; // as of the last frame, because some trackers are about to move or end
    for (const HmmTracker &tracker : m_trackers)
        places.push_back(tracker.coordinates());
    places.insert(places.end(), m_settings.excluded.begin(), m_settings.excluded.end());
    const PlaceIndex index(m_grid, std::move(places));
    std::vector<double> lnK;
    for (std::size_t model = 0; model < m_models.size(); ++model)
        lnK.push_back(m_detector->regulation(model).lnK);
    for (std::size_t i = 0; i < m_trackers.size(); ++i) {
        HmmTracker &tracker = m_trackers[i];
        const auto hidden = maskNeighbours(index, i);
        bool goesOn = tracker.update(frame, m_lambda, lnK[tracker.model()]);
        goesOn = m_rivals.update(tracker, goesOn, frame, m_lambda, lnK);
        for (const auto &[cell, value] : hidden)
            m_lambda[std::size_t(cell)] = value;
        if (goesOn)
            going.push_back(std::move(tracker));
        else
            m_ended.push_back(tracker.finish(false));
    }
    m_trackers = std::move(going);
    endDuplicates();
    m_rivals.keepOnly(m_trackers);
}

float DetectionChain::nothingSeen() const
{
    return float(m_models.front().likelihood.at(0.0));
}

std::vector<std::pair<Index, float>> DetectionChain::maskNeighbours(const PlaceIndex &places, std::size_t own)
{
    std::vector<std::pair<Index, float>> hidden;
    const Index farthest = m_trackerModels.front()->largestExtent;
    for (const Index cell : cellsOfNeighbours(m_grid, places, own, farthest, m_settings.inhibitCells)) {
        float &value = m_lambda[std::size_t(cell)];
        hidden.emplace_back(cell, value);
        value = nothingSeen();
    }
    // Undoing in reverse order restores the first value of a cell hidden twice.
    std::reverse(hidden.begin(), hidden.end());
    return hidden;
}

void DetectionChain::endDuplicates()
{
    for (Track &track : endedDuplicates(m_trackers, m_grid, m_settings.linkCells))
        m_ended.push_back(std::move(track));
}

CellBox DetectionChain::boxRound(const std::vector<Index> &centre, std::span<const float> y, double margin) const
{
    CellBox box{centre, m_settings.inhibitCells};
    const double level = double(std::max(0.0f, y[std::size_t(m_grid.cell(centre))])); // 0 if not observed
    if (m_settings.leakageExtent)
        box.halfWidth.back() = std::max(box.halfWidth.back(), m_settings.leakageExtent(margin * level));
    return overSkirts(std::move(box), m_grid, y, m_settings.skirtStep);
}

double DetectionChain::scoreOf(Index state, std::size_t model) const
{
    return double(m_detector->scores(model)[std::size_t(state)]);
}

Index DetectionChain::bestState(Index cell) const
{
    const std::size_t model = m_detector->winnerAt(cell);
    const StateSpace &space = m_models[model].space;
    const std::span<const float> scores = m_detector->scores(model);
    Index best = cell;
    for (Index plane = 1; plane < space.planeCount(); ++plane) {
        const Index state = plane * space.cellCount() + cell;
        if (scores[std::size_t(state)] > scores[std::size_t(best)])
            best = state;
    }
    return best;
}

std::vector<PathStep> DetectionChain::detectorPathInto(Index state, std::size_t model) const
{
    return tracePath(m_models[model], m_grid, m_recent.record(model),
                     {m_recent.newestFrame(), state, scoreOf(state, model)});
}

std::size_t ChainState::bytes() const
{
    std::size_t total = sizeof *this + detector->bytes() + boxTracks.capacity() * sizeof(int);
    for (const HmmTracker &tracker : trackers)
        total += tracker.bytes();
    for (const auto &[track, others] : rivals)
        for (const HmmTracker &rival : others)
            total += rival.bytes();
    for (const std::vector<CellBox> *list : {&boxes, &newBoxes})
        for (const CellBox &box : *list)
            total += sizeof box + (box.centre.capacity() + box.halfWidth.capacity()) * sizeof(Index);
    return total;
}

std::shared_ptr<const ChainState> DetectionChain::state() const
{
    auto detector = m_detector->state();
    if (!detector)
        return {};
    auto result = std::make_shared<ChainState>();
    result->detector = std::move(detector);
    result->trackers.reserve(m_trackers.size());
    for (const HmmTracker &tracker : m_trackers)
        result->trackers.push_back(tracker.withoutPast(*m_trackerModels[tracker.model()]));
    result->rivals = m_rivals.state();
    result->boxes = m_boxes;
    result->newBoxes = m_newBoxes;
    result->boxTracks = m_boxTracks;
    result->excursions = m_excursions;
    result->nextId = m_nextId;
    return result;
}

void DetectionChain::setState(const ChainState &state)
{
    m_detector->setState(*state.detector);
    m_trackers.clear();
    for (const HmmTracker &tracker : state.trackers)
        m_trackers.push_back(tracker.withoutPast(*m_trackerModels[tracker.model()]));
    m_rivals.setState(state.rivals);
    m_ended.clear();
    m_boxes = state.boxes;
    m_newBoxes = state.newBoxes;
    m_boxTracks = state.boxTracks;
    m_excursions = state.excursions;
    m_nextId = state.nextId;
    m_recent.clear();
}

std::span<const CellBox> DetectionChain::forgotten() const
{
    return m_settings.resets ? forgottenBoxes() : std::span<const CellBox>();
}

void DetectionChain::startTrack(Index frame, const Cluster &cluster, std::span<const float> y)
{
    const Index state = bestState(cluster.peakCell);
    Track track;
    track.id = m_nextId++;
    track.detectFrame = frame;
    track.model = m_detector->winnerAt(cluster.peakCell);
    const std::size_t model = track.model;
    const StateSpace &space = m_models[model].space;
    RecursionRecord recent = m_recent.record(model);
    if (m_settings.onsetFrames > 0)
        recent.firstFrame = std::max(recent.firstFrame, frame - m_settings.onsetFrames + 1);
    for (const PathStep &step : tracePath(m_models[model], m_grid, recent, {frame, state, scoreOf(state, model)}))
        track.points.push_back({step.frame, space.cellOf(step.state), space.planeOf(step.state), step.score});
    trimOnset(track.points);
    if (m_trackerModels[model]->measuresOffsets)
        measureOffsets(track.points, track.points.size(), [&](std::size_t i, Index cell) {
            const std::vector<float> &seen = m_recent.at(track.points[i].frame).y;
            return cell < 0 || cell >= std::ssize(seen)
                       ? 0.0
                       : m_models[model].likelihood.at(double(seen[std::size_t(cell)]));
        });
    track.onsetFrame = track.points.front().frame;
    track.isConfirmed = m_settings.track.confirmFrames <= 1 && m_settings.track.confirmNats <= 0.0;
    track.confirmFrame = track.isConfirmed ? frame : -1;

    track.detectStatistic = double(cluster.peakStatistic);
    const double offset = m_settings.trackThreshold ? 0.0 : track.detectStatistic - scoreOf(state, model);
    m_boxTracks.push_back(track.id);
    m_trackers.emplace_back(*m_trackerModels[model], std::move(track),
                            HmmTracker::Seed{state, cluster.cells, m_detector->scores(model), offset});

    // The box must contain the whole cluster; otherwise its rim would start a second track in the next frame.
    CellBox box = boxRound(m_grid.coordinates(cluster.peakCell), y);
    for (std::size_t axis = 0; axis < m_settings.forgetCells.size(); ++axis)
        box.halfWidth[axis] = std::max(box.halfWidth[axis], m_settings.forgetCells[axis]);
    box = overCells(std::move(box), m_grid, cluster.cells, m_settings.linkCells);
    m_newBoxes.push_back(box);
    m_boxes.push_back(std::move(box));
}

void DetectionChain::finish()
{
    for (HmmTracker &tracker : m_trackers)
        m_ended.push_back(tracker.finish(true));
    m_trackers.clear();
    std::sort(m_ended.begin(), m_ended.end(), [](const Track &a, const Track &b) { return a.id < b.id; });
}

std::vector<Track> DetectionChain::takeEnded()
{
    return std::exchange(m_ended, {});
}

Index DetectionChain::longestRunUp() const
{
    return m_settings.onsetFrames > 0 ? std::min(m_settings.onsetFrames, longestPath()) : longestPath();
}

JoinRule DetectionChain::joinRule() const
{
    std::vector<Index> reach = m_trackerModels.front()->reach;
    for (const auto &model : m_trackerModels)
        for (std::size_t axis = 0; axis < reach.size(); ++axis)
            reach[axis] = std::max(reach[axis], model->reach[axis]);
    return {m_trackerModels.front()->threshold, m_settings.track.smoothingFrames, m_settings.linkCells, reach,
            m_trackerModels.front()->halfWidth, m_settings.keepsNumbers};
}

std::vector<Track> DetectionChain::takeJoinedTracks()
{
    return joinTracks(takeEnded(), m_grid, joinRule());
}

} // namespace faintline
