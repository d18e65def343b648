#include "app/features/pictures/ShownAxes.h"

#include "app/document/Document.h"
#include "app/document/ViewState.h"
#include "base/oneLine.h"
#include "frames/pictureCuts.h"
#include "widgets/pings/PingViewports.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace faintline {

ShownAxes::ShownAxes(Document &document, PingViewports &viewports, QObject *parent)
    : QObject(parent), m_document(document), m_viewports(viewports), m_bar(new AxesBar)
{
    connect(m_bar, &AxesBar::axesChosen, this, qOverload<std::size_t, std::size_t>(&ShownAxes::set));
    connect(m_bar, &AxesBar::slicedChosen, this, &ShownAxes::setSliced);
    connect(m_bar, &AxesBar::cellChosen, this, &ShownAxes::goToCell);
    connect(&document, &Document::opened, this, [this] { m_viewports.setPlane({}); });
}

void ShownAxes::set(std::size_t along, std::size_t across)
{
    const std::vector<AxesBar::Pair> pairs =
        m_document.analysis() ? pairsOfAxes(m_document.analysis()->grid()) : std::vector<AxesBar::Pair>();
    const auto found = std::ranges::find_if(pairs, [&](const AxesBar::Pair &pair) {
        return pair == AxesBar::Pair(along, across) || pair == AxesBar::Pair(across, along);
    });
    if (found == pairs.end())
        throw Error("axes", "must be two different axes of the frames");
    FramePlane plane;
    std::tie(plane.along, plane.across) = *found;
    if (plane.along == m_viewports.plane().along && plane.across == m_viewports.plane().across)
        return;
    m_viewports.setPlane(plane);
    emit axesChanged();
}

void ShownAxes::set(const std::vector<std::string> &names)
{
    const std::vector<Axis> axes = m_document.analysis() ? m_document.analysis()->grid().axes : std::vector<Axis>();
    const std::string known = listed(axes, &Axis::name);
    std::vector<std::size_t> found;
    for (const std::string &name : names) {
        const auto at = std::ranges::find(axes, name, &Axis::name);
        if (at == axes.end())
            throw Error("--axes " + name, known.empty() ? "requires pings or scans" : "must be one of " + known);
        found.push_back(std::size_t(at - axes.begin()));
    }
    if (found.size() != 2 || found[0] == found[1])
        throw Error("--axes", "must be two different axes of " + known);
    set(found[0], found[1]);
}

void ShownAxes::setSliced(bool isSliced)
{
    m_isSliced = isSliced;
    emit slicedChanged();
}

bool ShownAxes::isPolarPossible() const
{
    const Grid &grid = m_document.analysis()->grid();
    const FramePlane &plane = m_viewports.plane();
    return !frameKindOf(grid).hasHiddenAxes
           || (grid.axes[plane.across].unit == "°" && grid.axes[plane.along].name == "range");
}

bool ShownAxes::followPlace()
{
    const Grid &grid = m_document.analysis()->grid();
    const PingViewports::Place &place = m_viewports.place();
    FramePlane plane = m_viewports.plane();
    plane.cuts.clear();
    const bool isCut = m_isSliced && frameKindOf(grid).hasHiddenAxes;
    for (std::size_t axis = 0; isCut && axis < place.position.size(); ++axis)
        plane.cuts.push_back(plane.isShown(axis) ? std::nullopt
                                                 : std::optional(grid.axes[axis].nearest(place.position[axis])));
    const bool isOther = plane != m_viewports.plane();
    if (isOther)
        m_viewports.setPlane(plane);
    m_bar->show(plane, place.position, m_isSliced);
    return isOther;
}

void ShownAxes::goBehind()
{
    if (m_isSliced || !m_document.analysis() || !frameKindOf(m_document.analysis()->grid()).hasHiddenAxes)
        return;
    const Analysis &analysis = *m_document.analysis();
    const Grid &grid = analysis.grid();
    const FramePlane &plane = m_viewports.plane();
    const std::vector<double> behind = grid.position(strongestCell(
        *analysis.statistic, grid, analysis.time().nearest(m_viewports.place().seconds), plane,
        grid.axes[plane.along].nearest(m_viewports.along()), grid.axes[plane.across].nearest(m_viewports.across())));
    PingViewports::Place place = m_viewports.place();
    for (std::size_t axis = 0; axis < behind.size(); ++axis)
        if (!plane.isShown(axis))
            place.position[axis] = behind[axis];
    m_viewports.setPlace(place);
}

void ShownAxes::goToCell(std::size_t axis, Index cell)
{
    PingViewports::Place place = m_viewports.place();
    if (!m_document.analysis() || axis >= place.position.size())
        return;
    place.position[axis] = m_document.analysis()->grid().axes[axis].value(double(cell));
    m_viewports.setPlace(place);
}

void ShownAxes::restore(const ViewState &view)
{
    const auto &analysis = m_document.analysis();
    if (!view.axes || !analysis || !frameKindOf(analysis->grid()).hasHiddenAxes)
        return;
    const auto [along, across] = *view.axes;
    if (analysis->grid().hasAxis(along) && analysis->grid().hasAxis(across) && along != across)
        set(along, across);
    m_isSliced = view.isSliced;
}

} // namespace faintline
