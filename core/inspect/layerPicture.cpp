#include "inspect/outputLayers.h"

#include "base/logmath.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// Rate of one cell per frame along an axis, in its unit per second.
    double rateUnit(const Analysis &analysis, std::size_t axis)
    {
        return analysis.grid().axes[axis].step / analysis.time().step;
    }

    /// In the axis's unit per second, by model and plane; 0 along a missing axis.
    std::vector<std::vector<float>> ratesOfPlanes(const Analysis &analysis, std::size_t axis)
    {
        std::vector<std::vector<float>> rates(analysis.modelCount());
        for (std::size_t model = 0; model < rates.size(); ++model) {
            const StateSpace &space = analysis.modelAt(model).space;
            for (Index plane = 0; plane < space.planeCount(); ++plane)
                rates[model].push_back(axis < space.axes().size()
                                           ? float(space.ratesOfPlane(plane)[axis] * rateUnit(analysis, axis))
                                           : 0.0f);
        }
        return rates;
    }

    /// A picture of a part, painted cell by cell.
    class LayerPainter
    {
    public:
        LayerPainter(const Analysis &analysis, const LayerPart &part, Index rows, Index columns,
                     const FramePlane &plane = {})
            : m_rows(rows), m_columns(columns), m_frameSeconds(float(analysis.time().step)),
              m_rates(ratesOfPlanes(analysis, plane.along)), m_secondRates(ratesOfPlanes(analysis, plane.across))
        {
            picture = pixelsOf(part, rows, columns);
            const auto size = std::size_t(picture.rows * picture.columns);
            picture.statistic.assign(size, unreached);
            for (std::vector<float> *values :
                 {&picture.rate, &picture.secondRate, &picture.age, &picture.resetFraction, &picture.inhibited})
                values->assign(size, 0.0f);
        }

        Index firstRow() const { return picture.firstRow * picture.perRow; }
        Index endRow() const { return std::min((picture.firstRow + picture.rows) * picture.perRow, m_rows); }

        Index firstColumn() const { return picture.firstColumn * picture.perColumn; }
        Index endColumn() const
        {
            return std::min((picture.firstColumn + picture.columns) * picture.perColumn, m_columns);
        }

        /// Paints one row of the part; `cellsOf` calls a function with each cell of a column.
        template <class CellsOf>
        void paintRow(Index row, const CellLayers &layers, CellsOf &&cellsOf)
        {
            for (Index column = firstColumn(); column < endColumn(); ++column) {
                const auto pixel = std::size_t(picture.pixelAt(row, column));
                cellsOf(column, [&](Index cell) { paint(pixel, layers, std::size_t(cell)); });
            }
        }

        LayerPicture picture;

    private:
        void paint(std::size_t pixel, const CellLayers &layers, std::size_t cell)
        {
            if (layers.isInhibited[cell])
                picture.inhibited[pixel] = 1.0f;
            if (!(layers.statistic[cell] > picture.statistic[pixel]))
                return;
            const auto plane = std::size_t(layers.plane[cell]);
            picture.statistic[pixel] = layers.statistic[cell];
            picture.rate[pixel] = m_rates[layers.model[cell]][plane];
            picture.secondRate[pixel] = m_secondRates[layers.model[cell]][plane];
            picture.age[pixel] = float(layers.age[cell]) * m_frameSeconds;
            picture.resetFraction[pixel] = layers.resetFraction[cell];
        }

        Index m_rows;
        Index m_columns;
        float m_frameSeconds;
        std::vector<std::vector<float>> m_rates;
        std::vector<std::vector<float>> m_secondRates;
    };

    /// Fraction of a cell that lies inside a band.
    double shareInside(Index cell, const SmoothedPoint &point)
    {
        const double low = std::max(double(cell) - 0.5, double(point.low));
        const double high = std::min(double(cell) + 0.5, double(point.high));
        return cell == Index(std::lround(point.position)) ? 1.0 : std::max(0.0, high - low);
    }

    SmoothedPoint smoothedOf(const Track &track, std::size_t i)
    {
        const auto cell = double(track.points[i].cell);
        return track.hasSecondPass() ? track.smoothed[i] : SmoothedPoint{cell, float(cell), float(cell), 1.0f, 0.0f};
    }

    void raise(LayerPicture &picture, Index frame, Index cell, double value)
    {
        if (const Index pixel = picture.pixelAt(frame, cell); pixel >= 0) {
            float &shown = picture.presence[std::size_t(pixel)];
            shown = std::max(shown, float(value));
        }
    }

} // namespace

const std::vector<float> &LayerPicture::values(OutputLayer layer) const
{
    switch (layer) {
    case OutputLayer::Rate:
        return rate;
    case OutputLayer::SecondRate:
        return secondRate;
    case OutputLayer::Age:
        return age;
    case OutputLayer::Reset:
        return resetFraction;
    case OutputLayer::Inhibited:
        return inhibited;
    case OutputLayer::Presence:
        return presence;
    case OutputLayer::Statistic:
        break;
    }
    return statistic;
}

Index LayerPicture::pixelAt(Index row, Index column) const
{
    const Index r = row / perRow - firstRow;
    const Index c = column / perColumn - firstColumn;
    return row < 0 || column < 0 || r < 0 || r >= rows || c < 0 || c >= columns ? -1 : r * columns + c;
}

LayerPicture pixelsOf(const LayerPart &part, Index rows, Index columns)
{
    const Index endRow = std::min(part.endRow, rows);
    const Index endColumn = std::min(part.endColumn, columns);
    const Index beginRow = std::clamp<Index>(part.beginRow, 0, endRow);
    const Index beginColumn = std::clamp<Index>(part.beginColumn, 0, endColumn);
    const auto per = [](Index length, Index most) {
        return std::max<Index>(1, (length + most - 1) / std::max<Index>(1, most));
    };
    const auto count = [](Index begin, Index end, Index by) {
        return end > begin ? (end - 1) / by - begin / by + 1 : 0;
    };
    LayerPicture picture;
    picture.perRow = per(endRow - beginRow, part.mostRows);
    picture.perColumn = per(endColumn - beginColumn, part.mostColumns);
    picture.firstRow = beginRow / picture.perRow;
    picture.firstColumn = beginColumn / picture.perColumn;
    picture.rows = count(beginRow, endRow, picture.perRow);
    picture.columns = count(beginColumn, endColumn, picture.perColumn);
    return picture;
}

LayerPicture layerPicture(LayerReplay &replay, const LayerPart &part, const RunContext &context)
{
    const Analysis &analysis = *replay.analysis();
    LayerPainter painter(analysis, part, analysis.time().count, analysis.grid().size());
    const Index first = painter.firstRow();
    const Index end = painter.endRow();
    for (Index frame = first; frame < end; ++frame) {
        const double done = double(frame - first) / double(end - first);
        context.checkpoint(done, "layers");
        painter.paintRow(frame,
                         replay.at(frame, context.part(done, done), {painter.firstColumn(), painter.endColumn()}),
                         [](Index column, auto paint) { paint(column); });
    }
    return std::move(painter.picture);
}

LayerPicture layerPictureOf(LayerReplay &replay, Index ping, const LayerPart &part, const FramePlane &plane,
                            const RunContext &context)
{
    const Analysis &analysis = *replay.analysis();
    const CellsBehind cells(analysis.grid(), plane);
    LayerPainter painter(analysis, part, cells.rows(), cells.columns(), plane);
    const CellLayers &layers = replay.at(ping, context);
    for (Index row = painter.firstRow(); row < painter.endRow(); ++row)
        painter.paintRow(row, layers, [&](Index column, auto paint) {
            for (const Index behind : cells.hidden())
                paint(cells.first(row, column) + behind);
        });
    return std::move(painter.picture);
}

LayerPicture presencePicture(const Analysis &analysis, const LayerPart &part)
{
    const Index cells = analysis.grid().size();
    LayerPicture picture = pixelsOf(part, analysis.time().count, cells);
    picture.presence.assign(std::size_t(picture.rows * picture.columns), 0.0f);
    for (const Track &track : analysis.tracks)
        for (std::size_t i = 0; i < track.points.size(); ++i) {
            const SmoothedPoint point = smoothedOf(track, i);
            const auto at = [&](double position) { return std::clamp<Index>(std::lround(position), 0, cells - 1); };
            const Index first = std::min(at(double(point.low)), at(point.position));
            const Index last = std::max(at(double(point.high)), at(point.position));
            for (Index cell = first; cell <= last; ++cell)
                raise(picture, track.points[i].frame, cell, double(point.presence) * shareInside(cell, point));
        }
    return picture;
}

double largestRate(const Analysis &analysis, std::size_t axis)
{
    double cellsPerFrame = 0.0;
    for (std::size_t model = 0; model < analysis.modelCount(); ++model) {
        const KinematicAxis &own = analysis.modelAt(model).space.axes()[axis];
        cellsPerFrame = std::max({cellsPerFrame, std::abs(own.rate(0)), std::abs(own.rate(own.rateCount - 1))});
    }
    return (cellsPerFrame > 0.0 ? cellsPerFrame : 1.0) * rateUnit(analysis, axis);
}

CellReading readCell(const Analysis &analysis, const CellLayers &layers, Index cell, const FramePlane &plane)
{
    const auto i = std::size_t(cell);
    const std::vector<double> rates = analysis.modelAt(layers.model[i]).space.ratesOfPlane(layers.plane[i]);
    const auto rate = [&](std::size_t axis) {
        return axis < rates.size() ? rates[axis] * rateUnit(analysis, axis) : 0.0;
    };
    return {rate(plane.along), rate(plane.across), double(layers.age[i]) * analysis.time().step,
            layers.isInhibited[i] != 0, double(layers.statistic[i])};
}

CellReading readPixel(const LayerPicture &picture, Index pixel)
{
    const auto i = std::size_t(pixel);
    return {double(picture.rate[i]), double(picture.secondRate[i]), double(picture.age[i]), picture.inhibited[i] > 0.0f,
            double(picture.statistic[i])};
}

} // namespace faintline
