#pragma once

#include "app/base/Inquiry.h"
#include "app/document/Document.h"
#include "inspect/pathEvidence.h"

#include <QWidget>

class QLabel;
class QPushButton;

namespace faintline {

class ColumnTable;
class HandLine;
class WaterfallView;

/// A line drawn by hand through the input, its evidence, and a comparison with the detector's path in the same frames.
///
/// *Predict, then reveal*: while covered, the statistic, tracks and truth are hidden; the user draws the line and
/// reveals them. Numbers are updated while a vertex is dragged; the newest line wins.
class HandLinePanel : public QWidget
{
    Q_OBJECT

public:
    /// The detector's path with most frames in common with the line, and both in these frames.
    struct Comparison {
        PathEvidence own;      ///< for the whole line
        int track = 0;         ///< 0: no track in these frames
        Index frames = 0;      ///< common frames
        PathEvidence ownThere; ///< for the line in these frames
        PathEvidence detector;
        double meanHz = 0.0; ///< mean distance
    };

    /// The picture in which the line is drawn, and the widgets to cover.
    struct Pictures {
        WaterfallView &input;
        QWidget &statistic;
        QWidget &statisticAlongTime;
    };

    HandLinePanel(Document &document, const Pictures &pictures, QWidget *parent = nullptr);

    HandLine &line() { return *m_line; }

    /// Throws Cancelled.
    static Comparison compare(const std::shared_ptr<const Analysis> &analysis, const std::vector<PolylinePoint> &line,
                              const RunContext &context = {});

    QSize sizeHint() const override { return {320, 300}; }

public slots:
    void setCovered(bool isCovered);

protected:
    void hideEvent(QHideEvent *event) override;

private:
    bool isCovered() const { return m_covers[0] != nullptr; }
    const Comparison *comparison() const { return m_comparison.answer(); } ///< null: none
    using Asking = Inquiry<Comparison, std::shared_ptr<const Analysis>, std::vector<PolylinePoint>>;

    Asking::Question question() const;
    void buildTable();
    void connectInputs();
    void show();
    void showSentence();

    Document &m_document;
    Pictures m_pictures;
    HandLine *m_line;
    QPushButton *m_draw;
    QPushButton *m_cover;
    QPushButton *m_add;
    QPushButton *m_remove;
    QPushButton *m_clear;
    QLabel *m_sentence;
    ColumnTable *m_table;
    QWidget *m_covers[2]{nullptr, nullptr}; ///< over the statistic and its chart
    Asking m_comparison;
};

} // namespace faintline
