#pragma once

#include "detect/Sprt.h"
#include "widgets/plot/MarkedPlot.h"

#include <optional>
#include <vector>

namespace faintline {

class CurveKey;

/// ln Λ of sequential tests from 0 to one of the two boundaries: many runs drawn faintly, one highlighted, a colour for
/// each hypothesis, decisions marked, wrong ones ringed.
///
/// A click on a walk, or Up and Down, select another run.
class WalkPlot : public MarkedPlot
{
    Q_OBJECT

public:
    struct Walk {
        std::vector<double> lnLambda; ///< after stage 1, 2, …
        SprtDecision decision = SprtDecision::Undecided;
        std::optional<bool> hasTarget; ///< nothing: unknown, as in a recording
        bool isForced = false;         ///< at the cut-off stage
    };

    explicit WalkPlot(QWidget *parent = nullptr);

    /// Boundaries of the walks, and the number of stages of a test of fixed size, if known.
    void setTest(const SprtSettings &settings, std::optional<Index> fixedSize);
    void setWalks(std::vector<Walk> walks);
    const std::vector<Walk> &walks() const { return m_walks; }
    void setSelected(int walk); ///< -1: none
    int selected() const { return m_selected; }

    /// Canvas position of a walk after a stage (1, 2, …) as drawn, limited to the canvas.
    QPointF position(int walk, Index stage) const;

signals:
    void walkActivated(int walk);

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void restyle() override;
    void clicked(const QPointF &canvas) override;

private:
    class WalkItem;
    void layOut();

    SprtSettings m_settings;
    std::optional<Index> m_fixedSize;
    std::vector<Walk> m_walks;
    int m_selected = -1;
    WalkItem *m_item;
    CurveKey *m_key;
};

} // namespace faintline
