#pragma once

#include "app/base/Inquiry.h"
#include "app/base/Panel.h"
#include "app/document/Document.h"
#include "app/features/inspect/StateCut.h"

class QBoxLayout;
class QComboBox;
class QLabel;
class QLayout;
class QTabBar;

namespace faintline {

class LawPanel;
class OutputLayers;
class SliceMarks;
class WaterfallView;

/// A slice through the states of the frame under the cursor, and their transition law beside it.
///
/// For lines: frequency × slope, with the frequencies visible in the waterfalls. For pings: any two of range, bearing
/// and their rates; the others are at the cursor (with the best rates of its cell) or maximised. The best visible state
/// and the states of the tracks' paths are marked. Computed while visible, by repeating the run.
class StateSlicePanel : public Panel
{
    Q_OBJECT

public:
    StateSlicePanel(Document &document, OutputLayers &layers, PingViewports &viewports, QWidget *parent = nullptr);

    WaterfallView *view() const { return m_view; }
    LawPanel &law() const { return *m_law; }

    /// Indices of the axes in `stateAxes`.
    void setAxes(int rows, int columns);
    void setMaximised(bool isMaximised); ///< over the other axes
    bool isMaximised() const;

    void setSeen(bool isSeen) override;

    QSize sizeHint() const override { return {420, 420}; }
    /// Size of picture or law alone: the layout depends on the available room and must not constrain it.
    QSize minimumSizeHint() const override { return {220, 200}; }

signals:
    /// The law of a rate's change was dragged.
    void lawRequested(const QString &field, const std::vector<double> &law);

protected:
    /// Places the law beside the slice, below it, or behind a tab, depending on the available room.
    void resizeEvent(QResizeEvent *event) override;

private:
    using Asking = Inquiry<StateCut, std::shared_ptr<const Analysis>, StateCut::Wanted>;

    QLayout *buildHead();
    void buildView();
    void connectChoices();
    void connectDocument();
    bool isOfLines() const;
    bool hasChoice() const; ///< of axes
    Asking::Question question() const;
    const StateCut *cut() const { return m_cut.answerAbout(m_document.analysis()); } ///< the displayed one
    void takeFrequencies();
    void giveFrequencies();
    void placeMarks();
    QString words(const StateCut &cut) const;
    void chooseRange();
    void layOut();
    void fillAxes();
    void chooseAxes(QComboBox &changed, QComboBox &other);
    void followCursor();
    void showSpans(const StateCut &cut, const Viewport::Point &cursor);
    void show();

    Document &m_document;
    OutputLayers &m_layers; ///< which mark what is seen here
    PingViewports &m_viewports;
    QComboBox *m_rows;
    QComboBox *m_columns;
    QComboBox *m_others;
    QComboBox *m_model;               ///< of a bank
    std::vector<QWidget *> m_choices; ///< for pings only
    QLabel *m_sentence;
    WaterfallView *m_view;
    QTabBar *m_tabs;
    QWidget *m_pane; ///< the slice and its colour bar
    LawPanel *m_law;
    QBoxLayout *m_body;
    SliceMarks *m_marks;
    Viewport m_viewport;
    std::pair<std::size_t, std::size_t> m_shownAxes{0, 0};
    Span m_givenRange;                     ///< colour range as set by this panel
    bool m_isShowing = false;              ///< while the slice's own cursor is being placed
    std::shared_ptr<StateReplay> m_replay; ///< used by jobs only, one at a time
    Asking m_cut;
};

} // namespace faintline
