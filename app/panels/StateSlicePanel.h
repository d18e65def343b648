#pragma once

#include "app/base/JobRunner.h"
#include "app/document/Document.h"
#include "app/panels/StateCut.h"

#include <QWidget>

class QBoxLayout;
class QComboBox;
class QLabel;
class QLayout;
class QTabBar;

namespace faintline {

class LawPanel;
class VisibilityWatcher;
class SliceMarks;
class WaterfallView;

/// A slice through the states of the frame under the cursor, and the law by which they follow each other beside it.
///
/// Of lines: frequency × slope, the frequencies those that the waterfalls show. Of pings: any two of range, bearing and
/// their rates, the others at the cursor (the best rates of its cell) or the best of them all. The best state in view
/// and those of the tracks' paths are marked. It is computed while the panel can be seen, by going through the run
/// again.
class StateSlicePanel : public QWidget
{
    Q_OBJECT

public:
    StateSlicePanel(Document &document, PingViewports &viewports, QWidget *parent = nullptr);
    ~StateSlicePanel() override;

    WaterfallView *view() const { return m_view; }
    QTabBar *tabs() const { return m_tabs; }
    LawPanel &law() const { return *m_law; }
    const SliceMarks &marks() const { return *m_marks; }
    QString sentence() const;
    bool isBusy() const { return m_runner.isRunning(); }

    /// Numbers of the axes of `stateAxes`.
    void setAxes(int rows, int columns);
    void setMaximised(bool isMaximised); ///< over the other axes
    bool isMaximised() const;

    QSize sizeHint() const override { return {420, 420}; }
    /// Of picture or law, one behind the other: what stands beside what follows from the room, and must not keep it.
    QSize minimumSizeHint() const override { return {220, 200}; }

signals:
    /// The law of a rate's change was dragged to another shape.
    void lawRequested(const QString &field, const std::vector<double> &law);
    void settled(); ///< the slice belongs to the cursor, or there was a failure

protected:
    /// The law stands beside the slice where there is width, below where there is height, otherwise behind a tab.
    void resizeEvent(QResizeEvent *event) override;

private:
    QLayout *buildHead();
    void buildView();
    void connectChoices();
    void connectDocument();
    bool isOfLines() const;
    bool hasChoice() const; ///< of axes
    std::optional<StateCut::Wanted> wanted() const;
    void takeFrequencies();
    void giveFrequencies();
    void placeMarks();
    QString words(const StateCut &cut) const;
    void chooseRange();
    void layOut();
    void fillAxes();
    void chooseAxes(QComboBox &changed, QComboBox &other);
    void update();
    void followCursor();
    void showSpans(const StateCut &cut, const Viewport::Point &cursor);
    void show(const StateCut &cut);

    Document &m_document;
    PingViewports &m_viewports;
    QComboBox *m_rows;
    QComboBox *m_columns;
    QComboBox *m_others;
    QComboBox *m_model;               ///< of a bank
    std::vector<QWidget *> m_choices; ///< that only pings leave
    QLabel *m_sentence;
    WaterfallView *m_view;
    QTabBar *m_tabs;
    QWidget *m_pane; ///< the slice and its colour bar
    LawPanel *m_law;
    VisibilityWatcher *m_sight;
    QBoxLayout *m_body;
    std::unique_ptr<SliceMarks> m_marks;
    std::optional<StateCut> m_cut; ///< the one shown
    Viewport m_viewport;
    std::pair<std::size_t, std::size_t> m_shownAxes{0, 0};
    Span m_givenRange;                     ///< of the colours, as this panel set it
    bool m_isShowing = false;              ///< the slice's own cursor is being placed
    std::shared_ptr<StateReplay> m_replay; ///< touched by jobs only, one at a time
    JobRunner m_runner;                    ///< last, so that its jobs end first
};

} // namespace faintline
