#pragma once

#include "app/lessons/LessonCondition.h"
#include "plan/AnalysisSettings.h"
#include "widgets/base/Span.h"

#include <QString>
#include <QStringList>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace faintline {

/// A question to answer before the explanation is shown.
struct LessonQuestion {
    QString text;
    QStringList choices;
    int answer = 0;
    QString why; ///< shown once a choice is made
};

/// One page of a lesson: the state of the window, the text, and the learner's task.
struct LessonStep {
    QString title;
    QString text;

    QString open; ///< scenario or recording; empty: that of the previous step
    std::string preset;
    /// In addition to those of the steps since a source was opened.
    std::vector<std::pair<std::string, FieldValue>> settings;
    QString experiment; ///< run and shown; empty: none
    QStringList show;   ///< views brought to the front
    std::optional<Span> zoomSeconds, zoomHz;
    bool showsAll = false;
    std::optional<double> cursorSeconds, cursorHz, cursorRange, cursorBearing;
    QString point;         ///< part to highlight: a view, or "setting NAME"
    LessonCondition facts; ///< hold once the window has settled

    std::optional<LessonQuestion> question;
    QString task;          ///< what the learner should do
    LessonCondition until; ///< completes the task
    QString then;          ///< text shown then
    LessonCondition thenFacts;
};

/// A lesson drives the real window, step by step. Its JSON form is:
///
///     { "title": "…", "sentence": "…", "steps": [
///         { "title": "…", "text": "…", "open": "scene.json", "preset": "sonar", "settings": {"detector.kind": "pOfN"},
///           "experiment": "pd.json", "show": ["why"], "zoom": {"seconds": [10, 30], "hz": [100, 200]} or "all",
///           "cursor": {"seconds": 20, "hz": 150}, "point": "output", "facts": {"events": 1},
///           "ask": {"question": "…", "choices": ["…", "…"], "answer": 1, "why": "…"},
///           "do": "…", "until": {"threshold": [null, 12]}, "then": "…", "thenFacts": {"events": [2, null]} } ] }
///
/// A condition names measures: a number, a pair of bounds of which one may be null, or a word. Paths are relative to
/// the lesson's file.
struct Lesson {
    QString path;
    QString title;
    QString sentence; ///< what the lesson teaches
    std::vector<LessonStep> steps;
};

/// The step that opened what the given step shows.
int openingStep(const Lesson &lesson, int step);
/// From that step up to the given one.
std::vector<LessonStep> stepsSinceOpening(const Lesson &lesson, int step);
/// The settings that these steps make of those of a source just opened.
AnalysisSettings settingsAfter(const std::vector<LessonStep> &steps, AnalysisSettings settings);

/// Throws Error that names the key.
Lesson lessonFromJson(const std::string &text, const QString &path);
Lesson readLesson(const QString &path);

/// Whether a path names a lesson: JSON with steps. False if it cannot be read.
bool isLesson(const QString &path);

/// The bundled lessons, in didactic order.
const std::vector<Lesson> &lessons();

} // namespace faintline
