#pragma once

#include <QWidget>

namespace faintline {

/// The lessons to choose from, by what they teach.
class LessonList : public QWidget
{
    Q_OBJECT

public:
    explicit LessonList(QWidget *parent = nullptr);

signals:
    void chosen(int lesson); ///< its number in `lessons()`
};

} // namespace faintline
