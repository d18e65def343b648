#include "app/base/MessageBar.h"

#include "base/oneLine.h"
#include "widgets/base/Theme.h"
#include "widgets/base/labelText.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QToolButton>

#include <utility>

namespace faintline {

MessageBar::MessageBar(QWidget *parent) : QFrame(parent), m_label(new QLabel), m_actionButton(new QToolButton)
{
    m_label->setWordWrap(true);
    m_label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_label->setTextFormat(Qt::RichText);
    QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Preferred); // no message widens the window
    policy.setHeightForWidth(true);
    m_label->setSizePolicy(policy);
    auto *closeButton = new QToolButton;
    closeButton->setText(tr("Dismiss"));
    closeButton->setAutoRaise(true);

    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(14, 5, 6, 5);
    layout->addWidget(m_label, 1);
    layout->addWidget(m_actionButton);
    layout->addWidget(closeButton);

    connect(closeButton, &QToolButton::clicked, this, &MessageBar::dismiss);
    connect(m_actionButton, &QToolButton::clicked, this, [this] {
        hide();
        if (m_action)
            m_action();
    });
    hide();
}

void MessageBar::showMessage(Kind kind, const QString &where, const QString &why, const QString &actionText,
                             std::function<void()> action)
{
    m_kind = kind;
    const auto shown = [](const QString &text) {
        return QString::fromStdString(oneLine(text.toStdString(), longestMessage));
    };
    const auto fitting = [](const QString &text) { return messageText(text.toStdString()).toHtmlEscaped(); };
    m_label->setText(QStringLiteral("<b>%1:</b> %2").arg(fitting(where), fitting(why)));
    setAccessibleName(shown(where) + QStringLiteral(": ") + shown(why));
    m_action = std::move(action);
    m_actionButton->setText(actionText);
    m_actionButton->setVisible(!actionText.isEmpty());
    show();
    update();
}

QString MessageBar::text() const
{
    return isHidden() ? QString() : accessibleName();
}

void MessageBar::paintEvent(QPaintEvent *)
{
    const Theme::Colours &colours = Theme::colours(*this);
    QPainter painter(this);
    painter.fillRect(rect(), palette().color(QPalette::AlternateBase));
    painter.fillRect(QRect(0, 0, 5, height()), m_kind == Kind::Error ? colours.error : colours.accent);
    painter.fillRect(QRect(0, 0, width(), 1), colours.frame);
}

} // namespace faintline
