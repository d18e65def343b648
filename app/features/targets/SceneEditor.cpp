#include "app/features/targets/SceneEditor.h"

#include "scene/PingTruth.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    ScenePlace placeOf(const PingMarks::Place &place)
    {
        return {place.along, place.across};
    }

} // namespace

SceneEditor::SceneEditor(Document &document, const PingViewports &viewports, QObject *parent)
    : QObject(parent), m_document(document), m_viewports(viewports)
{
    connect(&document, &Document::opened, this, [this] {
        m_draft.reset();
        m_gesture = Gesture::None;
        setPlacing(false);
        select({});
        if (scene())
            setRateUnit(rateUnitOf(*scene()));
        emit sceneChanged();
    });
    connect(&viewports, &PingViewports::planeChanged, this, &SceneEditor::mapChanged);
    connect(&document, &Document::settingsChanged, this, [this] {
        emit sceneChanged();
        keepSelection();
    });
}

const PingScene *SceneEditor::scene() const
{
    if (m_draft)
        return &*m_draft;
    const auto &pings = m_document.source().pings;
    return pings && !m_document.isEmpty() ? &*pings : nullptr;
}

std::vector<TargetShape> SceneEditor::shapes() const
{
    std::vector<TargetShape> result;
    if (!scene())
        return result;
    const PingTruth truth = pingTruth(*scene());
    for (std::size_t i = 0; i < truth.targets.size(); ++i) {
        TargetShape &shape = result.emplace_back();
        const TruthTarget &path = truth.targets[i];
        for (std::size_t k = 0; k < path.rangeMetres.size(); ++k)
            shape.path.push_back({path.rangeMetres[k], path.bearingDegrees[k]});
        for (const TargetCorner &corner : cornersOf(*scene(), scene()->targets[i]))
            shape.corners.push_back({corner.place.rangeMetres, corner.place.bearingDegrees});
    }
    return result;
}

std::vector<SceneEditor::Place> SceneEditor::reach() const
{
    constexpr int sidePoints = 24; // seen from above, sides across the bearing are arcs
    const auto &analysis = m_document.analysis();
    if (m_gesture != Gesture::Draw || !scene() || !analysis)
        return {};
    const PingTarget &target = scene()->targets[std::size_t(m_held.target)];
    const std::vector<TargetCorner> corners = cornersOf(*scene(), target);
    const std::vector<Axis> axes = pingGrid(*scene()).axes;
    if (target.legs.empty() || corners.size() <= target.legs.size())
        return {};
    const TargetCorner &from = corners[target.legs.size() - 1];
    const int pings = corners.back().ping - from.ping;
    const auto fastest = [&](std::size_t axis) {
        double rate = 0.0;
        for (std::size_t model = 0; model < analysis->modelCount(); ++model) {
            const KinematicAxis &rates = analysis->modelAt(model).space.axes()[axis];
            rate = std::max({rate, std::abs(rates.rate(0)), std::abs(rates.rate(rates.rateCount - 1))});
        }
        return rate * pings * axes[axis].step;
    };
    const double along = fastest(0), across = std::min(fastest(1), 0.5 * axes[1].step * double(axes[1].count));
    std::vector<Place> outline;
    const auto addSide = [&](double range, int sign) {
        for (int i = -sidePoints; i <= sidePoints; ++i)
            outline.push_back({std::clamp(range, axes[0].value(0.0), axes[0].value(double(axes[0].count - 1))),
                               from.place.bearingDegrees + across * sign * i / sidePoints});
    };
    addSide(from.place.rangeMetres - along, 1);
    addSide(from.place.rangeMetres + along, -1);
    outline.push_back(outline.front());
    return outline;
}

void SceneEditor::select(const TargetHandle &handle)
{
    if (handle == m_selected)
        return;
    m_selected = handle;
    emit selectionChanged();
}

/// After an undone step the selected target may be gone.
void SceneEditor::keepSelection()
{
    const int count = scene() ? int(scene()->targets.size()) : 0;
    if (m_selected.target >= count)
        return select({});
    if (m_selected.isNone())
        return;
    const int legs = int(scene()->targets[std::size_t(m_selected.target)].legs.size());
    select({m_selected.target, std::min(m_selected.corner, legs)});
}

void SceneEditor::setPlacing(bool isPlacing)
{
    if (isPlacing == m_isPlacing)
        return;
    m_isPlacing = isPlacing;
    emit placingChanged(isPlacing);
}

void SceneEditor::setRateUnit(RateUnit unit)
{
    if (unit == m_unit)
        return;
    m_unit = unit;
    emit rateUnitChanged();
}

/// Opening a scene lays out its targets and simulates no ping, so it does not need a job.
void SceneEditor::replace(const PingScene &after, const QString &text)
{
    Source source = m_document.source();
    if (!source.pings || *source.pings == after)
        return;
    source.pings = after;
    m_document.replaceOpened(openSource(source), text);
}

void SceneEditor::setDraft(PingScene draft)
{
    m_draft = std::move(draft);
    emit sceneChanged();
    keepSelection();
}

void SceneEditor::commit(const QString &text)
{
    if (!m_draft)
        return;
    const PingScene after = *std::exchange(m_draft, {});
    try {
        replace(after, text);
    } catch (const Error &error) {
        emit refused(error);
    }
    emit sceneChanged();
    keepSelection();
}

/// A new target appears in the ping shown and is as strong as the one before.
PingScene SceneEditor::withTargetAt(const Place &place) const
{
    PingScene after = *scene();
    PingTarget target;
    if (!after.targets.empty()) {
        target.snrDb = after.targets.back().snrDb;
        target.echo = after.targets.back().echo;
    }
    target.appearPing = int(pingTime(after).nearest(m_viewports.place().seconds));
    after.targets.push_back(withCornerAt(after, target, 0, placeOf(place), m_unit));
    return after;
}

PingScene SceneEditor::withLeg(const PingScene &scene, int target, const Place &place) const
{
    PingScene after = scene;
    PingTarget &changed = after.targets[std::size_t(target)];
    try {
        changed = withLegTo(scene, changed, placeOf(place), m_unit);
    } catch (const Error &error) {
        throw Error(tr("Target T%1, %2").arg(target + 1).arg(QString::fromStdString(error.where())).toStdString(),
                    error.why());
    }
    return after;
}

void SceneEditor::press(const TargetHandle &handle, const Place &place, bool addsLeg)
{
    m_gesture = Gesture::None;
    if (!scene())
        return;
    m_base = *scene();
    m_held = handle;
    if (!handle.isNone()) {
        const bool isEnd =
            handle.corner == int(m_base.targets[std::size_t(handle.target)].legs.size()); // all its legs are visible
        m_gesture = m_isPlacing && isEnd ? Gesture::Draw : Gesture::Move;
        m_text = m_gesture == Gesture::Draw ? tr("Draw a leg")
                 : handle.corner == 0       ? tr("Move a target")
                                            : tr("Change a leg");
        return select(handle);
    }
    if (!m_isPlacing)
        return;
    if (addsLeg && !m_selected.isNone()) {
        m_held = m_selected;
        m_gesture = Gesture::Draw;
        m_text = tr("Draw a leg");
        return drag(place);
    }
    PingScene placed = withTargetAt(place);
    m_base = placed;
    m_held = {int(placed.targets.size()) - 1, 0};
    m_gesture = Gesture::Draw;
    m_text = tr("Place a target");
    setDraft(std::move(placed));
    select(m_held);
}

void SceneEditor::drag(const Place &place)
{
    if (m_gesture == Gesture::None || !scene())
        return;
    if (m_gesture == Gesture::Move) {
        PingScene after = m_base;
        PingTarget &target = after.targets[std::size_t(m_held.target)];
        target = withCornerAt(m_base, target, std::size_t(m_held.corner), placeOf(place), m_unit);
        return setDraft(std::move(after));
    }
    try {
        PingScene after = withLeg(m_base, m_held.target, place);
        const int corner = int(after.targets[std::size_t(m_held.target)].legs.size());
        setDraft(std::move(after));
        select({m_held.target, corner});
    } catch (const Error &error) {
        emit refused(error);
    }
}

void SceneEditor::release()
{
    m_gesture = Gesture::None;
    commit(m_text);
}

void SceneEditor::abandon()
{
    m_gesture = Gesture::None;
    m_draft.reset();
    emit sceneChanged();
    keepSelection();
}

SceneEditor::Place SceneEditor::cursor() const
{
    const std::vector<double> &position = m_viewports.place().position;
    return position.size() < 2 ? Place() : Place{position[0], position[1]};
}

void SceneEditor::addTarget()
{
    if (!scene())
        return;
    const int target = int(scene()->targets.size());
    setDraft(withTargetAt(cursor()));
    commit(tr("Place a target"));
    select(target < int(scene()->targets.size()) ? TargetHandle{target, 0} : TargetHandle{});
}

void SceneEditor::addLeg()
{
    if (!scene() || m_selected.isNone())
        return;
    try {
        const int target = m_selected.target;
        setDraft(withLeg(*scene(), target, cursor()));
        commit(tr("Draw a leg"));
        select({target, int(scene()->targets[std::size_t(target)].legs.size())});
    } catch (const Error &error) {
        emit refused(error);
    }
}

void SceneEditor::removeSelected()
{
    if (!scene() || m_selected.isNone())
        return;
    PingScene after = *scene();
    const auto target = after.targets.begin() + m_selected.target;
    const int corner = m_selected.corner;
    if (corner == 0) {
        after.targets.erase(target);
        select({});
    } else {
        target->legs.erase(target->legs.begin() + (corner - 1));
    }
    setDraft(std::move(after));
    commit(corner == 0 ? tr("Remove a target") : tr("Remove a leg"));
}

void SceneEditor::clear()
{
    if (!scene())
        return;
    PingScene after = *scene();
    after.targets.clear();
    setDraft(std::move(after));
    commit(tr("Remove all targets"));
}

} // namespace faintline
