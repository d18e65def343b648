#pragma once

#include <QByteArray>
#include <QList>
#include <QObject>
#include <QStringList>

#include <vector>

class QAction;
class QDockWidget;
class QMainWindow;
class QWidget;

namespace faintline {

/// The docks of a window and where they stand.
class Panels : public QObject
{
    Q_OBJECT

public:
    /// Where a panel stands at first. Panels in one place are tabs, the first one in front; those at the bottom are out
    /// of sight until they are asked for, because the pictures need the room.
    enum class Place { Left, RightTop, RightBottom, Bottom };

    explicit Panels(QMainWindow &window);

    void add(const QString &name, const QString &title, QWidget *panel, Place place);
    /// What stands now is the default layout: call it once all panels are there.
    void rememberDefault();

    void show(QWidget *panel); ///< brings it to the front
    void hide();               ///< all of them
    QList<QAction *> toggleActions() const;

    /// Arrangements for what one is about, by name; the first is the default.
    static QStringList layoutNames();
    void takeLayout(const QString &name);

    /// While they come and go together; what one of them does then is no wish of the user's.
    bool isRearranging() const { return m_isRearranging; }

    /// Qt leaves bars without tabs in sight, and at times in front of others, whose clicks they take.
    bool eventFilter(QObject *watched, QEvent *event) override;

public slots:
    void takeDefault();
    /// The pictures and nothing else, over the whole screen.
    void setPresenting(bool isPresenting);

private:
    struct Entry {
        QDockWidget *dock;
        Place place;
    };

    QDockWidget *dock(const QString &name) const;
    void raiseFromBottom(QDockWidget *dock, int percent);
    QDockWidget *first(Place place) const;
    QDockWidget *last(Place place) const;

    QMainWindow &m_window;
    std::vector<Entry> m_entries;
    QByteArray m_default;
    QByteArray m_beforePresenting;
    bool m_isRearranging = false;
};

} // namespace faintline
