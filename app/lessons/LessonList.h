#pragma once

#include <QWidget>

#include <vector>

class QPushButton;

namespace faintline {

/// A list of the lessons to choose from, by subject.
class LessonList : public QWidget
{
    Q_OBJECT

public:
    explicit LessonList(QWidget *parent = nullptr);

    /// Paths of the lessons that were gone through; they are ticked.
    void setDone(const QStringList &paths);

signals:
    void chosen(int lesson); ///< its number in `lessons()`

private:
    std::vector<QPushButton *> m_buttons;
};

} // namespace faintline
