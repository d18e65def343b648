#include "app/features/pictures/Bench.h"

#include "app/document/OutputLayers.h"
#include "app/document/statisticUnit.h"
#include "widgets/base/TimeStack.h"
#include "widgets/pings/PingMarks.h"

#include <QDataStream>
#include <QIODevice>
#include <QSplitter>
#include <QVBoxLayout>

namespace faintline {

Bench::Bench(Document &document, const FrameKind &kind, std::chrono::milliseconds stepInterval, QWidget *parent)
    : QWidget(parent), m_document(document), m_kind(kind), m_historyPanes(newSplitter(Qt::Horizontal)),
      m_rows(newSplitter(Qt::Vertical)), m_stack(new TimeStack(this)), m_player(stepInterval)
{
    setMinimumSize(360, 100); // pictures only: with the curves and bars the window could not shrink enough to hide them
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(m_rows);

    connect(&document, &Document::opened, this, [this] {
        forgetAnalysis();
        showSelected(0);
    });
    whenInUse(&document, &Document::analysisChanged, &Bench::showAnalysis);
    whenInUse(&document, &Document::provisionalChanged, &Bench::showStatistic);
    whenInUse(&document, &Document::shownThresholdChanged, &Bench::showThreshold);
    whenInUse(&document, &Document::shownEventsChanged, &Bench::showEvents);
    connect(&m_player, &FramePlayer::stepRequested, this, &Bench::play);
    connect(&m_player, &FramePlayer::playingChanged, this, &Bench::playingChanged);
}

bool Bench::isInUse() const
{
    return m_document.frameKind().isShownLike(m_kind);
}

// ---- parts ---------------------------------------------------------------------------------------------------------

void Bench::addPlane(WaterfallView &view)
{
    add({&view, {}});
}

void Bench::addHistory(WaterfallView &view, QWidget &pane, std::size_t axis)
{
    add({&view, axis});
    view.setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding); // Qwt's default never shrinks below the hint
    m_historyPanes->addWidget(&pane);
    m_stack->add(view, pane);
}

void Bench::setHistoryAxis(const WaterfallView &view, std::size_t axis)
{
    for (Picture &picture : m_pictures)
        if (picture.view == &view)
            picture.axis = axis;
}

void Bench::add(const Picture &picture)
{
    m_pictures.push_back(picture);
    connect(picture.view, &WaterfallView::eventActivated, this, &Bench::eventActivated);
    connect(picture.view, &WaterfallView::thresholdStepRequested, this, &Bench::thresholdStepRequested);
}

void Bench::addRows(const std::vector<std::pair<QWidget *, int>> &rows)
{
    QList<int> heights;
    for (const auto &[row, height] : rows) {
        m_rows->addWidget(row);
        heights.append(height);
    }
    m_rows->setStretchFactor(0, 1);
    m_rows->setSizes(heights);
}

QSplitter *Bench::newSplitter(Qt::Orientation orientation)
{
    auto *splitter = new QSplitter(orientation);
    splitter->setChildrenCollapsible(false);
    return splitter;
}

void Bench::arrangeBy(const TimeDirection &direction)
{
    connect(&direction, &TimeDirection::changed, this, [this, &direction] { arrange(!direction.isVertical()); });
    arrange(!direction.isVertical());
}

void Bench::arrange(bool isStacked)
{
    m_historyPanes->setOrientation(isStacked ? Qt::Vertical : Qt::Horizontal);
    m_stack->setOn(isStacked);
    showWhatFits();
}

void Bench::resizeEvent(QResizeEvent *event)
{
    showWhatFits();
    QWidget::resizeEvent(event);
}

QByteArray Bench::saveSplitters() const
{
    QByteArray state;
    QDataStream stream(&state, QIODevice::WriteOnly);
    for (const QSplitter *splitter : splitters())
        stream << splitter->saveState();
    return state;
}

void Bench::restoreSplitters(const QByteArray &state)
{
    QDataStream stream(state);
    for (QSplitter *splitter : splitters()) {
        QByteArray own;
        stream >> own;
        const Qt::Orientation orientation = splitter->orientation(); // follows the pictures'
        splitter->restoreState(own);
        splitter->setOrientation(orientation);
    }
}

// ---- what is shown -------------------------------------------------------------------------------------------------

void Bench::setEmptySentence(const QString &sentence)
{
    for (const auto &[view, axis] : m_pictures) {
        view->setEmptySentence(sentence);
        if (axis)
            view->setPicture(nullptr, {});
    }
}

void Bench::setAutomaticRange()
{
    for (const Picture &picture : m_pictures)
        picture.view->setAutomaticRange();
}

/// Heading above the statistic. The colour bar belongs to the statistic; a layer shown in its place has its own key.
void Bench::showHeading()
{
    const bool isStatistic = !layers().isCovering();
    setColourBarShown(isStatistic);
    if (!m_document.plan() || !isInUse())
        return;
    const bool isProvisional = provisional() != nullptr;
    const QString unit = statisticUnit(isProvisional ? m_document.settings() : m_document.plan()->settings);
    const QString statistic =
        isProvisional ? tr("Statistic D (%1), provisional").arg(unit) : tr("Statistic D (%1)").arg(unit);
    firstView()->setStatisticUnit(unit, isStatistic ? statistic : layers().heading());
    showStatisticUnit(unit);
}

void Bench::showEvents()
{
    if (!m_document.analysis())
        return; // live events arrive with their pictures
    const Analysis &analysis = *m_document.analysis();
    const std::vector<Event> events = m_document.shownEvents();
    const std::vector<Track> tracks = m_document.shownTracks();
    for (const auto &[view, axis] : m_pictures)
        if (axis) {
            view->setEvents(eventsAlong(events, *axis));
            view->setTracks(tracksAlong(tracks, analysis.grid(), *axis), analysis.time());
        }
    showMarks();
}

/// A source knows either lines or targets.
void Bench::showTruth()
{
    const Analysis &analysis = *m_document.analysis();
    for (const auto &[view, axis] : m_pictures) {
        if (!axis)
            continue;
        std::vector<TruthLine> lines = truthAlong(m_document.pingTruth(), analysis.grid(), analysis.time(), *axis);
        lines.insert(lines.end(), m_document.truth().lines.begin(), m_document.truth().lines.end());
        view->setTruth(lines);
    }
}

// ---- moving about --------------------------------------------------------------------------------------------------

void Bench::showSelected(int id)
{
    for (const auto &[view, axis] : m_pictures)
        if (axis)
            view->setSelectedEvent(id);
    markSelected(id);
}

void Bench::selectEvent(int id)
{
    showSelected(id);
    if (const Track *track = m_document.track(id); track && !track->points.empty())
        reveal(*track);
    for (const Event &event : m_document.shownEvents())
        if (event.id == id)
            goTo(event);
}

void Bench::setPlaying(bool isPlaying)
{
    m_player.setPlaying(isPlaying);
}

void Bench::play(int direction)
{
    if (const int frames = framesToPlay(direction))
        stepFrames(frames);
    else
        setPlaying(false);
}

} // namespace faintline
