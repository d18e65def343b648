#pragma once

#include "app/lessons/Lesson.h"

#include <QString>

#include <string>
#include <utility>
#include <vector>

namespace faintline {

/// What a learner answered and did, step by step.
struct LessonAnswers {
    struct Step {
        int choice = -1; ///< the first one, made before the explanation was shown; -1: none
        double choiceUnixSeconds = 0.0;
        bool isDone = false; ///< the task
        double doneUnixSeconds = 0.0;
        std::vector<std::pair<std::string, std::string>> measured; ///< measures of the task when it was completed
    };
    std::vector<Step> steps;

    /// Right answers or completed tasks, and how many there are.
    struct Count {
        int reached = 0;
        int all = 0;
    };
    Count questions(const Lesson &lesson) const;
    Count tasks(const Lesson &lesson) const;
};

/// One self-contained HTML page to hand in: each question with the learner's choice, each task with its measures, and
/// times in UTC.
std::string answersHtml(const Lesson &lesson, const LessonAnswers &answers, const QString &learner);

} // namespace faintline
