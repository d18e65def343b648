#include "app/features/help/EquationSheet.h"

#include "widgets/base/Theme.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

namespace {

    constexpr int margin = 14;

    QLabel *words(const QFont &font)
    {
        auto *label = new QLabel;
        label->setTextFormat(Qt::PlainText);
        label->setFont(font);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
        label->setFocusPolicy(Qt::NoFocus);
        return label;
    }

} // namespace

EquationSheet::EquationSheet(QWidget *window)
    : QFrame(window), m_title(words(Theme::boldFont(14))), m_equation(words(Theme::font(16))),
      m_symbols(words(Theme::font())), m_source(words(Theme::font(12)))
{
    setObjectName(QStringLiteral("equationSheet"));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    setFocusPolicy(Qt::StrongFocus);
    m_source->setForegroundRole(QPalette::PlaceholderText);
    auto *leave = new QToolButton;
    leave->setText(QStringLiteral("×"));
    leave->setAutoRaise(true);
    leave->setAccessibleName(tr("Close the equation"));
    connect(leave, &QToolButton::clicked, this, &EquationSheet::close);
    auto *top = new QHBoxLayout;
    top->addWidget(m_title, 1);
    top->addWidget(leave);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(margin, 8, 8, margin);
    layout->setSpacing(8);
    layout->addLayout(top);
    layout->addWidget(m_equation);
    layout->addWidget(m_symbols);
    layout->addWidget(m_source);
    hide();
}

void EquationSheet::toggle(const Equation *equation, QWidget *view)
{
    if (isVisible() && (!equation || equation->view == m_view))
        return close();
    if (!equation || !view)
        return;
    m_view = equation->view;
    m_title->setText(equation->title);
    m_equation->setText(equation->equation);
    m_symbols->setText(equation->symbols);
    m_source->setText(tr("Source: %1").arg(equation->source));
    setAccessibleName(equation->title);
    setAccessibleDescription(equation->equation);
    adjustSize();
    const QPoint corner = view->mapTo(parentWidget(), QPoint(margin, margin));
    move(std::clamp(corner.x(), 0, std::max(0, parentWidget()->width() - width())),
         std::clamp(corner.y(), 0, std::max(0, parentWidget()->height() - height())));
    if (!isVisible())
        m_previousFocus = QApplication::focusWidget();
    show();
    raise();
    setFocus();
}

QString EquationSheet::text() const
{
    return QStringList{m_title->text(), m_equation->text(), m_symbols->text(), m_source->text()}.join(
        QLatin1Char('\n'));
}

void EquationSheet::close()
{
    hide();
    if (m_previousFocus)
        m_previousFocus->setFocus();
}

bool EquationSheet::event(QEvent *event)
{
    if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent *>(event)->key() == Qt::Key_Escape)
        event->accept(); // closes the sheet rather than cancelling the run
    return QFrame::event(event);
}

void EquationSheet::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_Escape)
        return close();
    QFrame::keyPressEvent(event);
}

} // namespace faintline
