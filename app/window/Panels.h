#pragma once

#include "app/views/panelList.h"

#include <QByteArray>
#include <QList>
#include <QObject>
#include <QPointer>
#include <QRect>
#include <QStringList>

#include <vector>

class QAction;
class QDockWidget;
class QMainWindow;
class QWidget;

namespace faintline {

/// Docks of a window and their layout.
class Panels : public QObject
{
    Q_OBJECT

public:
    using Place = PanelRow::Place;

    explicit Panels(QMainWindow &window);

    void add(const PanelRow &row, QWidget &panel);
    /// Makes the present layout the default. Call after all panels have been added.
    void rememberDefault();

    /// Height that sheets at the bottom leave to the centre: pictures of 350 pixels, alone or with bars below them.
    static constexpr int leastAlone = 360;
    static constexpr int leastWithBars = 415;
    void setLeastPictures(int height) { m_leastPictures = height; }

    void show(QWidget &panel); ///< shows the panel and raises it
    void hide();               ///< hides all panels
    QList<QAction *> toggleActions() const;

    /// Layouts for particular tasks, by name.
    static QStringList layoutNames();
    static QString analyse();    ///< of a program's first window: settings that matter, events, and why
    static QString researcher(); ///< of pictures that are rendered: all panels that have a place beside the pictures
    void takeLayout(const QString &name);

    /// True while several panels are shown or hidden together; changes of visibility are then not the user's choice.
    bool isRearranging() const { return m_isRearranging; }

    /// Hides tab bars without tabs, which Qt leaves visible and sometimes in front of other widgets, whose clicks they
    /// take.
    bool eventFilter(QObject *watched, QEvent *event) override;

    /// Puts a maximised panel back; returns whether there was one.
    bool restoreMaximised();

public slots:
    void takeDefault();
    /// Gives the window's whole place to the panel that has the focus, otherwise to the one that was opened last or is at
    /// the bottom; or puts it back.
    void toggleMaximised();
    /// Shows only the pictures, in full screen.
    void setPresenting(bool isPresenting);

private:
    struct Entry {
        QDockWidget *dock;
        Place place;
    };

    /// Names focusable container widgets after the panel that contains them.
    void nameHolders();
    QDockWidget *dock(const QString &name) const;
    void raiseFromBottom(QDockWidget *dock, int percent);
    int tabHeight(const QDockWidget &dock) const;
    void bringForward(QDockWidget &dock, bool wasHidden);
    void arrangeColumns(const QSize &size);
    void stackEvents();
    QDockWidget *first(Place place) const;
    QDockWidget *last(Place place) const;

    QMainWindow &m_window;
    std::vector<Entry> m_entries;
    QByteArray m_default;
    QByteArray m_beforePresenting;
    QPointer<QDockWidget> m_maximised;
    QPointer<QDockWidget> m_latest; ///< that was asked for
    QRect m_before;                 ///< place of a maximised panel that floated; invalid: it was docked
    bool m_isRearranging = false;
    int m_leastPictures = leastWithBars;
};

} // namespace faintline
