#include "app/workspace/Workbench.h"

#include "app/control/BoxMeter.h"
#include "app/control/Closeup.h"
#include "app/control/OutputLayers.h"
#include "app/control/trackBox.h"
#include "app/document/statisticUnit.h"
#include "widgets/base/TimeStack.h"
#include "widgets/base/familyWords.h"
#include "widgets/base/quantities.h"
#include "widgets/base/settingWords.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/waterfall/ColourBar.h"

#include <QByteArray>
#include <QDataStream>
#include <QEvent>
#include <QHBoxLayout>
#include <QIODevice>
#include <QMetaEnum>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr int playerInterval = 33; // ms
    constexpr int playerSteps = 600;   // to play the visible part

    constexpr Index framesInSight = 600;     // initially in a live picture: about a pixel each
    constexpr Index longestColouring = 8192; // frames used to choose a live picture's colours

    QString orientationName(WaterfallView::Orientation orientation)
    {
        QString name =
            QString::fromLatin1(QMetaEnum::fromType<WaterfallView::Orientation>().valueToKey(int(orientation)));
        name[0] = name[0].toLower();
        return name;
    }

    std::optional<WaterfallView::Orientation> orientationNamed(QString name)
    {
        if (name.isEmpty())
            return {};
        name[0] = name[0].toUpper();
        bool isKnown = false;
        const int value =
            QMetaEnum::fromType<WaterfallView::Orientation>().keyToValue(name.toLatin1().constData(), &isKnown);
        return isKnown ? std::optional(WaterfallView::Orientation(value)) : std::nullopt;
    }

    void copyLayers(const WaterfallView &from, WaterfallView &to)
    {
        for (const auto layer : {WaterfallView::EventLayer, WaterfallView::TrackLayer, WaterfallView::TruthLayer,
                                 WaterfallView::ThresholdLayer, WaterfallView::GridLayer, WaterfallView::CursorLayer})
            to.setLayer(layer, from.layers().testFlag(layer));
    }

    /// Drift rate of the tracked line at a point, Hz/s; empty if there is no track.
    std::optional<double> slopeAt(const Analysis &analysis, const Viewport::Point &point)
    {
        const Axis &time = analysis.time();
        const Axis &frequency = analysis.grid().axes.back();
        const Index frame = time.nearest(point.seconds);
        for (const Track &track : analysis.tracks) {
            const Index i = frame - (track.points.empty() ? 0 : track.points.front().frame);
            if (i < 0 || i >= std::ssize(track.points))
                continue;
            const TrackPoint &at = track.points[std::size_t(i)];
            if (std::abs(at.cell % frequency.count - frequency.nearest(point.hz)) <= 1)
                return analysis.model.space.ratesOfPlane(at.plane).back() * frequency.step / time.step;
        }
        return {};
    }

    /// `isRest`: the strong lines are subtracted.
    QString inputHeading(bool isRest)
    {
        return isRest ? Workbench::tr("Input, strong lines subtracted (dB over noise)")
                      : Workbench::tr("Input (dB over noise)");
    }

} // namespace

Workbench::Workbench(Document &document, QWidget *parent)
    : Bench(document, lineFrames(), parent), m_input(new WaterfallView(inputHeading(false))),
      m_output(new WaterfallView(tr("Statistic D (nat)"))), m_layers(new OutputLayers(document, *m_output, this)),
      m_boxMeter(new BoxMeter(document, this)), m_inputPane(ColourBar::pane(m_input)),
      m_outputPane(ColourBar::pane(m_output)), m_statistic(new StripPlot(tr("D (nat)"))),
      m_regulation(new StripPlot(tr("ln K (nat)"))), m_pictures(new QSplitter(Qt::Horizontal)),
      m_rows(new QSplitter(Qt::Vertical)), m_stack(new TimeStack(this))
{
    m_pictures->addWidget(m_inputPane);
    m_pictures->addWidget(m_outputPane);
    m_rows->addWidget(m_pictures);
    m_rows->addWidget(m_statistic);
    m_rows->addWidget(m_regulation);
    m_rows->setStretchFactor(0, 1);
    m_rows->setSizes({640, 106, 106});
    for (QSplitter *splitter : {m_pictures, m_rows})
        splitter->setChildrenCollapsible(false);
    for (QwtPlot *plot : std::initializer_list<QwtPlot *>{m_input, m_output, m_statistic, m_regulation})
        plot->setSizePolicy(QSizePolicy::Expanding,
                            QSizePolicy::Expanding); // Qwt's default never shrinks below the hint
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(m_rows);
    setMinimumHeight(220); // pictures only: with the curves' height the window could not shrink enough to hide them

    m_regulation->setRightTitle(tr("resets"));
    m_regulation->setFixedScale(StripPlot::Side::Right, {0.0, 1.0});
    m_input->setObjectName(QStringLiteral("input"));
    m_output->setObjectName(QStringLiteral("output"));
    m_stack->add(*m_input, *m_inputPane);
    m_stack->add(*m_output, *m_outputPane);
    m_stack->add(*m_statistic, *m_statistic);
    m_stack->add(*m_regulation, *m_regulation);
    linkViews();

    connect(&document, &Document::opened, this, [this] {
        m_isFirstAnalysis = m_isFirstPicture = true;
        m_livePlan.reset();
        for (WaterfallView *view : {m_input, m_output}) {
            view->setStartUnixSeconds({});
            view->setTimes({});
        }
        m_statistic->setStartUnixSeconds({});
        emit playingChanged(false);
        showStrips();
        showOrigin();
    });
    connect(&document, &Document::liveChanged, this, &Workbench::showLive);
    connect(&document.viewport(), &Viewport::followingChanged, this, [this](bool isFollowing) {
        if (m_document.isLive())
            emit playingChanged(isFollowing);
    });
    m_output->canvas()->installEventFilter(this);
    connect(&document, &Document::picturesGrew, this, &Workbench::showPictures);
    m_closeup = new Closeup(document, *m_input, *m_output, this); // connected after the pictures
    whenInUse(m_closeup, &Closeup::settled, &Workbench::readCursor);
    m_player.setInterval(playerInterval);
    connect(&m_player, &QTimer::timeout, this, &Workbench::play);
}

void Workbench::linkViews()
{
    Viewport *viewport = &m_document.viewport();
    m_statistic->setViewport(viewport);
    m_regulation->setViewport(viewport);
    for (WaterfallView *view : {m_input, m_output}) {
        WaterfallView *other = view == m_input ? m_output : m_input;
        view->setViewport(viewport);
        connect(view, &WaterfallView::orientationChanged, other, &WaterfallView::setOrientation);
        connect(view, &WaterfallView::colourMapChanged, other, &WaterfallView::setColourMap);
        connect(view, &WaterfallView::measuringChanged, other, &WaterfallView::setMeasuring);
        connect(view, &WaterfallView::sidebandsChanged, other, &WaterfallView::setSidebandSpacing);
        connect(m_boxMeter, &BoxMeter::measured, view, &WaterfallView::setSelectionNote);
        connect(view, &WaterfallView::layersChanged, other, [view, other] { copyLayers(*view, *other); });
        connect(view, &WaterfallView::eventActivated, this, &Workbench::eventActivated);
        connect(view, &WaterfallView::thresholdStepRequested, this, &Workbench::thresholdStepRequested);
        connect(view, &WaterfallView::hovered, this, [this](double seconds, double hz) { read({seconds, hz}); });
        whenInUse(view, &WaterfallView::hoverEnded, &Workbench::readCursor);
    }
    connect(m_output, &WaterfallView::orientationChanged, this, &Workbench::arrange);
    connect(m_output, &WaterfallView::shownPictureChanged, this, [this] {
        if (!isInUse() || (m_document.isLive() && !isStripDue()))
            return;
        if (m_document.analysis() || m_document.isLive())
            m_statistic->setProfile(tr("D at the cursor"), m_output->shownPicture(), m_output->frequencyAxis());
    });
    whenInUse(viewport, &Viewport::cursorChanged, &Workbench::readCursor);
    whenInUse(m_layers, &OutputLayers::readingChanged, &Workbench::readCursor);
    connect(m_layers, &OutputLayers::layerChanged, this, &Workbench::showHeading);
}

QString Workbench::hint() const
{
    return tr("Drag the threshold line to update contour and events. N goes to the next event, ? shows all keys.");
}

void Workbench::setEmptySentence(const QString &sentence)
{
    for (WaterfallView *view : {m_input, m_output}) {
        view->setEmptySentence(sentence);
        view->setPicture(nullptr, {});
    }
    m_statistic->setProfile({}, nullptr, {});
    m_statistic->setEmptySentence(sentence);
    m_regulation->removeSeries(tr("ln K"));
    m_regulation->removeSeries(tr("reset fraction"));
    m_regulation->setEmptySentence(sentence);
}

void Workbench::setAutomaticRange()
{
    m_input->setAutomaticRange();
    m_output->setAutomaticRange();
}

void Workbench::showAnalysis()
{
    const Analysis &analysis = *m_document.analysis();
    const Axis &frequency = analysis.grid().axes.back();
    const bool isFirst = std::exchange(m_isFirstAnalysis, false);
    m_statistic->setEmptySentence(tr("Click a picture to plot D at that frequency over time."));

    followExtents(analysis.time(), frequency);
    m_output->setThreshold(analysis.threshold); // before the picture: the automatic range depends on it
    m_input->setHeading(inputHeading(analysis.unsubtracted != nullptr));
    m_input->setPicture(analysis.input, frequency);
    showStatistic();
    for (WaterfallView *view : {m_input, m_output}) {
        view->setTruth(m_document.truth().lines);
        view->setAreas(areaEvents(analysis));
    }

    std::vector<float> resetFraction(analysis.continuedFraction.size());
    std::transform(analysis.continuedFraction.begin(), analysis.continuedFraction.end(), resetFraction.begin(),
                   [](float continued) { return 1.0f - continued; });
    m_regulation->setSeries(tr("ln K"), analysis.time(), analysis.lnK);
    m_regulation->setSeries(tr("reset fraction"), analysis.time(), std::move(resetFraction), StripPlot::Side::Right);
    if (isFirst)
        placeCursor();
    readCursor();
}

void Workbench::showPictures(const PicturesSoFar &pictures)
{
    followExtents(pictures.time, pictures.frequency);
    // The quick look covers the whole recording; the processed part has full detail.
    const Axis &time = pictures.time;
    const double reached = pictures.input ? time.value(double(pictures.input->frameCount()) - 0.5)
                                          : -std::numeric_limits<double>::infinity();
    const bool isReached = !pictures.quickLook || m_document.viewport().visible().time.high <= reached;
    m_input->setPicture(isReached ? pictures.input : pictures.quickLook, pictures.frequency);
    m_output->setPicture(pictures.statistic, pictures.frequency);
    if (!pictures.statistic)
        m_output->setEmptySentence(tr("The statistic appears here after the noise has been estimated."));
}

/// Shows the newest live frames. Colours are chosen again whenever the frames to choose from have doubled.
void Workbench::showLive()
{
    const LiveView &live = m_document.live();
    const Axis &frequency = live.plan->grid().axes.back();
    const bool isFirst = !m_livePlan || m_livePlan->frames != live.plan->frames;
    const bool isChanged = m_livePlan != live.plan;
    m_livePlan = live.plan;
    if (isFirst || (live.time.count >= 2 * m_colouredFrames && live.time.count <= longestColouring)) {
        m_colouredFrames = live.time.count;
        m_input->setHeading(inputHeading(false));
        m_input->setPicture(live.input, frequency);
        m_output->setPicture(live.statistic, frequency);
        m_statistic->setEmptySentence(tr("Click a picture to plot D at that frequency over time."));
    }
    const auto lookedBack = m_closeup->lookedBackAt(*m_input);
    m_input->setGrownPicture(live.input, lookedBack ? lookedBack : live.newInput);
    const auto lookedBackOut = m_closeup->lookedBackAt(*m_output);
    m_output->setGrownPicture(live.statistic, lookedBackOut ? lookedBackOut : live.newStatistic);
    growExtents(live);
    showLiveTracks();
    if (isChanged) {
        for (WaterfallView *view : {m_input, m_output})
            view->setStartUnixSeconds(live.plan->recording->info().startUnixSeconds);
        m_statistic->setStartUnixSeconds(live.plan->recording->info().startUnixSeconds);
        markChanges();
        showHeading();
        showStrips();
        showOrigin();
    }
    m_isToBePainted = true;
}

/// Updated a few times a second while there is a cursor.
bool Workbench::isStripDue()
{
    constexpr qint64 stripMs = 200;
    if (!m_document.viewport().cursor() || (m_stripAge.isValid() && m_stripAge.elapsed() < stripMs))
        return false;
    m_stripAge.start();
    return true;
}

/// Only the visible ones, of possibly a day's.
void Workbench::showLiveTracks()
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
    for (WaterfallView *view : {m_input, m_output})
        view->setLiveTracks(events, tracks, time);
}

/// Initially leaves room for some frames, which then fill it.
void Workbench::growExtents(const LiveView &live)
{
    const Viewport::Box full = WaterfallView::extents(live.time, live.plan->grid().axes.back());
    const Index frames = std::min(framesInSight, LiveHistory::singleFrames(live.input->cells()));
    const double width = double(frames) * live.time.step;
    const Span time{full.time.low, std::max(full.time.high, full.time.low + width)};
    Viewport &viewport = m_document.viewport();
    if (!m_isFirstPicture && full.frequency == viewport.extents().frequency)
        return viewport.grow(time);
    m_isFirstPicture = false;
    constexpr double fewestCells = 8.0;
    viewport.setExtents(time, full.frequency, fewestCells * live.time.step,
                        fewestCells * live.plan->grid().axes.back().step);
    viewport.stretch({time.high - width, time.high}, full.frequency);
    viewport.setFollowing(true);
}

void Workbench::markChanges()
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
    for (WaterfallView *view : {m_input, m_output})
        view->setTimes(times);
}

bool Workbench::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::Paint && std::exchange(m_isToBePainted, false))
        QTimer::singleShot(0, this, [this, heardAt = m_document.live().heardAt] { // after both are painted
            emit livePainted(std::chrono::duration<double>(std::chrono::steady_clock::now() - heardAt).count());
        });
    return Bench::eventFilter(watched, event);
}

/// Title of the output; its colour bar is the statistic's, a layer shown instead has its own key.
void Workbench::showHeading()
{
    const bool isStatistic = m_layers->layer() == OutputLayer::Statistic || m_layers->isOverlay();
    m_outputPane->findChild<ColourBar *>()->setVisible(isStatistic);
    if (!m_document.plan() || !isInUse())
        return;
    const bool isProvisional = m_document.provisional() != nullptr;
    const QString unit = statisticUnit(isProvisional ? m_document.settings() : m_document.plan()->settings);
    const QString statistic =
        isProvisional ? tr("Statistic D (%1), provisional").arg(unit) : tr("Statistic D (%1)").arg(unit);
    m_output->setStatisticUnit(unit, isStatistic ? statistic : m_layers->heading());
    m_statistic->setLeftTitle(tr("D (%1)").arg(unit));
}

/// The analysis's, or the preview of the visible part with changed settings.
void Workbench::showStatistic()
{
    if (!m_document.analysis())
        return;
    showHeading();
    const auto &picture = m_document.provisional() ? m_document.provisional() : m_document.analysis()->statistic;
    const Axis &frequency = m_document.analysis()->grid().axes.back();
    m_output->setPicture(picture, frequency);
    m_statistic->setProfile(tr("D at the cursor"), m_output->shownPicture(), frequency);
}

void Workbench::showThreshold()
{
    m_output->setThreshold(m_document.shownThreshold());
    m_statistic->setLevel(m_document.shownThreshold(), tr("threshold"));
}

void Workbench::showEvents()
{
    if (!m_document.analysis())
        return; // live events arrive with their pictures
    const std::vector<Event> events = m_document.shownEvents();
    const std::vector<Track> tracks = m_document.shownTracks();
    for (WaterfallView *view : {m_input, m_output}) {
        view->setEvents(events);
        view->setTracks(tracks, m_document.analysis()->time());
    }
}

void Workbench::followExtents(const Axis &time, const Axis &frequency)
{
    const Viewport::Box full = WaterfallView::extents(time, frequency);
    Viewport &viewport = m_document.viewport();
    const bool isFirst = std::exchange(m_isFirstPicture, false);
    if (!isFirst && full == viewport.extents())
        return;
    const bool showedAll = isFirst || viewport.showsAll();
    const Viewport::Box visible = viewport.visible();
    const std::optional<Viewport::Point> cursor = viewport.cursor();
    constexpr double fewestCells = 8.0;
    viewport.setExtents(full.time, full.frequency, fewestCells * time.step, fewestCells * frequency.step);
    if (!showedAll)
        viewport.zoomTo(visible.time, visible.frequency);
    if (cursor && !isFirst)
        viewport.setCursor(*cursor);
}

void Workbench::placeCursor()
{
    const std::vector<Event> events = m_document.shownEvents();
    const auto strongest = std::max_element(events.begin(), events.end(),
                                            [](const Event &a, const Event &b) { return a.statistic < b.statistic; });
    Viewport &viewport = m_document.viewport();
    if (strongest != events.end())
        viewport.setCursor({strongest->detectSeconds, strongest->position.back()});
    else
        viewport.setCursor({viewport.full().time.middle(), viewport.full().frequency.middle()});
}

Bench::Place Workbench::place() const
{
    const auto &cursor = m_document.viewport().cursor();
    return cursor ? Place{cursor->seconds, cursor->hz, {}, {}} : Place();
}

void Workbench::setPlace(const Place &place)
{
    Viewport &viewport = m_document.viewport();
    Viewport::Point point = viewport.cursor().value_or(Viewport::Point());
    point.seconds = place.seconds.value_or(point.seconds);
    point.hz = place.hz.value_or(point.hz);
    viewport.setCursor(point);
    viewport.reveal({{point.seconds, point.seconds}, {point.hz, point.hz}});
}

void Workbench::read(const Viewport::Point &point)
{
    ReadOut::Reading reading{point.seconds,
                             point.hz,
                             m_input->valueAt(point.seconds, point.hz),
                             m_output->valueAt(point.seconds, point.hz),
                             m_document.analysis() ? slopeAt(*m_document.analysis(), point) : std::nullopt,
                             {}};
    if (const auto best = m_layers->readingAt({point.seconds, {point.hz}})) {
        reading.slopeHzPerSecond = best->ratePerSecond;
        reading.ageSeconds = best->ageSeconds;
        reading.statisticNats = best->statistic;
    }
    emit readingChanged(reading);
}

void Workbench::readCursor()
{
    const auto &cursor = m_document.viewport().cursor();
    const auto &analysis = m_document.analysis();
    m_input->setCursorNote(cursor && analysis ? membersText(*analysis, cursor->hz) : QString());
    if (cursor)
        read(*cursor);
    else
        emit readingChanged({});
}

void Workbench::selectEvent(int id)
{
    for (WaterfallView *view : {m_input, m_output})
        view->setSelectedEvent(id);
    const Track *track = m_document.track(id);
    if (!track || track->points.empty())
        return;
    m_document.viewport().reveal(trackBox(*track, *m_document.analysis()));
    for (const Event &event : m_document.shownEvents())
        if (event.id == id)
            m_document.viewport().setCursor({event.detectSeconds, event.position.back()});
}

void Workbench::stepFrames(int frames)
{
    Viewport &viewport = m_document.viewport();
    if (!m_document.analysis() || !viewport.cursor())
        return;
    const double seconds = viewport.cursor()->seconds + frames * m_document.analysis()->time().step;
    const double hz = viewport.cursor()->hz;
    viewport.setCursor({seconds, hz});
    viewport.reveal({{seconds, seconds}, {hz, hz}});
}

void Workbench::setPlaying(bool isPlaying)
{
    if (m_document.isLive())
        return m_document.viewport().setFollowing(isPlaying);
    if (isPlaying == m_player.isActive())
        return;
    isPlaying ? m_player.start() : m_player.stop();
    emit playingChanged(isPlaying);
}

void Workbench::play()
{
    const Viewport &viewport = m_document.viewport();
    if (!m_document.analysis() || !viewport.cursor()
        || viewport.cursor()->seconds >= m_document.analysis()->time().last())
        return setPlaying(false);
    stepFrames(std::max(1, int(viewport.time().width() / playerSteps / m_document.analysis()->time().step)));
}

void Workbench::resizeEvent(QResizeEvent *event)
{
    showStrips();
    QWidget::resizeEvent(event);
}

/// Places the pictures for the direction of time.
void Workbench::arrange()
{
    const bool isStacked = !m_output->isTimeVertical();
    m_pictures->setOrientation(isStacked ? Qt::Vertical : Qt::Horizontal);
    m_stack->setOn(isStacked);
    showStrips();
}

void Workbench::showStrips()
{
    const bool isStacked = m_stack->isOn();
    const int enoughForOne = isStacked ? 520 : 460; // the pictures keep 350, or 200 each above each other
    const int enoughForBoth = isStacked ? 610 : 570;
    m_statistic->setVisible(height() >= enoughForOne);
    m_regulation->setVisible(height() >= enoughForBoth && !m_document.isLive());
}

void Workbench::setRadioAxis(bool isOn)
{
    m_isRadioAxis = isOn;
    showOrigin();
}

void Workbench::showOrigin()
{
    const auto recording = m_livePlan ? m_livePlan->recording : m_document.recording();
    m_document.viewport().setOriginHz(m_isRadioAxis && recording ? recording->info().centreHz : 0.0);
}

ViewState Workbench::viewState() const
{
    const Viewport &viewport = m_document.viewport();
    ViewState view;
    if (!viewport.isEmpty() && !viewport.showsAll())
        view.visible = viewport.visible();
    view.cursor = viewport.cursor();
    view.orientation = orientationName(m_output->orientation());
    view.colourMap = m_output->colourMap().name();
    view.isLogarithmic = viewport.isLogarithmic();
    view.isRadioAxis = m_isRadioAxis;
    return view;
}

void Workbench::restore(const ViewState &view)
{
    Viewport &viewport = m_document.viewport();
    viewport.setLogarithmic(view.isLogarithmic);
    setRadioAxis(view.isRadioAxis);
    if (view.visible)
        viewport.zoomTo(view.visible->time, view.visible->frequency);
    if (view.cursor)
        viewport.setCursor(*view.cursor);
    if (const auto orientation = orientationNamed(view.orientation))
        m_output->setOrientation(*orientation);
    if (!view.colourMap.isEmpty())
        m_output->setColourMap(view.colourMap);
}

} // namespace faintline
