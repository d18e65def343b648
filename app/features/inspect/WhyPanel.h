#pragma once

#include "app/base/Inquiry.h"
#include "inspect/advice.h"
#include "inspect/explain.h"
#include "inspect/familyTeeth.h"

#include <QWidget>

class QLabel;
class QPushButton;

namespace faintline {

class ChartPlot;
class ColumnTable;
class Document;
class PingViewports;

/// Explains why the cell under the cursor, in a line's frame or a ping, was or was not detected: the best path that
/// ends there, step by step, with terms that add up to the displayed statistic, the margin of each step, and the reason
/// for the path's beginning; for a family, the contribution of each member; and what would find a signal that was not
/// detected. Repeats the chain on a worker while visible; the newest cursor wins.
class WhyPanel : public QWidget
{
    Q_OBJECT

public:
    WhyPanel(Document &document, const PingViewports &viewports, QWidget *parent = nullptr);

    /// Null: none, or not yet of this cursor.
    const Explanation *explanation() const
    {
        return m_why.answer() && !m_why.isRunning() ? &m_why.answer()->explanation : nullptr;
    }
    /// Carries the remedy of a cell that was not detected.
    QPushButton *remedy() const { return m_remedy; }
    /// One row for each member of a family; hidden without one.
    ChartPlot &plot() { return *m_plot; }

    QSize sizeHint() const override { return {360, 420}; }

signals:
    void remedyRequested(const faintline::Advice &advice);

protected:
    /// If there is little height, the path breakdown takes precedence.
    void resizeEvent(QResizeEvent *event) override;

private:
    struct Reason {
        Explanation explanation;
        std::vector<FamilyTooth> teeth;
        std::optional<Advice> advice;
    };
    /// Seconds, and the position in the frame.
    using Asking = Inquiry<Reason, std::shared_ptr<const Analysis>, double, std::vector<double>>;

    Asking::Question question() const;
    void show();
    void showCure(const std::optional<Advice> &advice);
    void showTeeth(const std::vector<FamilyTooth> &teeth, const FamilySettings &family);
    void buildTables();

    Document &m_document;
    const PingViewports &m_viewports;
    QLabel *m_sentence;
    QLabel *m_cure;        ///< hidden without one
    QPushButton *m_remedy; ///< of the cure
    ChartPlot *m_plot;
    ColumnTable *m_teeth;
    ColumnTable *m_ladder;
    Asking m_why;
};

/// The explanation in words: detected or not, by what margin, since when, and the sum of the terms.
QString whySentence(const Explanation &explanation, const Analysis &analysis);

/// Number of family members that raise the evidence, and those that do not.
QString teethSentence(const std::vector<FamilyTooth> &teeth, const FamilySettings &family);

} // namespace faintline
