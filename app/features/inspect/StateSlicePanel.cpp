#include "app/features/inspect/StateSlicePanel.h"

#include "app/document/OutputLayers.h"
#include "app/features/inspect/LawPanel.h"
#include "plan/chain.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/waterfall/ColourBar.h"
#include "widgets/waterfall/SliceMarks.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QScopedValueRollback>
#include <QSignalBlocker>
#include <QTabBar>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr Index longAxis = 200;       ///< cells above which only the cursor's neighbourhood is shown at first
    constexpr double surroundings = 60.0; ///< cells in each direction

    Span whole(const Axis &axis)
    {
        return {axis.value(-0.5), axis.value(double(axis.count) - 0.5)};
    }

    Span firstSpan(const Axis &axis, double value)
    {
        if (axis.count <= longAxis)
            return whole(axis);
        return Span{value - surroundings * axis.step, value + surroundings * axis.step}.within(whole(axis));
    }

} // namespace

StateSlicePanel::StateSlicePanel(Document &document, OutputLayers &layers, PingViewports &viewports, QWidget *parent)
    : Panel(parent), m_document(document), m_layers(layers), m_viewports(viewports), m_rows(new QComboBox),
      m_columns(new QComboBox), m_others(new QComboBox), m_model(new QComboBox), m_sentence(panelSentence()),
      m_view(new WaterfallView(tr("States (nat)"))), m_tabs(new QTabBar), m_pane(ColourBar::pane(m_view)),
      m_law(new LawPanel(document)), m_marks(new SliceMarks(*m_view)),
      m_cut(
          this, &StateSlicePanel::question,
          [this](const auto &analysis, const StateCut::Wanted &wanted, const RunContext &context) {
              if (!m_replay || m_replay->analysis() != analysis)
                  m_replay = std::make_shared<StateReplay>(
                      analysis, memoryShares::orSome(memoryShares::stateReplay, 8 * bytesOfStates(*analysis)));
              return cutThrough(*m_replay, wanted, context);
          },
          &StateSlicePanel::show)
{
    m_sentence->setContentsMargins(8, 4, 8, 4);
    QLayout *head = buildHead();
    buildView();
    m_tabs->addTab(tr("States"));
    m_tabs->addTab(tr("Law"));
    m_tabs->setDrawBase(false);
    m_tabs->setAccessibleName(tr("States or law"));
    m_body = new QBoxLayout(QBoxLayout::TopToBottom);
    m_body->setSpacing(0);
    m_body->addWidget(m_pane, 3);
    m_body->addWidget(m_law, 2);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(head);
    layout->addWidget(m_tabs);
    layout->addWidget(m_sentence);
    layout->addLayout(m_body, 1);
    connectChoices();
    connectDocument();
    fillAxes();
}

void StateSlicePanel::setSeen(bool isSeen)
{
    m_layers.setWatching(isSeen);
}

/// What is chosen of the states.
QLayout *StateSlicePanel::buildHead()
{
    m_others->addItems({tr("other axes at cursor"), tr("best over other axes")});
    m_others->setToolTip(tr("Axes not shown: fixed at the cursor's cell with its best rates, or maximum over all their "
                            "values"));
    m_model->addItems({tr("non-manoeuvring"), tr("manoeuvring")});
    m_model->setToolTip(tr("Model shown, of those that run in parallel"));
    m_rows->setAccessibleName(tr("Vertical axis"));
    m_columns->setAccessibleName(tr("Horizontal axis"));
    auto *times = new QLabel(QStringLiteral("×"));
    m_choices = {m_rows, m_columns, m_others, times};
    for (QComboBox *box : {m_rows, m_columns, m_others, m_model}) {
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(5);
    }
    auto *top = new QHBoxLayout;
    top->setSpacing(4);
    top->addWidget(m_rows, 1);
    top->addWidget(times);
    top->addWidget(m_columns, 1);
    auto *second = new QHBoxLayout;
    second->setSpacing(4);
    second->addWidget(m_others, 1);
    second->addWidget(m_model, 1);
    auto *head = new QVBoxLayout;
    head->setContentsMargins(8, 6, 8, 0);
    head->setSpacing(4);
    head->addLayout(top);
    head->addLayout(second);
    return head;
}

/// The slice and its colour bar.
void StateSlicePanel::buildView()
{
    m_view->setViewport(&m_viewport);
    m_view->setObjectName(QStringLiteral("slice"));
    m_view->setEmptySentence(tr("The states of the frame under the cursor appear here."));
    m_view->setMinimumSize(130, 120); // a docked panel must not widen the window
    m_pane->layout()->setContentsMargins(0, 0, 0, 6);
}

void StateSlicePanel::connectChoices()
{
    connect(m_rows, &QComboBox::activated, this, [this] { chooseAxes(*m_rows, *m_columns); });
    connect(m_columns, &QComboBox::activated, this, [this] { chooseAxes(*m_columns, *m_rows); });
    for (const QComboBox *box : {m_others, m_model})
        m_cut.askAt(*box, &QComboBox::currentIndexChanged);
    connect(&m_viewport, &Viewport::cursorChanged, this, &StateSlicePanel::followCursor);
    connect(&m_viewport, &Viewport::spanChanged, this, &StateSlicePanel::giveFrequencies);
    // The order in which the view gets its size and its picture must not matter.
    connect(m_view, &WaterfallView::histogramChanged, this, [this] {
        if (cut() && !m_isShowing && m_view->range() == m_givenRange)
            chooseRange();
    });
    connect(m_tabs, &QTabBar::currentChanged, this, &StateSlicePanel::layOut);
    connect(m_law, &LawPanel::lawRequested, this, &StateSlicePanel::lawRequested);
}

void StateSlicePanel::connectDocument()
{
    connect(&m_document, &Document::analysisChanged, this, &StateSlicePanel::fillAxes);
    connect(&m_document, &Document::shownEventsChanged, this, &StateSlicePanel::placeMarks);
    connect(&m_document, &Document::shownThresholdChanged, this,
            [this] { m_view->setThreshold(m_document.shownThreshold()); });
    connect(&m_document.viewport(), &Viewport::spanChanged, this, &StateSlicePanel::takeFrequencies);
    m_cut.watch(*this, m_sentence);
    m_cut.askAt(m_document, &Document::opened);
    m_cut.askAt(m_viewports, &PingViewports::placeChanged);
    m_cut.askAt(m_document.viewport(), &Viewport::cursorChanged);
}

bool StateSlicePanel::isOfLines() const
{
    const auto analysis = m_document.lineAnalysis();
    return analysis && analysis->model.space.axes().size() == 1;
}

bool StateSlicePanel::hasChoice() const
{
    const auto &analysis = m_document.analysis();
    return analysis && analysis->model.space.axes().size() > 1;
}

bool StateSlicePanel::isMaximised() const
{
    return m_others->currentIndex() == 1;
}

void StateSlicePanel::setMaximised(bool isMaximised)
{
    m_others->setCurrentIndex(isMaximised ? 1 : 0);
}

void StateSlicePanel::setAxes(int rows, int columns)
{
    m_rows->setCurrentIndex(rows);
    m_columns->setCurrentIndex(columns);
    m_cut.ask();
}

/// Keeps the two axes different: an axis that takes the other's gives its own in exchange.
void StateSlicePanel::chooseAxes(QComboBox &changed, QComboBox &other)
{
    const int before = int(&changed == m_rows ? m_shownAxes.first : m_shownAxes.second);
    if (changed.currentIndex() == other.currentIndex())
        other.setCurrentIndex(before);
    m_cut.ask();
}

void StateSlicePanel::fillAxes()
{
    const auto &analysis = m_document.analysis();
    for (QWidget *widget : m_choices)
        widget->setVisible(hasChoice());
    m_model->setVisible(hasChoice() && analysis->modelCount() > 1);
    layOut();
    m_shownAxes = {0, 0};
    const std::vector<Axis> axes = hasChoice() ? stateAxes(*analysis) : std::vector<Axis>();
    if (hasChoice() && m_rows->count() != std::ssize(axes)) {
        for (QComboBox *box : {m_rows, m_columns}) {
            const QSignalBlocker blocker(box);
            box->clear();
            for (const Axis &axis : axes)
                box->addItem(capitalised(labelText(axis.name, mostUnitLetters)));
        }
        m_rows->setCurrentIndex(0);
        m_columns->setCurrentIndex(2); // range × range rate, which shows a target's motion
    }
    m_cut.ask();
}

void StateSlicePanel::resizeEvent(QResizeEvent *event)
{
    layOut();
    QWidget::resizeEvent(event);
}

void StateSlicePanel::layOut()
{
    constexpr int wideEnough = 620;
    constexpr int tallEnough = 600;
    const bool hasLaw = hasChoice() || isOfLines();
    const bool isWide = width() >= wideEnough;
    const bool hasBoth = isWide || height() >= tallEnough;
    m_body->setDirection(isWide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    m_tabs->setVisible(hasLaw && !hasBoth);
    m_law->setVisible(hasLaw && (hasBoth || m_tabs->currentIndex() == 1));
    const bool hasSlice = !hasLaw || hasBoth || m_tabs->currentIndex() == 0;
    m_pane->setVisible(hasSlice);
    m_sentence->setVisible(hasSlice);
}

StateSlicePanel::Asking::Question StateSlicePanel::question() const
{
    const auto &analysis = m_document.analysis();
    if (!hasChoice() && !isOfLines())
        return QString();
    const auto at = cursorOf(m_document, m_viewports);
    if (!at)
        return {};
    const std::size_t model = !analysis->isBank() ? 0 : std::size_t(m_model->currentIndex());
    const int rows = m_rows->currentIndex();
    const int columns = m_columns->currentIndex();
    if (isOfLines())
        return std::tuple(analysis, StateCut::Wanted{*at, {1, 0, {}}, model, isMaximised()}); // slope × frequency
    if (rows == columns)
        return {};
    return std::tuple(analysis,
                      StateCut::Wanted{*at, {std::size_t(rows), std::size_t(columns), {}}, model, isMaximised()});
}

/// A click in the slice goes there with everybody, as far as a slice has places.
void StateSlicePanel::followCursor()
{
    if (m_isShowing || !m_viewport.cursor())
        return;
    if (isOfLines()) {
        const auto &before = m_document.viewport().cursor();
        if (before)
            m_document.viewport().setCursor({before->seconds, m_viewport.cursor()->hz});
        if (!m_cut.isRunning())
            show(); // back to the cell's best slope
        return;
    }
    PingViewports::Place place = m_viewports.place();
    const auto take = [&](std::size_t axis, double value) {
        if (axis < place.position.size())
            place.position[axis] = value;
    };
    take(m_shownAxes.first, m_viewport.cursor()->seconds);
    take(m_shownAxes.second, m_viewport.cursor()->hz);
    m_viewports.setPlace(place);
}

/// For a slice along other axes than before.
void StateSlicePanel::showSpans(const StateCut &cut, const Viewport::Point &cursor)
{
    constexpr double fewestCells = 3.0;
    const Axis &rows = cut.rows();
    const Axis &columns = cut.columns();
    m_viewport.setExtents(whole(rows), whole(columns), fewestCells * rows.step, fewestCells * columns.step);
    if (isOfLines())
        m_viewport.zoomTo(whole(rows), m_document.viewport().frequency());
    else
        m_viewport.zoomTo(firstSpan(rows, cursor.seconds), firstSpan(columns, cursor.hz));
}

void StateSlicePanel::show()
{
    const QScopedValueRollback showing(m_isShowing, true);
    if (!cut()) {
        m_view->setPicture(nullptr, {});
        return placeMarks();
    }
    const StateCut &cut = *this->cut();
    const std::pair axes{cut.slice.rows, cut.slice.columns};
    const Viewport::Point cursor{cut.values[axes.first], cut.values[axes.second]};
    if (axes != m_shownAxes)
        showSpans(cut, cursor);
    m_shownAxes = axes;
    m_viewport.setCursor(cursor);
    m_viewport.reveal({{cursor.seconds, cursor.seconds}, {cursor.hz, cursor.hz}});
    const bool isOurRange = m_view->isRangeAutomatic() || m_view->range() == m_givenRange;
    m_view->setPicture(cut.picture, cut.columns());
    m_view->updateLayout(); // its axes may be new
    if (isOurRange)
        chooseRange();

    placeMarks();
    m_sentence->setText(words(cut));
}

QString StateSlicePanel::words(const StateCut &cut) const
{
    const QString frame = tr("%1 %2").arg(capitalised(m_document.frameKind().frame)).arg(cut.frame + 1);
    if (!isOfLines())
        return tr("%1: %2; at most %3 nat").arg(frame, cut.otherWords(), numberText(cut.best, 1));
    const Axis &time = m_document.analysis()->time();
    return tr("%1 at %2: %3")
        .arg(frame, secondsText(time.value(double(cut.frame)), time.step), cut.bestWords(*m_marks));
}

/// A followed target's states stand far above the threshold; its hill is what there is to see. Of lines, that under the
/// cursor: a carrier elsewhere may have gathered a hundred times as much.
void StateSlicePanel::chooseRange()
{
    m_view->setAutomaticRange();
    m_view->setRange(m_view->range().low,
                     std::max(m_view->range().high, isOfLines() ? cut()->scoreAtCursor() : cut()->best));
    m_givenRange = m_view->range();
}

/// The best of the states in view, and those of the tracks' paths that lie in the slice.
void StateSlicePanel::placeMarks()
{
    if (!cut())
        return m_marks->clear();
    m_marks->set(cut()->bestIn(m_viewport.visible()), cut()->pathsOf(m_document.shownTracks(), *m_document.analysis()));
}

/// Follows the frequencies shown in the waterfalls …
void StateSlicePanel::takeFrequencies()
{
    if (!isOfLines() || m_shownAxes != std::pair<std::size_t, std::size_t>{1, 0} || m_isShowing)
        return;
    const QScopedValueRollback showing(m_isShowing, true);
    m_viewport.stretch(m_viewport.time(), m_document.viewport().frequency());
    placeMarks();
}

/// … and the other way round.
void StateSlicePanel::giveFrequencies()
{
    if (!isOfLines() || m_isShowing)
        return;
    const QScopedValueRollback showing(m_isShowing, true);
    m_document.viewport().stretch(m_document.viewport().time(), m_viewport.frequency());
    placeMarks();
}

} // namespace faintline
