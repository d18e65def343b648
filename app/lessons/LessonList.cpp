#include "app/lessons/LessonList.h"

#include "app/lessons/Lesson.h"
#include "widgets/base/Theme.h"

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>

namespace faintline {

namespace {

    constexpr int columns = 3;

} // namespace

LessonList::LessonList(QWidget *parent) : QWidget(parent)
{
    auto *grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(16);
    grid->setVerticalSpacing(2);
    auto *title = new QLabel(tr("Lessons"));
    title->setFont(Theme::boldFont(14));
    grid->addWidget(title, 0, 0, 1, columns);
    int number = 0;
    for (const Lesson &lesson : lessons()) {
        auto *button = new QPushButton;
        button->setFlat(true);
        button->setStyleSheet(QStringLiteral("text-align: left; padding: 3px 0px;"));
        button->setCursor(Qt::PointingHandCursor);
        button->setToolTip(lesson.sentence);
        button->setAccessibleDescription(lesson.sentence);
        connect(button, &QPushButton::clicked, this, [this, number] { emit chosen(number); });
        m_buttons.push_back(button);
        grid->addWidget(button, 1 + number / columns, number % columns, Qt::AlignLeft);
        ++number;
    }
    for (int column = 0; column < columns; ++column)
        grid->setColumnStretch(column, 1);
    setDone({});
}

void LessonList::setDone(const QStringList &paths)
{
    for (std::size_t i = 0; i < m_buttons.size(); ++i) {
        const Lesson &lesson = lessons()[i];
        const bool isDone = paths.contains(lesson.path);
        m_buttons[i]->setText(tr("%1  %2").arg(isDone ? QStringLiteral("✓") : QString::number(i + 1), lesson.title));
    }
}

} // namespace faintline
