#include "app/features/pictures/AxesBar.h"

#include "app/document/FrameKind.h"
#include "base/Field.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSpinBox>

#include <algorithm>

namespace faintline {

namespace {

    QString nameOf(const Axis &axis)
    {
        return labelText(axis.name, mostUnitLetters);
    }

    enum Others { Maxima, Slice };

} // namespace

/// A cell of an axis, by its value.
class AxesBar::CellBox : public QSpinBox
{
public:
    explicit CellBox(const Axis &axis) : m_axis(axis)
    {
        setRange(0, int(axis.count) - 1);
        setWrapping(axis.cyclic);
        setKeyboardTracking(false);
        setAccessibleName(AxesBar::tr("Slice at %1").arg(nameOf(axis)));
        setToolTip(AxesBar::tr("Position of the slice, and of the cursor, on the axis of %1").arg(nameOf(axis)));
    }

protected:
    QString textFromValue(int cell) const override
    {
        const QString unit = labelText(m_axis.unit, mostUnitLetters);
        const QString number = numberText(m_axis.value(cell), decimalsFor(m_axis.step));
        return number + (unit == QStringLiteral("°") ? unit : QLatin1Char(' ') + unit);
    }
    int valueFromText(const QString &text) const override
    {
        const auto number = numberIn(text);
        return number ? int(m_axis.nearest(*number)) : value();
    }
    QValidator::State validate(QString &text, int &) const override
    {
        return numberIn(text) ? QValidator::Acceptable : QValidator::Intermediate;
    }

private:
    /// The number at the beginning.
    static std::optional<double> numberIn(QString text)
    {
        text.replace(QChar(0x2212), QLatin1Char('-'));
        const QString first = text.trimmed().section(QLatin1Char(' '), 0, 0).remove(QStringLiteral("°"));
        bool isNumber = false;
        const double number = QLocale::c().toDouble(first, &isNumber);
        return isNumber ? std::optional(number) : std::nullopt;
    }

    Axis m_axis;
};

std::vector<AxesBar::Pair> pairsOfAxes(const Grid &grid)
{
    std::vector<AxesBar::Pair> pairs;
    for (std::size_t i = 0; i < grid.axes.size(); ++i)
        for (std::size_t j = i + 1; j < grid.axes.size(); ++j) {
            const bool isTurned = grid.axes[i].cyclic && !grid.axes[j].cyclic;
            pairs.push_back(isTurned ? AxesBar::Pair(j, i) : AxesBar::Pair(i, j));
        }
    return pairs;
}

AxesBar::AxesBar(QWidget *parent)
    : QWidget(parent), m_pairs(new QComboBox), m_others(new QComboBox), m_row(new QHBoxLayout(this))
{
    m_pairs->setAccessibleName(tr("Axes shown"));
    m_pairs->setToolTip(tr("The two axes of the maps and of the pictures below them"));
    m_others->addItem(tr("maximum over the others"));
    m_others->addItem(tr("slice at the cursor"));
    m_others->setAccessibleName(tr("Other axes"));
    m_others->setToolTip(
        tr("What the maps show of the other axes: the largest value behind each place, or the cells at "
           "the cursor"));
    for (QComboBox *box : {m_pairs, m_others})
        box->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    connect(m_pairs, &QComboBox::activated, this, [this](int i) {
        const Pair pair = pairsOfAxes(m_grid)[std::size_t(i)];
        emit axesChosen(pair.first, pair.second);
    });
    connect(m_others, &QComboBox::activated, this, [this](int i) { emit slicedChosen(i == Slice); });
    m_row->setContentsMargins(8, 2, 8, 0);
    m_row->setSpacing(6);
    auto *label = new QLabel(tr("Axes shown:"));
    label->setBuddy(m_pairs);
    m_row->addWidget(label);
    m_row->addWidget(m_pairs);
    m_row->addWidget(m_others);
    m_row->addStretch(1);
    hide();
}

void AxesBar::setGrid(const Grid &grid)
{
    if (grid == m_grid)
        return;
    m_grid = grid;
    m_pairs->clear();
    for (const auto &[along, across] : pairsOfAxes(grid))
        m_pairs->addItem(QStringLiteral("%1 × %2").arg(nameOf(grid.axes[along]), nameOf(grid.axes[across])));
    placeBoxes();
    setVisible(frameKindOf(grid).hasHiddenAxes);
}

void AxesBar::placeBoxes()
{
    for (const auto &[label, box] : m_boxes) {
        delete label;
        delete box;
    }
    m_boxes.clear();
    for (std::size_t axis = 0; axis < m_grid.axes.size(); ++axis) {
        auto *label = new QLabel(nameOf(m_grid.axes[axis]));
        auto *box = new CellBox(m_grid.axes[axis]);
        label->setBuddy(box);
        connect(box, &QSpinBox::valueChanged, this, [this, axis](int cell) { emit cellChosen(axis, cell); });
        m_boxes.emplace_back(label, box);
        m_row->insertWidget(m_row->count() - 1, label);
        m_row->insertWidget(m_row->count() - 1, box);
    }
}

void AxesBar::show(const FramePlane &plane, const std::vector<double> &position, bool isSliced)
{
    const std::vector<Pair> pairs = pairsOfAxes(m_grid);
    const auto shown = std::ranges::find_if(
        pairs, [&](const Pair &pair) { return plane.isShown(pair.first) && plane.isShown(pair.second); });
    m_pairs->setCurrentIndex(shown == pairs.end() ? -1 : int(shown - pairs.begin()));
    m_others->setCurrentIndex(isSliced ? Slice : Maxima);
    for (std::size_t axis = 0; axis < m_boxes.size(); ++axis) {
        const auto &[label, box] = m_boxes[axis];
        const bool isStepped = isSliced && !plane.isShown(axis);
        label->setVisible(isStepped);
        box->setVisible(isStepped);
        const QSignalBlocker blocker(box);
        if (axis < position.size())
            box->setValue(int(m_grid.axes[axis].nearest(position[axis])));
    }
}

} // namespace faintline
