#include "widgets/plot/ChartKey.h"

#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"

#include <QBoxLayout>
#include <QCheckBox>

#include <algorithm>

namespace faintline {

ChartKey::ChartKey(QWidget *parent) : QScrollArea(parent), m_content(new QWidget), m_layout(new QVBoxLayout(m_content))
{
    m_layout->setContentsMargins(4, 6, 8, 6);
    m_layout->setSpacing(3);
    setWidget(m_content);
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setFocusPolicy(Qt::NoFocus);
}

void ChartKey::setEntries(const std::vector<Entry> &entries)
{
    // While a curve grows, its box is kept, so that the user can press it.
    const bool isSame =
        std::equal(m_boxes.begin(), m_boxes.end(), entries.begin(), entries.end(),
                   [](const QCheckBox *box, const Entry &entry) { return box->text() == buttonText(entry.name); });
    if (!isSame)
        makeBoxes(entries);
    for (std::size_t i = 0; i < m_boxes.size(); ++i) {
        m_boxes[i]->setIcon(QIcon(entries[i].sample));
        m_boxes[i]->setVisible(!m_isPrinted || entries[i].isShown);
    }
}

void ChartKey::makeBoxes(const std::vector<Entry> &entries)
{
    while (QLayoutItem *item = m_layout->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    m_boxes.clear();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        auto *box = new QCheckBox(buttonText(entries[i].name));
        box->setToolTip(tr("Show or hide this curve"));
        box->setChecked(entries[i].isShown);
        box->setIconSize({26, 12});
        box->setFont(Theme::font(12));
        connect(box, &QCheckBox::toggled, this, [this, i](bool isOn) { emit toggled(i, isOn); });
        m_layout->addWidget(box);
        m_boxes.push_back(box);
    }
    m_layout->addStretch(1);
}

void ChartKey::setShown(std::size_t entry, bool isShown)
{
    m_boxes[entry]->setChecked(isShown);
}

void ChartKey::setPrinted(bool isPrinted)
{
    m_isPrinted = isPrinted;
    // A style sheet does not inherit the palette of the page, so it has to name its colours.
    const QPalette paper = Theme::palette(Theme::Kind::Light);
    m_content->setStyleSheet(
        isPrinted ? QStringLiteral("QWidget { background: %1; color: %2; } "
                                   "QCheckBox::indicator { width: 0px; height: 0px; }")
                        .arg(paper.color(QPalette::Base).name(), paper.color(QPalette::WindowText).name())
                  : QString());
}

/// Places the key beside the plot, or below it if it would take too much width and there is height to spare.
void ChartKey::placeIn(QBoxLayout &row, const QSize &size)
{
    int widest = 0;
    for (const QCheckBox *box : m_boxes)
        widest = std::max(widest, box->sizeHint().width() + 26);
    const int heightBelow = std::min(76, 8 + 24 * int(m_boxes.size()));
    const bool isNarrow = 3 * widest > size.width(), isVeryNarrow = 2 * widest > size.width();
    const bool isBelow = (isNarrow && size.height() > 4 * 76) || (isVeryNarrow && size.height() > 90 + 2 * heightBelow);
    row.setDirection(isBelow ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
    setMinimumSize(isBelow ? 0 : widest, isBelow ? heightBelow : 0);
    setMaximumSize(isBelow ? QWIDGETSIZE_MAX : widest, isBelow ? heightBelow : QWIDGETSIZE_MAX);
    const bool isNameless = m_boxes.size() == 1 && m_boxes.front()->text().isEmpty(); // the only one
    constexpr int leastBeside = 170; // px: curves take precedence over their names, which the read-out also gives
    const bool hasRoom = isBelow || size.width() - widest >= leastBeside;
    setVisible(!m_boxes.empty() && !isNameless && hasRoom);
}

} // namespace faintline
