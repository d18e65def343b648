#pragma once

#include "analysis/explain.h"
#include "analysis/familyTeeth.h"
#include "app/base/JobRunner.h"

#include <QElapsedTimer>
#include <QWidget>

#include <optional>

class QLabel;
class QTableWidget;
class QTimer;

namespace faintline {

class ChartPlot;
class Document;
class PingViewports;
class VisibilityWatcher;

/// Why the cell under the cursor, of a line's frame or of a ping, was detected or was not: the best path that ends
/// there, step by step, with terms that add up to the statistic displayed, how narrowly each step was won, and why the
/// path begins where it does; of a family, what each of its members brought. Goes through the chain again, on a worker,
/// while it is seen; the newest cursor wins.
class WhyPanel : public QWidget
{
    Q_OBJECT

public:
    WhyPanel(Document &document, const PingViewports &viewports, QWidget *parent = nullptr);

    const std::optional<Explanation> &explanation() const { return m_explanation; }
    QString sentence() const;
    QTableWidget *ladder() const { return m_ladder; }
    /// A row for each member of a family; hidden where there is none.
    QTableWidget *teeth() const { return m_teeth; }
    ChartPlot &plot() { return *m_plot; }

    QSize sizeHint() const override { return {360, 420}; }

signals:
    void settled(); ///< the ladder belongs to the cursor, or the sentence says why there is none

protected:
    /// Where there is little height the ladder comes first.
    void resizeEvent(QResizeEvent *event) override;

private:
    void follow();
    void explainCursor();
    void show(const Explanation &explanation, const std::vector<FamilyTooth> &teeth, const Analysis &analysis);
    void showTeeth(const std::vector<FamilyTooth> &teeth, const FamilySettings &family);
    void buildTables();

    void layColumns(const Analysis &analysis);
    void say(const QString &sentence);

    Document &m_document;
    const PingViewports &m_viewports;
    std::optional<Explanation> m_explanation;
    QLabel *m_sentence;
    ChartPlot *m_plot;
    QTableWidget *m_teeth;
    QTableWidget *m_ladder;
    VisibilityWatcher *m_sight;
    QTimer *m_pause; ///< a cursor on its way is not asked about
    QElapsedTimer m_began;
    JobRunner m_runner; ///< last, so that its jobs end first
};

/// The explanation in words: detected or not, by how much, since when, and what the terms amount to.
QString whySentence(const Explanation &explanation, const Analysis &analysis);

/// How many members of a family raise the evidence, and which do not.
QString teethSentence(const std::vector<FamilyTooth> &teeth, const FamilySettings &family);

} // namespace faintline
