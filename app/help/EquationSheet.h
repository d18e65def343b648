#pragma once

#include "app/help/equations.h"

#include <QFrame>
#include <QPointer>

class QLabel;

namespace faintline {

/// The equation beside the view that computes it: a small sheet over a corner of the view, with its symbols and its
/// source. It stays while one goes on; Escape, its button or the key that brought it take it away.
class EquationSheet : public QFrame
{
    Q_OBJECT

public:
    explicit EquationSheet(QWidget *window);

    /// Over this view; what is shown already is taken away.
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
    QString m_view; ///< it is of
    QPointer<QWidget> m_previousFocus;
};

} // namespace faintline
