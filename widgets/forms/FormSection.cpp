#include "widgets/forms/FormSection.h"

#include "widgets/base/Theme.h"

#include <QToolButton>
#include <QVBoxLayout>

namespace faintline {

namespace {

    QToolButton *foldButton(const QString &text, const QFont &font, bool isOpen)
    {
        auto *button = new QToolButton;
        button->setText(text);
        button->setFont(font);
        button->setAutoRaise(true);
        button->setCheckable(true);
        button->setChecked(isOpen);
        button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
        button->setArrowType(isOpen ? Qt::DownArrow : Qt::RightArrow);
        button->setIconSize({9, 9});
        button->setFocusPolicy(Qt::TabFocus);
        button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        return button;
    }

    QVBoxLayout *rowLayout(QWidget *body)
    {
        auto *layout = new QVBoxLayout(body);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setSpacing(5);
        return layout;
    }

} // namespace

FormSection::FormSection(const QString &heading, QWidget *parent)
    : QWidget(parent), m_heading(foldButton(heading, Theme::boldFont(), true)),
      m_more(foldButton(tr("More"), Theme::font(12), false)), m_body(new QWidget), m_moreBody(new QWidget),
      m_rows(rowLayout(m_body)), m_moreRows(rowLayout(m_moreBody))
{
    m_heading->setAccessibleName(tr("Section %1").arg(heading));
    m_more->setAccessibleName(tr("More of %1").arg(heading));
    m_body->layout()->setContentsMargins(8, 2, 4, 8);
    m_rows->addWidget(m_more);
    m_rows->addWidget(m_moreBody);
    m_more->hide();
    m_moreBody->hide();
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_heading);
    layout->addWidget(m_body);
    connect(m_heading, &QToolButton::toggled, this, &FormSection::setOpen);
    connect(m_more, &QToolButton::toggled, this, &FormSection::setMoreOpen);
}

void FormSection::addRow(QWidget *row, bool isAdvanced)
{
    if (!isAdvanced) {
        m_rows->insertWidget(m_rows->count() - 2, row);
        return;
    }
    m_moreRows->addWidget(row);
    m_more->show();
}

void FormSection::offerMore()
{
    bool hasRows = false;
    for (int i = 0; i < m_moreRows->count(); ++i)
        hasRows |= m_moreRows->itemAt(i)->widget() && !m_moreRows->itemAt(i)->widget()->isHidden();
    m_more->setVisible(hasRows);
}

void FormSection::setOpen(bool isOpen)
{
    m_heading->setChecked(isOpen);
    m_heading->setArrowType(isOpen ? Qt::DownArrow : Qt::RightArrow);
    m_body->setVisible(isOpen);
}

void FormSection::setMoreOpen(bool isOpen)
{
    m_more->setChecked(isOpen);
    m_more->setArrowType(isOpen ? Qt::DownArrow : Qt::RightArrow);
    m_moreBody->setVisible(isOpen);
}

void FormSection::reveal(QWidget *row)
{
    setOpen(true);
    if (m_moreBody->isAncestorOf(row)) {
        m_more->show();
        setMoreOpen(true);
    }
}

} // namespace faintline
