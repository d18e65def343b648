#pragma once

#include <QWidget>

namespace faintline {

/// A list of the lessons to choose from, by subject.
class LessonList : public QWidget
{
    Q_OBJECT

public:
    explicit LessonList(QWidget *parent = nullptr);

signals:
    void chosen(int lesson); ///< its number in `lessons()`
};

} // namespace faintline
