#include "app/OutputLayers.h"

#include "widgets/LayerItem.h"
#include "widgets/Theme.h"
#include "widgets/WaterfallView.h"
#include "widgets/quantities.h"

#include <qwt_plot_canvas.h>

#include <QEvent>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr int pauseMs = 40;

} // namespace

OutputLayers::OutputLayers(Document &document, WaterfallView &output, QObject *parent)
    : QObject(parent), m_document(document), m_output(output), m_item(new LayerItem)
{
    m_item->attach(&output);
    m_item->makeKey().release()->attach(&output); // the plot's from now on
    output.installEventFilter(this);
    output.canvas()->installEventFilter(this);
    m_pause.setSingleShot(true);
    m_pause.setInterval(pauseMs);
    connect(&m_pause, &QTimer::timeout, this, &OutputLayers::compute);
    connect(&document, &Document::opened, this, [this] {
        m_runner.cancel();
        m_result = {};
        show();
    });
    connect(&document, &Document::analysisChanged, this, &OutputLayers::follow);
    connect(&document.viewport(), &Viewport::spanChanged, this, [this] {
        if (m_layer != OutputLayer::Statistic)
            follow();
    });
    connect(&document.viewport(), &Viewport::cursorChanged, this, &OutputLayers::followCursor);
    connect(&output, &WaterfallView::orientationChanged, this, &OutputLayers::follow);
    connect(&m_runner, &JobRunner::failed, this, [this](const Error &error) {
        emit failed(error);
        emit settled();
    });
    connect(&m_runner, &JobRunner::finished, this, &OutputLayers::settled);
    connect(&m_runner, &JobRunner::cancelled, this, &OutputLayers::settled);
}

bool OutputLayers::isPossible() const
{
    const auto &analysis = m_document.analysis();
    return analysis && !m_document.hasPings() && analysis->bank.empty() && analysis->model.space.axes().size() == 1;
}

bool OutputLayers::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == &m_output && event->type() == QEvent::PaletteChange)
        show();
    if (watched == m_output.canvas() && event->type() == QEvent::Resize && m_layer != OutputLayer::Statistic)
        follow();
    return QObject::eventFilter(watched, event);
}

void OutputLayers::setLayer(OutputLayer layer)
{
    if (layer == m_layer)
        return;
    m_layer = layer;
    show();
    follow();
    emit layerChanged();
}

QString OutputLayers::heading() const
{
    switch (m_layer) {
    case OutputLayer::Rate:
        return tr("Winning slope of each cell");
    case OutputLayer::Age:
        return tr("Age of each cell's best path");
    case OutputLayer::Reset:
        return tr("States reset");
    case OutputLayer::Inhibited:
        return tr("Cells kept from the detector");
    case OutputLayer::Statistic:
        break;
    }
    return tr("Statistic D");
}

void OutputLayers::cycleLayer()
{
    setLayer(static_cast<OutputLayer>((static_cast<std::size_t>(m_layer) + 1) % outputLayerNames.size()));
}

void OutputLayers::setOverlay(bool isOverlay)
{
    if (isOverlay == m_isOverlay)
        return;
    m_isOverlay = isOverlay;
    show();
    emit layerChanged();
}

void OutputLayers::setWatching(bool isWatching)
{
    m_isWatching = isWatching;
    follow();
}

void OutputLayers::follow()
{
    if (isPossible() && (m_layer != OutputLayer::Statistic || m_isWatching))
        m_pause.start();
}

void OutputLayers::followCursor()
{
    if (m_isWatching || m_layer != OutputLayer::Statistic)
        follow();
}

/// The frames and cells in view, no finer than the pixels.
LayerWindow OutputLayers::window() const
{
    const Analysis &analysis = *m_document.analysis();
    const Viewport::Box &visible = m_document.viewport().visible();
    const Axis &time = analysis.time();
    const Axis &frequency = analysis.grid().axes.front();
    const QSize size = (QSizeF(m_output.canvas()->contentsRect().size()) * m_output.devicePixelRatioF()).toSize();
    const bool isTimeVertical = m_output.orientation() != WaterfallView::Orientation::LeftToRight;
    return {time.nearest(visible.time.low),
            time.nearest(visible.time.high) + 1,
            frequency.nearest(visible.frequency.low),
            frequency.nearest(visible.frequency.high) + 1,
            std::max(1, isTimeVertical ? size.height() : size.width()),
            std::max(1, isTimeVertical ? size.width() : size.height())};
}

void OutputLayers::compute()
{
    if (!isPossible())
        return emit settled();
    const auto analysis = m_document.analysis();
    const auto cursor = m_document.viewport().cursor();
    const bool wantsPicture = m_layer != OutputLayer::Statistic;
    m_runner.start([this, analysis, cursor, wantsPicture, window = window()](const RunContext &context) -> JobRunner::Delivery {
        if (!m_replay || m_replay->analysis() != analysis)
            m_replay = std::make_shared<LayerReplay>(analysis);
        Result result{analysis, {}, {}, -1, -1};
        if (wantsPicture)
            result.picture = std::make_shared<const LayerPicture>(layerPicture(*m_replay, window, context));
        if (cursor) {
            result.frame = analysis->time().nearest(cursor->seconds);
            result.cell = analysis->grid().axes.front().nearest(cursor->hz);
            result.atCursor = readCell(*analysis, m_replay->at(result.frame, context), result.cell);
        }
        return [this, result] {
            if (m_document.analysis() != result.analysis)
                return;
            m_result = result;
            show();
            emit readingChanged();
        };
    });
}

std::optional<CellReading> OutputLayers::readingAt(const Viewport::Point &point) const
{
    const auto &analysis = m_document.analysis();
    if (!analysis || m_result.analysis != analysis)
        return {};
    const Index frame = analysis->time().nearest(point.seconds);
    const Index cell = analysis->grid().axes.front().nearest(point.hz);
    if (m_result.atCursor && frame == m_result.frame && cell == m_result.cell)
        return m_result.atCursor;
    if (!m_result.picture)
        return {};
    const LayerPicture &picture = *m_result.picture;
    const Index row = frame / picture.framesPerRow - picture.firstRow;
    const Index column = cell / picture.cellsPerColumn - picture.firstColumn;
    if (row < 0 || row >= picture.rows || column < 0 || column >= picture.columns)
        return {};
    const auto pixel = static_cast<std::size_t>(row * picture.columns + column);
    return CellReading{static_cast<double>(picture.rate[pixel]), static_cast<double>(picture.age[pixel]), picture.inhibited[pixel] > 0.0f,
                       static_cast<double>(picture.statistic[pixel])};
}

void OutputLayers::show()
{
    const auto &analysis = m_document.analysis();
    const bool isShown = analysis && m_result.analysis == analysis && m_result.picture && m_layer != OutputLayer::Statistic;
    m_item->setTimeVertical(m_output.orientation() != WaterfallView::Orientation::LeftToRight);
    const Theme::Colours &colours = Theme::colours(m_output);
    m_item->setColours(colours.text, colours.canvas);
    if (!isShown) {
        m_item->setPicture(nullptr, {}, {});
        return m_output.replot();
    }
    m_item->setPicture(m_result.picture, analysis->time(), analysis->grid().axes.front());
    m_item->setOverlay(m_isOverlay, analysis->threshold);
    switch (m_layer) {
    case OutputLayer::Rate: {
        const KinematicAxis &axis = analysis->model.space.axes().front();
        const double step = analysis->grid().axes.front().step / analysis->time().step;
        const double largest = step * std::max({std::abs(axis.firstRate), std::abs(axis.firstRate + axis.rateCount - 1), 1});
        const QString name = QString::fromStdString(analysis->grid().axes.front().unit);
        const FrequencyUnit unit = name == QLatin1String("Hz") ? rateUnit(largest) : FrequencyUnit{name + "/s", 1.0};
        m_item->setLayer(m_layer, {-largest, largest}, tr("Winning slope (%1)").arg(unit.name), unit.hz);
        break;
    }
    case OutputLayer::Age: {
        const std::vector<float> &ages = m_result.picture->age;
        const auto longest = static_cast<double>(*std::max_element(ages.begin(), ages.end()));
        constexpr double manySeconds = 7200.0;
        const bool isLong = longest > manySeconds;
        m_item->setLayer(m_layer, {0.0, std::max(longest, analysis->time().step)},
                         isLong ? tr("Path age since reset (h)") : tr("Path age since reset (s)"), isLong ? 3600.0 : 1.0);
        break;
    }
    case OutputLayer::Reset:
        m_item->setLayer(m_layer, {0.0, 1.0}, tr("States reset (fraction)"), 1.0);
        break;
    case OutputLayer::Inhibited:
        m_item->setLayer(m_layer, {0.0, 1.0}, tr("Kept from the detector"), 1.0);
        break;
    case OutputLayer::Statistic:
        break;
    }
    m_output.replot();
}

} // namespace faintline
