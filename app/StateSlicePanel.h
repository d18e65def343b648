#pragma once

#include "analysis/StateReplay.h"
#include "app/Document.h"
#include "app/JobRunner.h"
#include "widgets/PingViewports.h"
#include "widgets/Viewport.h"

#include <QWidget>

class QComboBox;
class QLabel;

namespace faintline {

class WaterfallView;

/// A slice through the states of the ping under the cursor: any two of range, bearing and their rates, the others at the cursor (the
/// best rates of its cell) or the best of them all. It is computed while the panel can be seen, by going through the run again.
class StateSlicePanel : public QWidget
{
    Q_OBJECT

public:
    StateSlicePanel(const Document &document, PingViewports &viewports, QWidget *parent = nullptr);

    WaterfallView *view() const { return m_view; }
    QString sentence() const;
    bool isBusy() const { return m_runner.isRunning(); }

    /// Numbers of the axes of `stateAxes`.
    void setAxes(int rows, int columns);
    void setMaximised(bool isMaximised); ///< over the other axes
    bool isMaximised() const;

    QSize sizeHint() const override { return {420, 420}; }

signals:
    void settled(); ///< the slice belongs to the cursor, or there was a failure

protected:
    void showEvent(QShowEvent *event) override;

private:
    struct Cut {
        StateSlice slice;
        std::vector<Axis> axes;
        std::shared_ptr<const PeakPyramid> picture;
        std::vector<double> values; ///< of the cursor's state, one per axis
        double best = 0.0;
    };

    void fillAxes();
    void chooseAxes(QComboBox &changed, QComboBox &other);
    void update();
    void followCursor();
    void show(const Cut &cut);

    const Document &m_document;
    PingViewports &m_viewports;
    QComboBox *m_rows;
    QComboBox *m_columns;
    QComboBox *m_others;
    QComboBox *m_model; ///< of a bank
    QLabel *m_sentence;
    WaterfallView *m_view;
    Viewport m_viewport;
    std::pair<std::size_t, std::size_t> m_shownAxes{0, 0};
    Span m_givenRange; ///< of the colours, as this panel set it
    bool m_isShowing = false; ///< the slice's own cursor is being placed
    std::shared_ptr<StateReplay> m_replay; ///< touched by jobs only, one at a time
    JobRunner m_runner;                    ///< last, so that its jobs end first
};

} // namespace faintline
