#include "app/lessons/Lesson.h"

#include "app/base/filePath.h"
#include "app/lessons/lessonMeasures.h"
#include "app/views/WindowViews.h"
#include "base/Error.h"
#include "base/json.h"
#include "widgets/base/labelText.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>

#include <algorithm>

namespace faintline {

namespace {

    constexpr qint64 largestLesson = 1 << 20;
    constexpr const char *ownLessons[]{"cell",       "p-of-n",    "reset",      "choosing-h", "assumed-snr",
                                       "thresholds", "cfar-loss", "real-noise", "manoeuvre",  "when-to-stop"};

    std::string textOf(const QString &path)
    {
        return readBeginning(path, largestLesson).toStdString();
    }

    const Json *find(const Json &object, const char *key)
    {
        const auto found = object.find(key);
        return found == object.end() ? nullptr : &*found;
    }

    std::string textAt(const Json &object, const char *key, const std::string &where, bool isNeeded = false)
    {
        const Json *value = find(object, key);
        if (!value && !isNeeded)
            return {};
        if (!value || !value->is_string() || value->get<std::string>().empty())
            throw Error(jsonName(where, key), "must be a string");
        return value->get<std::string>();
    }

    /// A text as displayed on the screen.
    QString sentenceAt(const Json &object, const char *key, const std::string &where, bool isNeeded = false)
    {
        return paragraphs(textAt(object, key, where, isNeeded));
    }

    double boundOf(const Json &value, double otherwise, const std::string &where)
    {
        if (value.is_null())
            return otherwise;
        if (!value.is_number())
            throw Error(where, "must be a number, a word, or two bounds, one of which may be null");
        return value.get<double>();
    }

    LessonCondition conditionAt(const Json &object, const char *key, const std::string &where)
    {
        LessonCondition condition;
        const Json *value = find(object, key);
        if (!value)
            return condition;
        const std::string name = jsonName(where, key);
        if (!value->is_object() || value->empty())
            throw Error(name, "must be an object of measures, such as {\"events\": [1, null]}");
        for (const auto &[measure, wanted] : value->items()) {
            LessonCondition::Part part;
            part.measure = measure;
            const std::string at = jsonName(name, measure);
            checkMeasure(measure, at);
            if (wanted.is_string()) {
                part.text = wanted.get<std::string>();
            } else if (wanted.is_array() && wanted.size() == 2) {
                part.low = boundOf(wanted[0], part.low, at);
                part.high = boundOf(wanted[1], part.high, at);
                if (part.low > part.high)
                    throw Error(at, "has its bounds in the wrong order");
            } else {
                if (!wanted.is_number())
                    throw Error(at, "must be a number, a word, or two bounds, one of which may be null");
                part.low = part.high = wanted.get<double>();
            }
            condition.parts.push_back(part);
        }
        return condition;
    }

    std::optional<double> numberAt(const Json &object, const char *key, const std::string &where)
    {
        const Json *value = find(object, key);
        if (!value)
            return {};
        if (!value->is_number())
            throw Error(jsonName(where, key), "must be a number");
        return value->get<double>();
    }

    std::optional<Span> spanAt(const Json &object, const char *key, const std::string &where)
    {
        const Json *value = find(object, key);
        if (!value)
            return {};
        if (!value->is_array() || value->size() != 2 || !(*value)[0].is_number() || !(*value)[1].is_number()
            || (*value)[0].get<double>() >= (*value)[1].get<double>())
            throw Error(jsonName(where, key), "must be two numbers, the smaller one first");
        return Span{(*value)[0].get<double>(), (*value)[1].get<double>()};
    }

    void checkWidget(const QString &name, const std::string &where)
    {
        static const QStringList others{"regulation", "profile", "pipeline", "readout", "roc"};
        if (name.isEmpty() || others.contains(name) || WindowViews::names().contains(name))
            return;
        if (!name.startsWith(QLatin1String("setting ")))
            throw Error(where + " = " + name.toStdString(),
                        "is not a view; choose one of "
                            + (others + WindowViews::names()).join(QStringLiteral(", ")).toStdString()
                            + " or \"setting NAME\"");
        settingField(name.mid(8).toStdString());
    }

    LessonQuestion questionOf(const Json &object, const std::string &where)
    {
        checkKeys(object, where, {"question", "choices", "answer", "why"});
        LessonQuestion question;
        question.text = sentenceAt(object, "question", where, true);
        question.why = sentenceAt(object, "why", where, true);
        const Json *choices = find(object, "choices");
        if (!choices || !choices->is_array() || choices->size() < 2)
            throw Error(jsonName(where, "choices"), "must be a list of at least two strings");
        for (const Json &choice : *choices) {
            if (!choice.is_string())
                throw Error(jsonName(where, "choices"), "must be a list of at least two strings");
            question.choices << paragraphs(choice.get<std::string>());
        }
        const auto answer = numberAt(object, "answer", where).value_or(-1.0);
        question.answer = int(answer);
        if (question.answer != answer || question.answer < 0 || question.answer >= question.choices.size())
            throw Error(jsonName(where, "answer"), "must be the index of a choice, counted from 0");
        return question;
    }

    void readSettings(const Json &object, LessonStep &step, const std::string &where)
    {
        const Json *settings = find(object, "settings");
        if (!settings)
            return;
        if (!settings->is_object())
            throw Error(jsonName(where, "settings"), "must be an object of settings");
        for (const auto &[name, value] : settings->items()) {
            try {
                step.settings.emplace_back(name, fieldValueFromJson(value, settingField(name)));
            } catch (const Error &error) {
                throw Error(jsonName(where, "settings") + "." + error.where(), error.why());
            }
        }
    }

    void readView(const Json &object, LessonStep &step, const std::string &where)
    {
        if (const Json *show = find(object, "show")) {
            if (!show->is_array()
                || !std::all_of(show->begin(), show->end(), [](const Json &one) { return one.is_string(); }))
                throw Error(jsonName(where, "show"), "must be a list of views");
            for (const Json &view : *show) {
                step.show << QString::fromStdString(view.get<std::string>());
                checkWidget(step.show.back(), jsonName(where, "show"));
            }
        }
        if (const Json *zoom = find(object, "zoom")) {
            const std::string name = jsonName(where, "zoom");
            step.showsAll = zoom->is_string() && *zoom == "all";
            if (!step.showsAll) {
                checkKeys(*zoom, name, {"seconds", "hz"});
                step.zoomSeconds = spanAt(*zoom, "seconds", name);
                step.zoomHz = spanAt(*zoom, "hz", name);
            }
        }
        if (const Json *cursor = find(object, "cursor")) {
            const std::string name = jsonName(where, "cursor");
            checkKeys(*cursor, name, {"seconds", "hz", "range", "bearing"});
            step.cursorSeconds = numberAt(*cursor, "seconds", name);
            step.cursorHz = numberAt(*cursor, "hz", name);
            step.cursorRange = numberAt(*cursor, "range", name);
            step.cursorBearing = numberAt(*cursor, "bearing", name);
        }
    }

    /// Relative to the lesson's folder; empty if it is not given.
    QString fileAt(const Json &object, const char *key, const std::string &where, const QDir &folder)
    {
        const std::string file = textAt(object, key, where);
        return file.empty() ? QString() : QDir::cleanPath(folder.filePath(QString::fromStdString(file)));
    }

    LessonStep stepOf(const Json &object, const std::string &where, const QDir &folder)
    {
        checkKeys(object, where,
                  {"title", "text", "open", "preset", "settings", "experiment", "show", "zoom", "cursor", "point",
                   "facts", "ask", "do", "until", "then", "thenFacts"});
        LessonStep step;
        step.title = sentenceAt(object, "title", where, true);
        step.text = sentenceAt(object, "text", where, true);
        step.open = fileAt(object, "open", where, folder);
        step.experiment = fileAt(object, "experiment", where, folder);
        step.preset = textAt(object, "preset", where);
        if (!step.preset.empty())
            preset(step.preset);
        readSettings(object, step, where);
        readView(object, step, where);
        step.point = QString::fromStdString(textAt(object, "point", where));
        checkWidget(step.point, jsonName(where, "point"));
        step.facts = conditionAt(object, "facts", where);
        if (const Json *ask = find(object, "ask"))
            step.question = questionOf(*ask, jsonName(where, "ask"));
        step.task = sentenceAt(object, "do", where);
        step.until = conditionAt(object, "until", where);
        step.then = sentenceAt(object, "then", where);
        step.thenFacts = conditionAt(object, "thenFacts", where);
        if (step.task.isEmpty() != step.until.isEmpty())
            throw Error(where, "a task needs both \"do\" and \"until\"");
        if (step.until.isEmpty() && !(step.then.isEmpty() && step.thenFacts.isEmpty()))
            throw Error(where, "\"then\" and \"thenFacts\" require \"until\", which is missing");
        return step;
    }

} // namespace

int openingStep(const Lesson &lesson, int step)
{
    while (lesson.steps[std::size_t(step)].open.isEmpty())
        --step;
    return step;
}

std::vector<LessonStep> stepsSinceOpening(const Lesson &lesson, int step)
{
    return {lesson.steps.begin() + openingStep(lesson, step), lesson.steps.begin() + step + 1};
}

AnalysisSettings settingsAfter(const std::vector<LessonStep> &steps, AnalysisSettings settings)
{
    for (const LessonStep &step : steps) {
        if (!step.preset.empty())
            settings = preset(step.preset).settings;
        for (const auto &[name, value] : step.settings)
            settingField(name).set(settings, value);
    }
    return settings;
}

Lesson lessonFromJson(const std::string &text, const QString &path)
{
    const Json json = parseJson(text, pathBytes(path));
    try {
        checkKeys(json, {}, {"title", "sentence", "steps"});
        Lesson lesson;
        lesson.path = path;
        lesson.title = sentenceAt(json, "title", {}, true);
        lesson.sentence = sentenceAt(json, "sentence", {}, true);
        const Json *steps = find(json, "steps");
        if (!steps || !steps->is_array() || steps->empty())
            throw Error("steps", "must be a list of steps");
        const QDir folder = QFileInfo(path).dir();
        for (std::size_t i = 0; i < steps->size(); ++i)
            lesson.steps.push_back(stepOf((*steps)[i], "steps[" + std::to_string(i) + "]", folder));
        if (lesson.steps.front().open.isEmpty())
            throw Error("steps[0].open", "is missing: the first step of a lesson must open a source");
        return lesson;
    } catch (const Error &error) {
        throw error.in(pathBytes(path));
    }
}

Lesson readLesson(const QString &path)
{
    return lessonFromJson(textOf(path), path);
}

bool isLesson(const QString &path)
{
    if (!path.endsWith(QLatin1String(".json"), Qt::CaseInsensitive))
        return false;
    try {
        const Json json = parseJson(textOf(path), pathBytes(path));
        return json.is_object() && json.contains("steps");
    } catch (const Error &) {
        return false; // reported when it is opened
    }
}

const std::vector<Lesson> &lessons()
{
    static const std::vector<Lesson> all = [] {
        std::vector<Lesson> list;
        for (const char *name : ownLessons)
            list.push_back(readLesson(QStringLiteral(":/lessons/%1.json").arg(QLatin1String(name))));
        return list;
    }();
    return all;
}

} // namespace faintline
