#pragma once

#include <QObject>

namespace faintline {

/// What the user does in one go: from the press of a key or a mouse button to its release, however often the key
/// repeats and whatever modifiers are pressed meanwhile; the notches of a wheel up to the next press. Ends, too, when
/// the application is left. Watches the events of the application.
class GestureWatcher : public QObject
{
    Q_OBJECT

public:
    explicit GestureWatcher(QObject *parent = nullptr);

signals:
    void began();
    void ended(); ///< after the release has been handled

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void press(int what);
    void release(int what);
    void begin();
    void endLater();

    int m_number = 0;
    int m_down = 0; ///< the key or button that was pressed last, until its release; 0: none
    bool m_isWheel = false;
};

} // namespace faintline
