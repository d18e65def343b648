#pragma once

#include <QObject>

namespace faintline {

/// Detects gestures of the user: from the press of a key or mouse button to its release, regardless of key repetition
/// and modifiers; or wheel notches up to the next press. A gesture also ends when the application loses the focus.
/// Watches the events of the application.
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
    int m_down = 0; ///< key or button pressed last, until its release; 0: none
    bool m_isWheel = false;
};

} // namespace faintline
