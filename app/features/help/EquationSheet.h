#pragma once

#include "app/features/help/equations.h"

#include <QFrame>
#include <QPointer>

class QLabel;

namespace faintline {

/// The equation of a view: a small sheet over a corner of the view, with symbols and source. It stays while the user
/// continues to work; Escape, its button or the key that opened it close it.
class EquationSheet : public QFrame
{
    Q_OBJECT

public:
    explicit EquationSheet(QWidget *window);

    /// Shows the equation over a view; closes the sheet if it is open.
    void toggle(const Equation *equation, QWidget *view);
    QString text() const;

protected:
    bool event(QEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;

private:
    void close();

    QLabel *m_title;
    QLabel *m_equation;
    QLabel *m_symbols;
    QLabel *m_source;
    QString m_view; ///< name of its view
    QPointer<QWidget> m_previousFocus;
};

} // namespace faintline
