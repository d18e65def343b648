#include "app/panels/StateSlicePanel.h"

#include "analysis/chain.h"
#include "app/base/VisibilityWatcher.h"
#include "app/panels/LawPanel.h"
#include "spectrum/pictureCuts.h"
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

    constexpr Index longAxis = 200;       ///< cells from which on only the cursor's surroundings are shown at first
    constexpr double surroundings = 60.0; ///< cells either way

    Span whole(const Axis &axis)
    {
        return {axis.value(-0.5), axis.value(double(axis.count) - 0.5)};
    }

    /// Of lines, drifts in a unit that suits them.
    std::vector<Axis> readableAxes(const Analysis &analysis, std::size_t model)
    {
        std::vector<Axis> axes = stateAxes(analysis, model);
        if (axes.size() != 2)
            return axes;
        Axis &rate = axes[1];
        rate.name = "slope";
        if (rate.unit != "Hz/s")
            return axes;
        const FrequencyUnit unit = rateUnit(std::max(std::abs(rate.first), std::abs(rate.last())));
        rate.unit = unit.name.toStdString();
        rate.first /= unit.hz;
        rate.step /= unit.hz;
        return axes;
    }

    Span firstSpan(const Axis &axis, double value)
    {
        if (axis.count <= longAxis)
            return whole(axis);
        return Span{value - surroundings * axis.step, value + surroundings * axis.step}.within(whole(axis));
    }

} // namespace

StateSlicePanel::StateSlicePanel(Document &document, PingViewports &viewports, QWidget *parent)
    : QWidget(parent), m_document(document), m_viewports(viewports), m_rows(new QComboBox), m_columns(new QComboBox),
      m_others(new QComboBox), m_model(new QComboBox), m_sentence(plainLabel()),
      m_view(new WaterfallView(tr("States (nat)"))), m_tabs(new QTabBar), m_pane(new QWidget),
      m_law(new LawPanel(document)), m_sight(new VisibilityWatcher(*this)),
      m_marks(std::make_unique<SliceMarks>(*m_view))
{
    m_others->addItems({tr("other axes at cursor"), tr("best over other axes")});
    m_others->setToolTip(tr("Axes not shown: fixed at the cursor's cell with its best rates, or maximum over all their "
                            "values"));
    m_model->addItems({tr("non-manoeuvring"), tr("manoeuvring")});
    m_model->setToolTip(tr("Model shown, of those that run in parallel"));
    m_rows->setAccessibleName(tr("Vertical axis"));
    m_columns->setAccessibleName(tr("Horizontal axis"));
    m_sentence->setWordWrap(true);
    m_sentence->setTextFormat(Qt::PlainText);
    m_view->setViewport(&m_viewport);
    m_view->setObjectName(QStringLiteral("slice"));
    m_view->setEmptySentence(tr("The states of the frame under the cursor appear here."));
    m_view->setMinimumSize(130, 120); // a panel in a dock must not widen the window
    auto *times = new QLabel(QStringLiteral("×"));
    m_choices = {m_rows, m_columns, m_others, times};
    for (QComboBox *box : {m_rows, m_columns, m_others, m_model}) {
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(5);
    }
    auto *bar = new ColourBar;
    bar->attach(m_view);

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
    m_sentence->setContentsMargins(8, 4, 8, 4);
    m_tabs->addTab(tr("States"));
    m_tabs->addTab(tr("Law"));
    m_tabs->setDrawBase(false);
    m_tabs->setAccessibleName(tr("States or law"));
    auto *pane = new QHBoxLayout(m_pane);
    pane->setContentsMargins(0, 0, 0, 6);
    pane->setSpacing(0);
    pane->addWidget(m_view, 1);
    pane->addWidget(bar);
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

    connect(m_rows, &QComboBox::activated, this, [this] { chooseAxes(*m_rows, *m_columns); });
    connect(m_columns, &QComboBox::activated, this, [this] { chooseAxes(*m_columns, *m_rows); });
    for (QComboBox *box : {m_others, m_model})
        connect(box, &QComboBox::currentIndexChanged, this, &StateSlicePanel::update);
    connect(m_sight, &VisibilityWatcher::came, this, &StateSlicePanel::update);
    connect(&document, &Document::analysisChanged, this, &StateSlicePanel::fillAxes);
    connect(&m_viewport, &Viewport::cursorChanged, this, &StateSlicePanel::followCursor);
    connect(&viewports, &PingViewports::placeChanged, this, &StateSlicePanel::update);
    connect(&document.viewport(), &Viewport::cursorChanged, this, [this] {
        if (isOfLines())
            update();
    });
    connect(&document.viewport(), &Viewport::spanChanged, this, &StateSlicePanel::takeFrequencies);
    connect(&m_viewport, &Viewport::spanChanged, this, &StateSlicePanel::giveFrequencies);
    // Whether the view gets its size before its picture or after must make no difference.
    connect(m_view, &WaterfallView::histogramChanged, this, [this] {
        if (m_cut && !m_isShowing && m_view->range() == m_givenRange)
            chooseRange();
    });
    connect(&document, &Document::shownEventsChanged, this, &StateSlicePanel::placeMarks);
    connect(m_tabs, &QTabBar::currentChanged, this, &StateSlicePanel::layOut);
    connect(m_law, &LawPanel::lawRequested, this, &StateSlicePanel::lawRequested);
    connect(&m_runner, &JobRunner::progressed, this, [this](double fraction, const QString &what) {
        m_sentence->setText(tr("%1, %2 %").arg(what).arg(int(100.0 * fraction)));
    });
    connect(&m_runner, &JobRunner::failed, this, [this](const Error &error) {
        m_sentence->setText(messageText(error.what()));
        emit settled();
    });
    connect(&m_runner, &JobRunner::finished, this, &StateSlicePanel::settled);
    fillAxes();
}

StateSlicePanel::~StateSlicePanel() = default;

bool StateSlicePanel::isOfLines() const
{
    const auto &analysis = m_document.analysis();
    return analysis && !m_document.hasPings() && analysis->grid().axes.size() == 1
           && analysis->model.space.axes().size() == 1;
}

std::optional<StateSlicePanel::Place> StateSlicePanel::place() const
{
    if (isOfLines()) {
        const auto &cursor = m_document.viewport().cursor();
        return cursor ? std::optional(Place{cursor->seconds, {cursor->hz}}) : std::nullopt;
    }
    const PingViewports::Place at = m_viewports.place();
    return Place{at.seconds, {at.range, at.bearing}};
}

QString StateSlicePanel::sentence() const
{
    return m_sentence->text();
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
    update();
}

/// Two different ones: who takes the other's gives his own in exchange.
void StateSlicePanel::chooseAxes(QComboBox &changed, QComboBox &other)
{
    const int before = int(&changed == m_rows ? m_shownAxes.first : m_shownAxes.second);
    if (changed.currentIndex() == other.currentIndex())
        other.setCurrentIndex(before);
    update();
}

void StateSlicePanel::fillAxes()
{
    const auto &analysis = m_document.analysis();
    const bool hasPings = m_document.hasPings() && analysis && !analysis->model.space.axes().empty();
    for (QWidget *widget : m_choices)
        widget->setVisible(hasPings);
    m_model->setVisible(hasPings && analysis->modelCount() > 1);
    layOut();
    m_shownAxes = {0, 0};
    m_cut.reset();
    if (isOfLines())
        return update();
    if (!hasPings) {
        m_runner.cancel();
        m_view->setPicture(nullptr, {});
        placeMarks();
        return m_sentence->clear();
    }
    const std::vector<Axis> axes = stateAxes(*analysis);
    if (m_rows->count() != int(axes.size())) {
        for (QComboBox *box : {m_rows, m_columns}) {
            const QSignalBlocker blocker(box);
            box->clear();
            for (const Axis &axis : axes)
                box->addItem(capitalised(labelText(axis.name, mostUnitLetters)));
        }
        m_rows->setCurrentIndex(0);
        m_columns->setCurrentIndex(2); // range × range rate: where a target's motion shows
    }
    update();
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
    const bool hasLaw = m_document.hasPings() || isOfLines();
    const bool isWide = width() >= wideEnough;
    const bool hasBoth = isWide || height() >= tallEnough;
    m_body->setDirection(isWide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    m_tabs->setVisible(hasLaw && !hasBoth);
    m_law->setVisible(hasLaw && (hasBoth || m_tabs->currentIndex() == 1));
    const bool hasSlice = !hasLaw || hasBoth || m_tabs->currentIndex() == 0;
    m_pane->setVisible(hasSlice);
    m_sentence->setVisible(hasSlice);
}

void StateSlicePanel::update()
{
    const auto &analysis = m_document.analysis();
    const bool isLines = isOfLines();
    const std::optional<Place> at = analysis ? place() : std::nullopt;
    if (!m_sight->isOn() || !at
        || !(isLines || (m_document.hasPings() && m_rows->currentIndex() != m_columns->currentIndex())))
        return;
    const bool isBest = isMaximised();
    const std::size_t model = !analysis->isBank() ? 0 : std::size_t(m_model->currentIndex());
    StateSlice slice{1, 0, {}}; // of lines: slope × frequency
    if (!isLines)
        slice = {std::size_t(m_rows->currentIndex()), std::size_t(m_columns->currentIndex()), {}};
    m_runner.start([this, analysis, at = *at, isBest, model, slice](const RunContext &context) -> JobRunner::Delivery {
        if (!m_replay || m_replay->analysis() != analysis)
            m_replay = std::make_shared<StateReplay>(
                analysis, memoryShares::orSome(memoryShares::stateReplay, 8 * bytesOfStates(*analysis)));
        const auto states = m_replay->at(analysis->time().nearest(at.seconds), model, context);
        if (states->values.empty())
            throw Error("state space", "this detector has no states; choose the sequential Markov detector");
        const StateSpace &space = analysis->modelAt(model).space;
        Cut cut{slice, readableAxes(*analysis, model), {}, {}, {}, model, states->frame, 0.0};
        std::vector<Index> cell;
        for (std::size_t i = 0; i < at.position.size(); ++i)
            cell.push_back(cut.axes[i].nearest(at.position[i]));
        const std::vector<Index> rates = bestRates(space, states->values, analysis->grid().cell(cell));
        cell.insert(cell.end(), rates.begin(), rates.end());
        for (std::size_t i = 0; i < cell.size(); ++i) {
            cut.values.push_back(cut.axes[i].value(double(cell[i])));
            cut.slice.places.push_back(isBest ? std::nullopt : std::optional(cell[i]));
        }
        cut.scores = cutStates(space, states->values, cut.slice);
        cut.best = double(*std::max_element(cut.scores.begin(), cut.scores.end()));
        cut.picture =
            pictureOf(cut.axes[slice.rows], cut.axes[slice.columns], cut.scores, ByteScale(ByteScale::Kind::ScoreNats));
        return [this, analysis, cut] {
            if (m_document.analysis() == analysis) // something else may be open by now
                show(cut);
        };
    });
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
        return update(); // back to the cell's best slope
    }
    PingViewports::Place place = m_viewports.place();
    const auto take = [&](std::size_t axis, double value) {
        if (axis < 2)
            (axis == 0 ? place.range : place.bearing) = value;
    };
    take(m_shownAxes.first, m_viewport.cursor()->seconds);
    take(m_shownAxes.second, m_viewport.cursor()->hz);
    m_viewports.setPlace(place);
}

void StateSlicePanel::show(const Cut &cut)
{
    const Axis &rows = cut.axes[cut.slice.rows];
    const Axis &columns = cut.axes[cut.slice.columns];
    const QScopedValueRollback showing(m_isShowing, true);
    const std::pair axes{cut.slice.rows, cut.slice.columns};
    const Viewport::Point cursor{cut.values[axes.first], cut.values[axes.second]};
    if (axes != m_shownAxes) {
        constexpr double fewestCells = 3.0;
        m_viewport.setExtents(whole(rows), whole(columns), fewestCells * rows.step, fewestCells * columns.step);
        if (isOfLines())
            m_viewport.zoomTo(whole(rows), m_document.viewport().frequency());
        else
            m_viewport.zoomTo(firstSpan(rows, cursor.seconds), firstSpan(columns, cursor.hz));
        m_shownAxes = axes;
    }
    m_cut = cut;
    m_viewport.setCursor(cursor);
    m_viewport.reveal({{cursor.seconds, cursor.seconds}, {cursor.hz, cursor.hz}});
    m_view->setThreshold(m_document.shownThreshold());
    const bool isOurRange = m_view->isRangeAutomatic() || m_view->range() == m_givenRange;
    m_view->setPicture(cut.picture, columns);
    m_view->updateLayout(); // its axes may have come just now
    if (isOurRange)
        chooseRange();

    placeMarks();
    m_sentence->setText(
        isOfLines()
            ? tr("Frame %1 at %2: %3")
                  .arg(cut.frame + 1)
                  .arg(secondsText(m_document.analysis()->time().value(double(cut.frame)),
                                   m_document.analysis()->time().step),
                       bestWords(cut))
            : tr("Ping %1: %2; at most %3 nat").arg(cut.frame + 1).arg(otherWords(cut), numberText(cut.best, 1)));
}

/// A followed target's states stand far above the threshold; its hill is what there is to see. Of lines, that under the
/// cursor: a carrier elsewhere may have gathered a hundred times as much.
void StateSlicePanel::chooseRange()
{
    m_view->setAutomaticRange();
    m_view->setRange(m_view->range().low,
                     std::max(m_view->range().high, isOfLines() ? scoreAtCursor(*m_cut) : m_cut->best));
    m_givenRange = m_view->range();
}

/// Where the axes that are not shown stand.
QString StateSlicePanel::otherWords(const Cut &cut) const
{
    QStringList others;
    for (std::size_t i = 0; i < cut.axes.size(); ++i)
        if (i != cut.slice.rows && i != cut.slice.columns)
            others << (cut.slice.places[i] ? tr("%1 %2 %3")
                                                 .arg(labelText(cut.axes[i].name, mostUnitLetters),
                                                      numberText(cut.values[i], decimalsFor(cut.axes[i].step)),
                                                      labelText(cut.axes[i].unit, mostUnitLetters))
                                           : tr("best %1").arg(labelText(cut.axes[i].name, mostUnitLetters)));
    return others.join(QStringLiteral(", "));
}

double StateSlicePanel::scoreAtCursor(const Cut &cut) const
{
    const Axis &rows = cut.axes[cut.slice.rows];
    const Axis &columns = cut.axes[cut.slice.columns];
    const Index row = rows.nearest(cut.values[cut.slice.rows]);
    return double(cut.scores[std::size_t(row * columns.count + columns.nearest(cut.values[cut.slice.columns]))]);
}

/// The best state in view, and that of the cursor's cell.
QString StateSlicePanel::bestWords(const Cut &cut) const
{
    const Axis &frequency = cut.axes[0];
    const Axis &slope = cut.axes[1];
    const auto stateWords = [&](double hz, double rate) {
        const QString unit = labelText(slope.unit, mostUnitLetters);
        return tr("%1, %2 %3").arg(hertzText(hz, frequency.step), numberText(rate, decimalsFor(slope.step)), unit);
    };
    QString words = tr("at the cursor %1 nat (%2)")
                        .arg(numberText(scoreAtCursor(cut), 1), stateWords(cut.values[0], cut.values[1]));
    if (const auto best = m_marks->best())
        words +=
            tr("; best in view ○ %1 nat (%2)").arg(numberText(best->score, 1), stateWords(best->column, best->row));
    if (!m_marks->paths().empty())
        words += tr("; ◇ a track's state");
    return words;
}

/// The best of the states in view, and those of the tracks' paths that lie in the slice.
void StateSlicePanel::placeMarks()
{
    if (!m_cut || !m_document.analysis())
        return m_marks->clear();
    const Cut &cut = *m_cut;
    const Axis &rows = cut.axes[cut.slice.rows];
    const Axis &columns = cut.axes[cut.slice.columns];
    std::optional<SliceMarks::Best> best;
    for (Index row = 0; row < rows.count; ++row)
        for (Index column = 0; column < columns.count; ++column) {
            const auto score = double(cut.scores[std::size_t(row * columns.count + column)]);
            const SliceMarks::Best here{rows.value(double(row)), columns.value(double(column)), score};
            if ((!best || score > best->score) && m_viewport.time().contains(here.row)
                && m_viewport.frequency().contains(here.column))
                best = here;
        }
    std::vector<Viewport::Point> paths;
    const Grid &grid = m_document.analysis()->grid();
    const StateSpace &space = m_document.analysis()->modelAt(cut.model).space;
    for (const Track &track : m_document.shownTracks()) {
        const Index i = cut.frame - (track.points.empty() ? 0 : track.points.front().frame);
        if (track.model != cut.model || i < 0 || i >= std::ssize(track.points))
            continue;
        const TrackPoint &point = track.points[std::size_t(i)];
        std::vector<Index> state = grid.coordinates(point.cell);
        const StateSpace::Coordinates coordinates = space.coordinates(point.plane * space.cellCount() + point.cell);
        state.insert(state.end(), coordinates.rates.begin(), coordinates.rates.end());
        bool isInSlice = true;
        for (std::size_t axis = 0; axis < state.size(); ++axis)
            if (axis != cut.slice.rows && axis != cut.slice.columns && cut.slice.places[axis])
                isInSlice = isInSlice && *cut.slice.places[axis] == state[axis];
        if (isInSlice)
            paths.push_back(
                {rows.value(double(state[cut.slice.rows])), columns.value(double(state[cut.slice.columns]))});
    }
    m_marks->set(best, std::move(paths));
}

/// The frequencies that the waterfalls show …
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
