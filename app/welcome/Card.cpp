#include "app/welcome/Card.h"

#include "widgets/base/Theme.h"

#include <QLabel>
#include <QLayout>
#include <QPainter>

namespace faintline {

Card::Card(const QString &title, const QString &sentence, QWidget *parent) : QAbstractButton(parent)
{
    setText(title);
    setAccessibleDescription(sentence);
    setCursor(Qt::PointingHandCursor);
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::MinimumExpanding);
    setAttribute(Qt::WA_Hover);
}

QLabel *Card::caption(const QString &text, const QFont &font)
{
    auto *label = new QLabel(text);
    label->setFont(font);
    label->setWordWrap(true);
    label->setAttribute(Qt::WA_TransparentForMouseEvents);
    return label;
}

QSize Card::sizeHint() const
{
    return {320, layout()->sizeHint().height()};
}

void Card::paintEvent(QPaintEvent *)
{
    const Theme::Colours &colours = Theme::colours(*this);
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool isLit = hasFocus() || underMouse();
    painter.setPen(QPen(isLit ? colours.accent : colours.frame, isLit ? 2.0 : 1.0));
    painter.setBrush(palette().color(QPalette::Base));
    painter.drawRoundedRect(QRectF(rect()).adjusted(1.0, 1.0, -1.0, -1.0), 6.0, 6.0);
}

} // namespace faintline
