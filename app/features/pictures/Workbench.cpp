#include "app/features/pictures/Workbench.h"

#include "app/document/OutputLayers.h"
#include "app/document/trackBox.h"
#include "app/features/pictures/Closeup.h"
#include "app/features/pictures/LivePictures.h"
#include "app/features/pictures/PlainInput.h"
#include "app/features/pictures/RegulationPlot.h"
#include "app/features/pictures/measureBox.h"
#include "app/features/pictures/strongestPlace.h"
#include "widgets/base/TimeStack.h"
#include "widgets/base/familyWords.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/waterfall/ColourBar.h"

#include <QMetaEnum>
#include <QSplitter>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr std::chrono::milliseconds stepInterval{33};
    constexpr int playerSteps = 600; // to play the visible part

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

} // namespace

/// `isRest`: the strong lines are subtracted.
QString Workbench::inputHeading(bool isRest)
{
    return isRest ? tr("Input, strong lines subtracted (dB over noise)") : tr("Input (dB over noise)");
}

Workbench::Workbench(Document &document, QWidget *parent)
    : Bench(document, lineFrames(), stepInterval, parent),
      m_input(new WaterfallView(inputHeading(false), &document.display(), &document.direction())),
      m_output(new WaterfallView(tr("Statistic D (nat)"), &document.display(), &document.direction())),
      m_layers(new OutputLayers(document, *m_output, this)), m_inputPane(ColourBar::pane(m_input)),
      m_outputPane(ColourBar::pane(m_output)), m_statistic(new StripPlot(tr("D (nat)"))),
      m_regulation(new RegulationPlot), m_live(new LivePictures(document, *m_input, *m_output, *m_statistic, this))
{
    m_input->setObjectName(QStringLiteral("input"));
    m_output->setObjectName(QStringLiteral("output"));
    addHistory(*m_input, *m_inputPane, 0);
    addHistory(*m_output, *m_outputPane, 0);
    m_statistic->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    timeStack().add(*m_statistic, *m_statistic);
    timeStack().add(*m_regulation, *m_regulation);
    addRows({{historyPanes(), 640}, {m_statistic, 106}, {m_regulation, 106}});
    linkViews();
    arrangeBy(document.direction());

    connect(&document, &Document::opened, this, [this] {
        m_isFirstPicture = true;
        m_live->clear();
        m_input->setPlain(false);
        m_input->setHeading(inputHeading(false));
        emit playingChanged(false);
        showWhatFits();
        showOrigin();
    });
    connect(&document, &Document::liveChanged, this, [this] { m_live->show(*m_closeup); });
    connect(m_live, &LivePictures::planChanged, this, [this] {
        showHeading();
        showWhatFits();
        showOrigin();
    });
    connect(&document.viewport(), &Viewport::followingChanged, this, [this](bool isFollowing) {
        if (!m_document.live().isEmpty())
            emit playingChanged(isFollowing);
    });
    connect(&document, &Document::picturesGrew, this, &Workbench::showPictures);
    m_closeup = new Closeup(document, *m_input, *m_output, this); // connected after the pictures
    m_plainInput = new PlainInput(document, *m_input, this);
    whenInUse(m_plainInput, &PlainInput::changed, &Workbench::showInput);
    whenInUse(m_closeup, &Closeup::shown, &Workbench::readCursor);
}

void Workbench::linkViews()
{
    Viewport *viewport = &m_document.viewport();
    m_statistic->setViewport(viewport);
    m_regulation->setViewport(viewport);
    for (WaterfallView *view : {m_input, m_output}) {
        view->setViewport(viewport);
        connect(view, &WaterfallView::hovered, this, [this](double seconds, double hz) { read({seconds, hz}); });
        whenInUse(view, &WaterfallView::hoverEnded, &Workbench::readCursor);
    }
    measureBox(m_document, {m_input, m_output});
    connect(m_output, &WaterfallView::shownPictureChanged, this, [this] {
        if (isInUse() && m_document.plan() && (m_document.analysis() || m_live->isStripDue()))
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
    Bench::setEmptySentence(sentence);
    m_statistic->setProfile({}, nullptr, {});
    m_statistic->setEmptySentence(sentence);
    m_regulation->clear(sentence);
}

StripPlot *Workbench::regulationPlot() const
{
    return m_regulation;
}

void Workbench::showAnalysis()
{
    const Analysis &analysis = *m_document.analysis();
    const Axis &frequency = analysis.grid().axes.back();
    const bool isFirst = takeFirstAnalysis();
    m_statistic->setEmptySentence(tr("Click a picture to plot D at that frequency over time."));

    followExtents(analysis.time(), frequency);
    m_output->setThreshold(analysis.threshold); // before the picture: the automatic range depends on it
    showInput();
    showStatistic();
    showTruth();
    for (WaterfallView *view : {m_input, m_output})
        view->setAreas(areaEvents(analysis));
    m_regulation->setAnalysis(analysis);
    if (isFirst)
        placeCursor();
    readCursor();
}

void Workbench::showInput()
{
    const auto analysis = m_document.lineAnalysis();
    if (!analysis)
        return;
    const auto plain = m_plainInput->picture();
    m_input->setPlain(plain != nullptr);
    m_input->setHeading(plain ? m_plainInput->heading() : inputHeading(analysis->unsubtracted != nullptr));
    m_input->setPicture(plain ? plain : analysis->input, analysis->grid().axes.back());
}

void Workbench::showPictures(const PicturesSoFar &pictures)
{
    followExtents(pictures.time, pictures.frequency);
    // The quick look covers the whole recording; the processed part has full detail.
    const Axis &time = pictures.time;
    const double reached = pictures.input ? time.value(double(pictures.input->frameCount()) - 0.5)
                                          : -std::numeric_limits<double>::infinity();
    if (m_input->isPlain())
        m_input->setHeading(inputHeading(false));
    m_input->setPlain(false);
    const bool isReached = !pictures.quickLook || m_document.viewport().visible().time.high <= reached;
    m_input->setPicture(isReached ? pictures.input : pictures.quickLook, pictures.frequency);
    m_output->setHeading(tr("Statistic D so far"));
    m_output->setPicture(pictures.statistic, pictures.frequency);
    if (!pictures.statistic)
        m_output->setEmptySentence(tr("The statistic appears here after the noise has been estimated."));
}

void Workbench::setColourBarShown(bool isShown)
{
    m_outputPane->findChild<ColourBar *>()->setVisible(isShown);
}

void Workbench::showStatisticUnit(const QString &unit)
{
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
    Viewport &viewport = m_document.viewport();
    if (const auto strongest = strongestEvent(m_document))
        viewport.setCursor({strongest->detectSeconds, strongest->detectedPosition.back()});
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
                             m_input->isPlain() ? std::nullopt : m_input->valueAt(point.seconds, point.hz),
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

void Workbench::reveal(const Track &track)
{
    m_document.viewport().reveal(trackBox(track, *m_document.analysis()));
}

void Workbench::goTo(const Event &event)
{
    if (m_document.track(event.id)) // not of a run in progress
        m_document.viewport().setCursor({event.detectSeconds, event.detectedPosition.back()});
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
    Bench::setPlaying(isPlaying);
}

int Workbench::framesToPlay(int direction) const
{
    const Viewport &viewport = m_document.viewport();
    const auto &analysis = m_document.analysis();
    if (!analysis || !viewport.cursor() || viewport.cursor()->seconds >= analysis->time().last())
        return 0;
    return direction * std::max(1, int(viewport.time().width() / playerSteps / analysis->time().step));
}

void Workbench::showWhatFits()
{
    const bool isStacked = timeStack().isOn();
    const int enoughForOne = isStacked ? 520 : 460; // the pictures keep 350, or 200 each above each other
    const int enoughForBoth = isStacked ? 610 : 570;
    const bool hasRegulation = m_isRegulationWanted && !m_document.isLive();
    const bool isRegulationFirst = m_isRegulationFirst && hasRegulation;
    m_statistic->setVisible(height() >= (isRegulationFirst ? enoughForBoth : enoughForOne));
    m_regulation->setVisible(hasRegulation && height() >= (isRegulationFirst ? enoughForOne : enoughForBoth));
}

void Workbench::setRegulationFirst(bool isFirst)
{
    m_isRegulationFirst = isFirst;
    showWhatFits();
}

void Workbench::setRegulationWanted(bool isWanted)
{
    m_isRegulationWanted = isWanted;
    showWhatFits();
}

void Workbench::setRadioAxis(bool isOn)
{
    m_isRadioAxis = isOn;
    showOrigin();
}

void Workbench::showOrigin()
{
    const auto recording = m_live->plan() ? m_live->plan()->recording : m_document.recording();
    m_document.viewport().setOriginHz(m_isRadioAxis && recording ? recording->info().centreHz : 0.0);
}

ViewState Workbench::viewState() const
{
    const Viewport &viewport = m_document.viewport();
    ViewState view;
    if (!viewport.isEmpty() && !viewport.showsAll())
        view.visible = viewport.visible();
    view.cursor = viewport.cursor();
    view.orientation = orientationName(m_document.direction().orientation());
    view.colourMap = m_document.display().colourMap().name();
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
        m_document.direction().set(*orientation);
    if (!view.colourMap.isEmpty())
        m_document.display().setColourMap(view.colourMap);
}

} // namespace faintline
