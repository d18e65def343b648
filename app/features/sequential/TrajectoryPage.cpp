#include "app/features/sequential/TrajectoryPage.h"

#include "app/features/sequential/SequentialTests.h"
#include "exchange/sequentialCsv.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"
#include "widgets/plot/CellPicture.h"

#include <QComboBox>
#include <QLabel>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

TrajectoryPage::TrajectoryPage(SequentialTests &tests, QWidget *parent)
    : QSplitter(Qt::Horizontal, parent), m_tests(tests), m_axis(new QComboBox), m_posterior(new CellPicture),
      m_scan(new CellPicture)
{
    m_posterior->setEmptySentence(tr("Posterior of the target's cell in the selected run, stage by stage."));
    m_posterior->setAccessibleName(tr("Posterior probability of the target's cell, stage by stage"));
    m_scan->setAccessibleName(tr("Range-Doppler map of the stage"));
    m_axis->setAccessibleName(tr("Axis of the posterior"));
    connect(m_axis, &QComboBox::activated, this, &TrajectoryPage::showInspection);
    connect(m_posterior, &MarkedPlot::activated, this, [this](double x) { m_tests.setStage(std::lround(x)); });
    connect(&tests, &SequentialTests::inspectionChanged, this, &TrajectoryPage::showInspection);
    connect(&tests, &SequentialTests::scanChanged, this, &TrajectoryPage::showScan);
    connect(&tests, &SequentialTests::stageChanged, this, &TrajectoryPage::showStage);

    auto *axisRow = new QHBoxLayout;
    axisRow->setContentsMargins(8, 3, 8, 0);
    axisRow->addWidget(new QLabel(tr("Axis")));
    axisRow->addWidget(m_axis);
    axisRow->addStretch(1);
    auto *left = new QWidget;
    auto *layout = new QVBoxLayout(left);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(axisRow);
    layout->addWidget(m_posterior, 1);
    setChildrenCollapsible(false);
    addWidget(left);
    addWidget(m_scan);
    setStretchFactor(0, 3);
    setStretchFactor(1, 2);
}

int TrajectoryPage::axis() const
{
    return m_axis->currentIndex();
}

void TrajectoryPage::showAxis(int axis)
{
    m_axis->setCurrentIndex(axis);
    showInspection();
}

std::string TrajectoryPage::posteriorNumbers() const
{
    const PosteriorPicture *picture = shownPosterior();
    return picture ? posteriorCsv(*picture) : std::string();
}

std::string TrajectoryPage::scanNumbers() const
{
    std::string csv = "range,doppler,db\n";
    const Index rows = m_scan->yAxis().count;
    for (std::size_t i = 0; i < m_scan->values().size(); ++i)
        csv += std::to_string(Index(i) % rows) + "," + std::to_string(Index(i) / rows) + ","
               + formatNumber(double(m_scan->values()[i])) + "\n";
    return csv;
}

void TrajectoryPage::clear()
{
    m_axis->clear();
    m_posterior->clear();
    m_scan->clear();
    m_scan->setEmptySentence(m_tests.isOfScans() ? tr("The scan of the stage shown.")
                                                 : tr("Frames of a recording have no range or Doppler axis."));
    showStage();
}

void TrajectoryPage::showStage()
{
    m_posterior->setCursor(m_tests.selected() >= 0 ? std::optional(double(m_tests.stage())) : std::nullopt);
}

const PosteriorPicture *TrajectoryPage::shownPosterior() const
{
    const auto &inspection = m_tests.inspection();
    const auto index = std::size_t(std::max(0, m_axis->currentIndex()));
    return inspection && index < inspection->test.posterior.size() ? &inspection->test.posterior[index] : nullptr;
}

Axis TrajectoryPage::cellAxis(const PosteriorPicture &picture) const
{
    if (m_tests.isOfScans())
        return {picture.name, "cell", 0.0, 1.0, picture.cells, false};
    Axis axis = m_tests.selection().frames->grid().axes[0];
    axis.first = axis.value(double(m_tests.selection().firstCell));
    axis.count = picture.cells;
    return axis;
}

void TrajectoryPage::showInspection()
{
    const auto &inspection = m_tests.inspection();
    if (!inspection)
        return;
    if (m_axis->count() != int(inspection->test.posterior.size())) {
        m_axis->clear();
        std::size_t finest = 0;
        for (std::size_t i = 0; i < inspection->test.posterior.size(); ++i) {
            m_axis->addItem(labelText(inspection->test.posterior[i].name, mostUnitLetters));
            if (inspection->test.posterior[i].cells > inspection->test.posterior[finest].cells)
                finest = i;
        }
        m_axis->setCurrentIndex(int(finest));
    }
    const PosteriorPicture &picture = *shownPosterior();
    constexpr double leastLg = -4.0;
    std::vector<float> lg;
    for (const float p : picture.probability)
        lg.push_back(float(std::log10(std::max(double(p), 1e-9))));
    const Axis cells = cellAxis(picture);
    m_posterior->setPicture({"stage", "", 1.0, double(picture.stride), picture.rows(), false}, cells, std::move(lg),
                            {leastLg, 0.0}, tr("log₁₀ P"));

    const Theme::Colours &colours = Theme::colours(*this);
    CellPicture::Path truth{tr("truth"), CellPicture::Path::Kind::Dashes, colours.truth, {}};
    CellPicture::Path map{tr("MAP trajectory"), CellPicture::Path::Kind::Line, colours.track, {}};
    const auto point = [&](Index stage, Index cell) { return QPointF(double(stage + 1), cells.value(double(cell))); };
    for (Index stage = 0; stage < inspection->test.result.stages; ++stage) {
        const auto at = std::size_t(stage);
        if (at < inspection->truth.size())
            truth.points.push_back(point(stage, inspection->truth[at][picture.frameAxis]));
        if (at < inspection->test.result.trajectory.size())
            map.points.push_back(point(stage, inspection->test.result.trajectory[at][picture.frameAxis]));
    }
    m_posterior->setPaths({map, truth});
    showScan(); // its marks
}

void TrajectoryPage::showScan()
{
    const auto &scan = m_tests.scan();
    if (!scan)
        return;
    const ScanScene &scene = m_tests.test().scene;
    const auto ranges = std::size_t(scene.rangeCells);
    const auto dopplers = std::size_t(scene.dopplerCells);
    std::vector<float> values(ranges * dopplers);
    for (std::size_t r = 0; r < ranges; ++r)
        for (std::size_t d = 0; d < dopplers; ++d)
            values[d * ranges + r] = scan->db[r * dopplers + d];
    m_scan->setPicture({"Doppler", "cell", 0.0, 1.0, scene.dopplerCells, false},
                       {"range", "cell", 0.0, 1.0, scene.rangeCells, false}, std::move(values),
                       {0.0, std::max(15.0, scene.snrDb + 6.0)}, tr("strongest beam (dB)"));
    const auto &inspection = m_tests.inspection();
    std::vector<CellPicture::Path> marks;
    const auto at = std::size_t(scan->stage - 1);
    const Theme::Colours &colours = Theme::colours(*this);
    if (inspection && at < inspection->truth.size()) {
        const ScanCell &cell = inspection->truth[at];
        marks.push_back(
            {tr("truth"), CellPicture::Path::Kind::Rings, colours.truth, {QPointF(double(cell[3]), double(cell[2]))}});
    }
    if (inspection && at < inspection->test.result.trajectory.size()) {
        const std::vector<Index> &cell = inspection->test.result.trajectory[at];
        marks.push_back(
            {tr("MAP"), CellPicture::Path::Kind::Crosses, colours.track, {QPointF(double(cell[3]), double(cell[2]))}});
    }
    m_scan->setPaths(std::move(marks));
}

} // namespace faintline
