#include "app/StateSlicePanel.h"

#include "spectrum/pictureCuts.h"
#include "widgets/ColourBar.h"
#include "widgets/WaterfallView.h"
#include "widgets/quantities.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QScopedValueRollback>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr Index longAxis = 200;    ///< cells from which on only the cursor's surroundings are shown at first
    constexpr double surroundings = 60.0; ///< cells either way

    QString capitalised(QString text)
    {
        if (!text.isEmpty())
            text[0] = text[0].toUpper();
        return text;
    }

    Span whole(const Axis &axis)
    {
        return {axis.value(-0.5), axis.value(static_cast<double>(axis.count) - 0.5)};
    }

    Span firstSpan(const Axis &axis, double value)
    {
        if (axis.count <= longAxis)
            return whole(axis);
        return Span{value - surroundings * axis.step, value + surroundings * axis.step}.within(whole(axis));
    }

} // namespace

StateSlicePanel::StateSlicePanel(const Document &document, PingViewports &viewports, QWidget *parent)
    : QWidget(parent), m_document(document), m_viewports(viewports), m_rows(new QComboBox), m_columns(new QComboBox),
      m_others(new QComboBox), m_model(new QComboBox), m_sentence(new QLabel),
      m_view(new WaterfallView(tr("States (nat)")))
{
    m_others->addItems({tr("others at the cursor"), tr("best of the others")});
    m_others->setToolTip(tr("The axes that are not shown: at the cursor's cell with its best rates, or the maximum over all of them"));
    m_model->addItems({tr("non-manoeuvring"), tr("manoeuvring")});
    m_model->setToolTip(tr("Which of the models that run in parallel"));
    m_rows->setAccessibleName(tr("Axis upwards"));
    m_columns->setAccessibleName(tr("Axis across"));
    m_sentence->setWordWrap(true);
    m_sentence->setTextFormat(Qt::PlainText);
    m_view->setViewport(&m_viewport);
    m_view->setObjectName(QStringLiteral("slice"));
    m_view->setEmptySentence(tr("States are shown of a sonar's pings."));
    m_view->setMinimumSize(130, 120); // a panel in a dock must not widen the window
    for (QComboBox *box : {m_rows, m_columns, m_others, m_model}) {
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(5);
    }
    auto *bar = new ColourBar;
    bar->attach(m_view);

    auto *top = new QHBoxLayout;
    top->setSpacing(4);
    top->addWidget(m_rows, 1);
    top->addWidget(new QLabel(QStringLiteral("×")));
    top->addWidget(m_columns, 1);
    auto *second = new QHBoxLayout;
    second->setSpacing(4);
    second->addWidget(m_others, 1);
    second->addWidget(m_model, 1);
    auto *head = new QVBoxLayout;
    head->setContentsMargins(8, 6, 8, 4);
    head->setSpacing(4);
    head->addLayout(top);
    head->addLayout(second);
    head->addWidget(m_sentence);
    auto *pane = new QHBoxLayout;
    pane->setContentsMargins(0, 0, 0, 6);
    pane->setSpacing(0);
    pane->addWidget(m_view, 1);
    pane->addWidget(bar);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(head);
    layout->addLayout(pane, 1);

    connect(m_rows, &QComboBox::activated, this, [this] { chooseAxes(*m_rows, *m_columns); });
    connect(m_columns, &QComboBox::activated, this, [this] { chooseAxes(*m_columns, *m_rows); });
    for (QComboBox *box : {m_others, m_model})
        connect(box, &QComboBox::currentIndexChanged, this, &StateSlicePanel::update);
    connect(&document, &Document::analysisChanged, this, &StateSlicePanel::fillAxes);
    connect(&m_viewport, &Viewport::cursorChanged, this, &StateSlicePanel::followCursor);
    connect(&viewports, &PingViewports::placeChanged, this, &StateSlicePanel::update);
    connect(&m_runner, &JobRunner::progressed, this, [this](double fraction, const QString &what) {
        m_sentence->setText(tr("%1, %2 %").arg(what).arg(static_cast<int>(100.0 * fraction)));
    });
    connect(&m_runner, &JobRunner::failed, this, [this](const Error &error) {
        m_sentence->setText(QString::fromUtf8(error.what()));
        emit settled();
    });
    connect(&m_runner, &JobRunner::finished, this, &StateSlicePanel::settled);
    fillAxes();
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
    const int before = static_cast<int>(&changed == m_rows ? m_shownAxes.first : m_shownAxes.second);
    if (changed.currentIndex() == other.currentIndex())
        other.setCurrentIndex(before);
    update();
}

void StateSlicePanel::fillAxes()
{
    const auto &analysis = m_document.analysis();
    const bool hasPings = m_document.hasPings() && analysis && !analysis->model.space.axes().empty();
    for (QComboBox *box : {m_rows, m_columns, m_others, m_model})
        box->setEnabled(hasPings);
    m_model->setVisible(hasPings && analysis->bank.size() > 1);
    if (!hasPings) {
        m_runner.cancel();
        m_view->setPicture(nullptr, {});
        return m_sentence->clear();
    }
    const std::vector<Axis> axes = stateAxes(*analysis);
    if (m_rows->count() != static_cast<int>(axes.size())) {
        for (QComboBox *box : {m_rows, m_columns}) {
            const QSignalBlocker blocker(box);
            box->clear();
            for (const Axis &axis : axes)
                box->addItem(capitalised(QString::fromStdString(axis.name)));
        }
        m_rows->setCurrentIndex(0);
        m_columns->setCurrentIndex(2); // range × range rate: where a target's motion shows
    }
    m_shownAxes = {0, 0};
    update();
}

void StateSlicePanel::showEvent(QShowEvent *event)
{
    QWidget::showEvent(event);
    update();
}

void StateSlicePanel::update()
{
    const auto &analysis = m_document.analysis();
    if (!isVisible() || !analysis || !m_document.hasPings() || m_rows->currentIndex() == m_columns->currentIndex())
        return;
    const PingViewports::Place place = m_viewports.place();
    const bool isBest = isMaximised();
    const std::size_t model = analysis->bank.empty() ? 0 : static_cast<std::size_t>(m_model->currentIndex());
    StateSlice slice{static_cast<std::size_t>(m_rows->currentIndex()), static_cast<std::size_t>(m_columns->currentIndex()), {}};
    m_runner.start([this, analysis, place, isBest, model, slice](const RunContext &context) -> JobRunner::Delivery {
        if (!m_replay || m_replay->analysis() != analysis)
            m_replay = std::make_shared<StateReplay>(analysis);
        const auto states = m_replay->at(analysis->time().nearest(place.seconds), model, context);
        const StateSpace &space = analysis->bank.empty() ? analysis->model.space : analysis->bank[model].model.space;
        Cut cut{slice, stateAxes(*analysis, model), {}, {}, 0.0};
        std::vector<Index> at{cut.axes[0].nearest(place.range), cut.axes[1].nearest(place.bearing)};
        const std::vector<Index> rates = bestRates(space, states->values, analysis->grid().cell(at));
        at.insert(at.end(), rates.begin(), rates.end());
        for (std::size_t i = 0; i < at.size(); ++i) {
            cut.values.push_back(cut.axes[i].value(static_cast<double>(at[i])));
            cut.slice.places.push_back(isBest ? std::nullopt : std::optional(at[i]));
        }
        const std::vector<float> values = cutStates(space, states->values, cut.slice);
        cut.best = static_cast<double>(*std::max_element(values.begin(), values.end()));
        cut.picture = pictureOf(cut.axes[slice.rows], cut.axes[slice.columns], values, ByteScale(ByteScale::Kind::ScoreNats));
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
        m_viewport.zoomTo(firstSpan(rows, cursor.seconds), firstSpan(columns, cursor.hz));
        m_shownAxes = axes;
    }
    m_viewport.setCursor(cursor);
    m_viewport.reveal({{cursor.seconds, cursor.seconds}, {cursor.hz, cursor.hz}});
    m_view->setThreshold(m_document.shownThreshold());
    const bool isOurRange = m_view->isRangeAutomatic() || m_view->range() == m_givenRange;
    m_view->setPicture(cut.picture, columns);
    if (isOurRange) {
        // A followed target's states stand far above the threshold; its hill is what there is to see.
        m_view->setAutomaticRange();
        m_view->setRange(m_view->range().low, std::max(m_view->range().high, cut.best));
        m_givenRange = m_view->range();
    }

    QStringList others;
    for (std::size_t i = 0; i < cut.axes.size(); ++i)
        if (i != axes.first && i != axes.second)
            others << (cut.slice.places[i] ? tr("%1 %2 %3").arg(QString::fromStdString(cut.axes[i].name),
                                                               numberText(cut.values[i], decimalsFor(cut.axes[i].step)),
                                                               QString::fromStdString(cut.axes[i].unit))
                                           : tr("best %1").arg(QString::fromStdString(cut.axes[i].name)));
    m_sentence->setText(tr("Ping %1: %2; at most %3 nat")
                            .arg(m_document.analysis()->time().nearest(m_viewports.place().seconds) + 1)
                            .arg(others.join(QStringLiteral(", ")), numberText(cut.best, 1)));
}

} // namespace faintline
