#pragma once

#include "analysis/AnalysisSettings.h"
#include "app/lessons/LessonCondition.h"
#include "widgets/base/Span.h"

#include <QString>
#include <QStringList>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace faintline {

/// A question to be answered before the answer is seen: predict, then reveal.
struct LessonQuestion {
    QString text;
    QStringList choices;
    int answer = 0;
    QString why; ///< said once a choice is made
};

/// One page of a lesson: what the window does, what is said about it, and what the learner does then.
struct LessonStep {
    QString title;
    QString text;

    QString open; ///< scenario or recording; empty: what the step before had
    std::string preset;
    /// On top of those of the steps since something was opened.
    std::vector<std::pair<std::string, FieldValue>> settings;
    QStringList show; ///< views brought to the front
    std::optional<Span> zoomSeconds, zoomHz;
    bool showsAll = false;
    std::optional<double> cursorSeconds, cursorHz, cursorRange, cursorBearing;
    QString point;         ///< what is framed: a view, or "setting NAME"
    LessonCondition facts; ///< hold once the window has settled

    std::optional<LessonQuestion> question;
    QString task;          ///< what the learner is asked to do
    LessonCondition until; ///< when that is done
    QString then;          ///< said about what is to be seen then
    LessonCondition thenFacts;
};

/// A lesson drives the real window, step by step. Written as JSON:
///
///     { "title": "…", "sentence": "…", "steps": [
///         { "title": "…", "text": "…", "open": "scene.json", "preset": "sonar", "settings": {"detector.kind": "pOfN"},
///           "show": ["why"], "zoom": {"seconds": [10, 30], "hz": [100, 200]} or "all",
///           "cursor": {"seconds": 20, "hz": 150}, "point": "output", "facts": {"events": 1},
///           "ask": {"question": "…", "choices": ["…", "…"], "answer": 1, "why": "…"},
///           "do": "…", "until": {"threshold": [null, 12]}, "then": "…", "thenFacts": {"events": [2, null]} } ] }
///
/// A condition names measures: a number, a pair of bounds of which one may be null, or a word. Paths are relative to
/// the lesson's own.
struct Lesson {
    QString path;
    QString title;
    QString sentence; ///< what one will know afterwards
    std::vector<LessonStep> steps;
};

/// Throws Error that names the key.
Lesson lessonFromJson(const std::string &text, const QString &path);
Lesson readLesson(const QString &path);

/// Whether a path names a lesson: JSON that has steps. What cannot be read is none.
bool isLesson(const QString &path);

/// The lessons that come with the program, in the order in which they build upon each other.
const std::vector<Lesson> &lessons();

} // namespace faintline
