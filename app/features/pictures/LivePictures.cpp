#include "app/features/pictures/LivePictures.h"

#include "app/document/statisticUnit.h"
#include "app/features/pictures/Closeup.h"
#include "widgets/base/quantities.h"
#include "widgets/base/settingWords.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QEvent>
#include <QTimer>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace faintline {

namespace {

    constexpr Index framesInSight = 600;     // initially in a live picture: about a pixel each
    constexpr Index longestColouring = 8192; // frames used to choose a live picture's colours

} // namespace

LivePictures::LivePictures(Document &document, WaterfallView &input, WaterfallView &output, StripPlot &statistic,
                           QObject *parent)
    : QObject(parent), m_document(document), m_input(input), m_output(output), m_statistic(statistic)
{
    output.canvas()->installEventFilter(this);
}

void LivePictures::clear()
{
    m_plan.reset();
    for (WaterfallView *view : {&m_input, &m_output}) {
        view->setStartUnixSeconds({});
        view->setTimes({});
    }
    m_statistic.setStartUnixSeconds({});
}

/// Colours are chosen again whenever the frames to choose from have doubled.
void LivePictures::show(const Closeup &closeup)
{
    const LiveView &live = m_document.live();
    const Axis &frequency = live.plan->grid().axes.back();
    const bool isFirst = !m_plan;
    const bool isOther = isFirst || m_plan->frames != live.plan->frames;
    const bool isChanged = m_plan != live.plan;
    m_plan = live.plan;
    if (isOther || (live.time.count >= 2 * m_colouredFrames && live.time.count <= longestColouring)) {
        m_colouredFrames = live.time.count;
        m_input.setPicture(live.input, frequency);
        m_output.setPicture(live.statistic, frequency);
        m_statistic.setEmptySentence(tr("Click a picture to plot D at that frequency over time."));
    }
    const auto lookedBack = closeup.lookedBackAt(m_input);
    m_input.setGrownPicture(live.input, lookedBack ? lookedBack : live.newInput);
    const auto lookedBackOut = closeup.lookedBackAt(m_output);
    m_output.setGrownPicture(live.statistic, lookedBackOut ? lookedBackOut : live.newStatistic);
    growExtents(isFirst);
    showTracks();
    if (isChanged) {
        for (WaterfallView *view : {&m_input, &m_output})
            view->setStartUnixSeconds(live.plan->recording->info().startUnixSeconds);
        m_statistic.setStartUnixSeconds(live.plan->recording->info().startUnixSeconds);
        markChanges();
        emit planChanged();
    }
    m_isToBePainted = true;
}

bool LivePictures::isStripDue()
{
    constexpr qint64 stripMs = 200;
    if (!m_document.viewport().cursor() || (m_stripAge.isValid() && m_stripAge.elapsed() < stripMs))
        return false;
    m_stripAge.start();
    return true;
}

/// Only the visible ones, of possibly a day's.
void LivePictures::showTracks()
{
    const LiveView &live = m_document.live();
    const Axis &time = live.plan->time();
    const Span &visible = m_document.viewport().time();
    const auto isInSight = [&](double from, double to) { return to >= visible.low && from <= visible.high; };
    std::vector<Event> events;
    std::ranges::copy_if(*live.events, std::back_inserter(events), [&](const Event &event) {
        return isInSight(event.onsetSeconds, event.isOpen ? time.value(double(live.time.count)) : event.endSeconds);
    });
    std::vector<std::shared_ptr<const Track>> tracks;
    std::ranges::copy_if(live.tracks, std::back_inserter(tracks), [&](const auto &track) {
        return isInSight(time.value(double(track->points.front().frame)),
                         time.value(double(track->points.back().frame)));
    });
    for (WaterfallView *view : {&m_input, &m_output})
        view->setLiveTracks(events, tracks, time);
}

/// Initially leaves room for some frames, which then fill it.
void LivePictures::growExtents(bool isFirst)
{
    const LiveView &live = m_document.live();
    const Viewport::Box full = WaterfallView::extents(live.time, live.plan->grid().axes.back());
    const Index frames = std::min(framesInSight, LiveHistory::singleFrames(live.input->cells()));
    const double width = double(frames) * live.time.step;
    const Span time{full.time.low, std::max(full.time.high, full.time.low + width)};
    Viewport &viewport = m_document.viewport();
    if (!isFirst && full.frequency == viewport.extents().frequency)
        return viewport.grow(time);
    constexpr double fewestCells = 8.0;
    viewport.setExtents(time, full.frequency, fewestCells * live.time.step,
                        fewestCells * live.plan->grid().axes.back().step);
    viewport.stretch({time.high - width, time.high}, full.frequency);
    viewport.setFollowing(true);
}

void LivePictures::markChanges()
{
    std::vector<OverlayTime> times;
    for (const SettingsChange &change : m_document.live().changes) {
        QStringList names;
        bool isThreshold = !change.fields.empty();
        for (const std::string &field : change.fields) {
            names << settingLabel(QString::fromStdString(field));
            isThreshold = isThreshold
                          && (field == "decide.falseAlarmsPerHour" || field == "decide.pfaPerCell"
                              || field == "decide.thresholdNats" || field == "decide.by");
        }
        const QString unit = statisticUnit(m_document.live().plan->settings);
        times.push_back({change.seconds, isThreshold ? tr("threshold %1 %2").arg(numberText(change.threshold, 1), unit)
                                                     : tr("changed: %1").arg(names.join(QStringLiteral(", ")))});
    }
    for (WaterfallView *view : {&m_input, &m_output})
        view->setTimes(times);
}

bool LivePictures::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::Paint && std::exchange(m_isToBePainted, false))
        QTimer::singleShot(0, this, [this, heardAt = m_document.live().heardAt] { // after both are painted
            emit painted(std::chrono::duration<double>(std::chrono::steady_clock::now() - heardAt).count());
        });
    return QObject::eventFilter(watched, event);
}

} // namespace faintline
