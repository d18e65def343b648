#pragma once

#include "widgets/plot/MarkedPlot.h"

#include <cstddef>
#include <vector>

namespace faintline {

/// The law of a rate's change from frame to frame as draggable bars, h(|δ|) over δ = -n … n.
///
/// A bar and its mirror image move together and the others are scaled, so that the sum stays 1 (withProbability); there
/// is one more bar than the law has at either end, at 0. Mouse: drag a bar up or down, Escape cancels. Keys: Left and
/// Right select a bar, Up and Down change it by 0.01, with Shift by 0.1, with Ctrl by 0.001.
class LawPlot : public MarkedPlot
{
    Q_OBJECT

public:
    explicit LawPlot(QWidget *parent = nullptr);

    /// `mostChange`: largest possible change of a rate. Cancels dragging.
    void setLaw(const std::vector<double> &law, int mostChange);
    void setEditable(bool isEditable);

    /// The displayed law; while a bar is dragged, the law that releasing would request.
    const std::vector<double> &law() const { return m_shown; }

    QSize sizeHint() const override { return {240, 170}; }
    QSize minimumSizeHint() const override { return {150, 110}; }

signals:
    void lawDragged(const std::vector<double> &law);   ///< while dragging
    void lawRequested(const std::vector<double> &law); ///< on release, or by key

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void focusInEvent(QFocusEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;
    void restyle() override;

private:
    class BarItem;
    int reach() const; ///< largest change that has a bar
    void select(int change);
    void drag(double y);
    void drop(bool isWanted);
    void layOut();

    std::vector<double> m_law{1.0};
    std::vector<double> m_shown{1.0};
    int m_mostChange = 0;
    int m_selected = 0;  ///< the change whose bar responds to keys
    double m_grip = 0.0; ///< height of a dragged bar minus the pointer's
    bool m_isDragging = false;
    bool m_isEditable = true;
    BarItem *m_item;
};

} // namespace faintline
