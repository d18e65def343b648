#pragma once

#include <QObject>
#include <QPointer>

#include <vector>

class QWidget;

namespace faintline {

class ThemedPlot;

/// Plots above each other on one time axis, which runs from left to right: their canvases have the same left and right
/// edges, whatever the widths of their labels, and only the lowest visible one labels the axis.
///
/// Plots in another window, where a single view is drawn, are aligned with each other only. Switched off, each plot is
/// laid out by itself.
class TimeStack : public QObject
{
    Q_OBJECT

public:
    explicit TimeStack(QObject *parent = nullptr);

    /// Adds a plot below the others. `pane`: the plot, or the widget that contains it; all panes have the same width.
    void add(ThemedPlot &plot, QWidget &pane);
    void setOn(bool isOn);
    bool isOn() const { return m_isOn; }

    /// Aligns the plots now, which otherwise follows changes of layout before the next painting.
    void align();

    /// While it exists, the plots within a widget are laid out as if the others did not exist: for a picture of it.
    class Part
    {
    public:
        Part(TimeStack &stack, const QWidget &widget);
        ~Part();
        Part(const Part &) = delete;
        Part &operator=(const Part &) = delete;

    private:
        TimeStack &m_stack;
    };

protected:
    bool eventFilter(QObject *watched, QEvent *event) override; ///< changes of layout

private:
    struct Member {
        QPointer<ThemedPlot> plot;
        QPointer<QWidget> pane;
    };
    using Members = std::vector<const Member *>;

    std::vector<Members> groups() const;
    void alignGroup(const Members &members);
    void release();
    void schedule();

    std::vector<Member> m_members; ///< from top to bottom
    QPointer<const QWidget> m_part;
    bool m_isOn = false;
    bool m_isAligning = false;
    bool m_isScheduled = false;
};

} // namespace faintline
