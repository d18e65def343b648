#pragma once

#include <QAbstractButton>

class QLabel;

namespace faintline {

/// Large button of the welcome page: a frame highlighted with the focus or under the mouse; its pictures and labels
/// ignore mouse events.
class Card : public QAbstractButton
{
    Q_OBJECT

public:
    /// `sentence`: description for screen readers.
    Card(const QString &title, const QString &sentence, QWidget *parent = nullptr);

    QSize sizeHint() const override;

protected:
    static QLabel *caption(const QString &text, const QFont &font);

    void paintEvent(QPaintEvent *event) override;
};

} // namespace faintline
