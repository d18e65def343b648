#pragma once

#include "app/base/JobRunner.h"
#include "inspect/advice.h"
#include "inspect/explain.h"
#include "inspect/familyTeeth.h"

#include <QElapsedTimer>
#include <QWidget>

#include <optional>

class QLabel;
class QPushButton;
class QTableWidget;
class QTimer;

namespace faintline {

class ChartPlot;
class Document;
class PingViewports;
class VisibilityWatcher;

/// Explains why the cell under the cursor, in a line's frame or a ping, was or was not detected: the best path that
/// ends there, step by step, with terms that add up to the displayed statistic, the margin of each step, and the reason
/// for the path's beginning; for a family, the contribution of each member; and what would find a signal that was not
/// detected. Repeats the chain on a worker while visible; the newest cursor wins.
class WhyPanel : public QWidget
{
    Q_OBJECT

public:
    WhyPanel(Document &document, const PingViewports &viewports, QWidget *parent = nullptr);

    const std::optional<Explanation> &explanation() const { return m_explanation; }
    QString sentence() const;
    /// What would find a signal at a cell that was not detected; its button carries the remedy.
    const std::optional<Advice> &advice() const { return m_advice; }
    QPushButton *remedy() const { return m_remedy; }
    QTableWidget *ladder() const { return m_ladder; }
    /// One row for each member of a family; hidden without one.
    QTableWidget *teeth() const { return m_teeth; }
    ChartPlot &plot() { return *m_plot; }

    QSize sizeHint() const override { return {360, 420}; }

signals:
    void remedyRequested(const faintline::Advice &advice);
    void settled(); ///< the path breakdown matches the cursor, or the sentence gives the reason why there is none

protected:
    /// If there is little height, the path breakdown takes precedence.
    void resizeEvent(QResizeEvent *event) override;

private:
    void follow();
    void explainCursor();
    void invite();
    void show(const Explanation &explanation, const std::vector<FamilyTooth> &teeth, const Analysis &analysis);
    void showCure(const std::optional<Advice> &advice);
    void showTeeth(const std::vector<FamilyTooth> &teeth, const FamilySettings &family);
    void buildTables();

    void layColumns(const Analysis &analysis);
    void say(const QString &sentence);

    Document &m_document;
    const PingViewports &m_viewports;
    std::optional<Explanation> m_explanation;
    QLabel *m_sentence;
    QLabel *m_cure;        ///< hidden without one
    QPushButton *m_remedy; ///< of the cure
    std::optional<Advice> m_advice;
    ChartPlot *m_plot;
    QTableWidget *m_teeth;
    QTableWidget *m_ladder;
    VisibilityWatcher *m_sight;
    QTimer *m_pause; ///< delays while the cursor moves
    QElapsedTimer m_began;
    JobRunner m_runner; ///< last, so that its jobs end first
};

/// The explanation in words: detected or not, by what margin, since when, and the sum of the terms.
QString whySentence(const Explanation &explanation, const Analysis &analysis);

/// Number of family members that raise the evidence, and those that do not.
QString teethSentence(const std::vector<FamilyTooth> &teeth, const FamilySettings &family);

} // namespace faintline
