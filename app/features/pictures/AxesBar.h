#pragma once

#include "base/FramePlane.h"

#include <QWidget>

#include <utility>
#include <vector>

class QComboBox;
class QHBoxLayout;
class QLabel;

namespace faintline {

/// Choice of the two axes shown of frames on more axes, and of what is shown of the others: their maxima, or a slice at
/// the cursor, whose position on each of them can be stepped. Hidden for frames on two axes.
class AxesBar : public QWidget
{
    Q_OBJECT

public:
    using Pair = std::pair<std::size_t, std::size_t>; ///< along, across

    explicit AxesBar(QWidget *parent = nullptr);

    void setGrid(const Grid &grid);
    /// `position`: of the cursor, one per axis.
    void show(const FramePlane &plane, const std::vector<double> &position, bool isSliced);

    QComboBox *pairs() const { return m_pairs; }
    QComboBox *others() const { return m_others; }

signals:
    void axesChosen(std::size_t along, std::size_t across);
    void slicedChosen(bool isSliced);
    void cellChosen(std::size_t axis, faintline::Index cell);

private:
    class CellBox;

    void placeBoxes();

    Grid m_grid;
    QComboBox *m_pairs;
    QComboBox *m_others;
    QHBoxLayout *m_row;
    std::vector<std::pair<QLabel *, CellBox *>> m_boxes; ///< one per axis
};

/// All pairs of axes; of a pair, a cyclic axis is the one across.
std::vector<AxesBar::Pair> pairsOfAxes(const Grid &grid);

} // namespace faintline
