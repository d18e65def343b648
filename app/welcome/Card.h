#pragma once

#include <QAbstractButton>

class QLabel;

namespace faintline {

/// A big button of the welcome page: a frame that lights up, with pictures and words in it that leave the mouse to it.
class Card : public QAbstractButton
{
    Q_OBJECT

public:
    /// `sentence`: what is to be seen in it, for screen readers.
    Card(const QString &title, const QString &sentence, QWidget *parent = nullptr);

    QSize sizeHint() const override;

protected:
    static QLabel *caption(const QString &text, const QFont &font);

    void paintEvent(QPaintEvent *event) override;
};

} // namespace faintline
