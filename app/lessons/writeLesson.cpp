#include "app/lessons/writeLesson.h"

#include "app/base/VisibilityWatcher.h"
#include "app/base/filePath.h"
#include "app/features/pictures/Bench.h"
#include "app/lessons/Lesson.h"
#include "app/lessons/lessonMeasures.h"
#include "app/views/WindowParts.h"
#include "app/views/WindowViews.h"
#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "exchange/Session.h"

#include <QDir>
#include <QDockWidget>
#include <QFileInfo>

#include <cmath>

namespace faintline {

namespace {

    bool isAsItIs(const Source &source)
    {
        const OpenOptions &options = source.options;
        return source.injections.empty() && !options.iq && options.rawType.empty();
    }

    /// Whether opening the file gives the source.
    bool holds(const QString &path, const Source &source)
    {
        if (path.startsWith(QLatin1Char(':')) || !fileExists(path) || !isAsItIs(source))
            return false;
        if (!source.isSimulated())
            return true;
        const Source there = sourceAt(path);
        return there.scene == source.scene && there.pings == source.pings;
    }

    QString freeName(const QString &lesson, const QString &ending)
    {
        const QFileInfo file(lesson);
        const QString stem = file.dir().filePath(file.completeBaseName() + QStringLiteral("-scene"));
        QString path = stem + ending;
        for (int number = 2; fileExists(path); ++number)
            path = stem + QStringLiteral("-%1").arg(number) + ending;
        return path;
    }

    /// A file that opens as the document's source; written beside the lesson if there is none.
    QString sourceFile(const Document &document, const QString &lesson)
    {
        const Source &source = document.source();
        if (const QString path = document.sourcePath(); holds(path, source))
            return absolutePath(path);
        if (source.isSimulated() && source.injections.empty()) {
            const QString path = freeName(lesson, QStringLiteral(".json"));
            const Json scene = source.pings ? toJson(*source.pings) : toJson(*source.scene);
            writeTextFile(pathBytes(path), scene.dump(4) + "\n");
            return path;
        }
        const QString path = freeName(lesson, QStringLiteral(".faintline"));
        writeSession(pathBytes(path), {source, {}, firstSettings(document.openedSource())});
        return path;
    }

    Json changedSettings(const AnalysisSettings &from, const AnalysisSettings &to)
    {
        Json changed = Json::object();
        AnalysisSettings reached = from;
        for (const Field<AnalysisSettings> &field : AnalysisSettings::fields()) {
            const auto value = field.get(to);
            if (!value || value == field.get(reached))
                continue;
            changed[field.name] = jsonFromFieldValue(*value);
            field.set(reached, *value);
        }
        return changed;
    }

    /// Those in docks: the pictures in the middle are always there.
    Json shownPanels(WindowParts &window)
    {
        Json names = Json::array();
        for (const WindowView &view : windowViews()) {
            const QWidget *widget = view.widget ? window.views().named(view.name) : nullptr;
            const QWidget *dock = widget;
            while (dock && !qobject_cast<const QDockWidget *>(dock))
                dock = dock->parentWidget();
            if (dock && isInSight(*widget))
                names.push_back(view.name.toStdString());
        }
        return names;
    }

    Json zoom(const Viewport &viewport)
    {
        if (viewport.showsAll())
            return "all";
        return {{"seconds", {viewport.time().low, viewport.time().high}},
                {"hz", {viewport.frequency().low, viewport.frequency().high}}};
    }

    Json cursor(const Bench::Place &place)
    {
        Json json = Json::object();
        const auto add = [&json](const char *name, const std::optional<double> &value) {
            if (value)
                json[name] = *value;
        };
        add("seconds", place.seconds);
        add("hz", place.hz);
        add("range", place.range);
        add("bearing", place.bearing);
        return json;
    }

    /// A number that is counted as it is, another with bounds in the second decimal.
    Json bounds(double value)
    {
        if (value == std::floor(value))
            return value;
        const double hundredths = std::round(100.0 * value);
        return {(hundredths - 1.0) / 100.0, (hundredths + 1.0) / 100.0};
    }

    Json facts(WindowParts &window)
    {
        Document &document = window.document();
        const std::size_t lines = document.truth().lines.size() + document.pingTruth().targets.size();
        std::vector<std::string> names{"events", "threshold", "windowSeconds"};
        if (lines > 0)
            names.insert(names.end(), {"lines.found", "events.false"});
        if (document.lineAnalysis() && document.viewport().cursor())
            names.insert(names.end(), {"level", "statistic"});
        Json json = Json::object();
        for (const std::string &name : names)
            if (const auto value = lessonMeasure(window, name); value && std::holds_alternative<double>(*value))
                json[name] = bounds(std::get<double>(*value));
        return json;
    }

    /// `from`: the settings that the earlier steps have made.
    Json stepOf(WindowParts &window, const std::string &title, const AnalysisSettings &from)
    {
        Document &document = window.document();
        Json step = {{"title", title}, {"text", "Describe what can be seen here."}};
        if (const Json settings = changedSettings(from, document.settings()); !settings.empty())
            step["settings"] = settings;
        if (const Json panels = shownPanels(window); !panels.empty())
            step["show"] = panels;
        if (document.lineAnalysis())
            step["zoom"] = zoom(document.viewport());
        if (const Json place = cursor(window.bench().place()); !place.empty())
            step["cursor"] = place;
        step["facts"] = facts(window);
        return step;
    }

    Json withOpen(Json step, const QString &file, const QString &lesson)
    {
        step["open"] = QFileInfo(absolutePath(lesson)).dir().relativeFilePath(file).toStdString();
        return step;
    }

    void checkSettled(WindowParts &window)
    {
        const Document &document = window.document();
        if (!document.analysis() || !document.isCurrent())
            throw Error("lesson", "requires a recording whose analysis is finished");
    }

    void write(const QString &path, const Json &lesson)
    {
        const std::string text = lesson.dump(2) + "\n";
        lessonFromJson(text, path); // a file that is written can be opened
        writeTextFile(pathBytes(path), text);
    }

} // namespace

void writeNewLesson(WindowParts &window, const QString &path)
{
    checkSettled(window);
    const Document &document = window.document();
    const Json step =
        withOpen(stepOf(window, "Step 1", firstSettings(document.openedSource())), sourceFile(document, path), path);
    write(path, {{"title", "New lesson"}, {"sentence", "What this lesson teaches."}, {"steps", Json::array({step})}});
}

void addLessonStep(WindowParts &window, const QString &path)
{
    checkSettled(window);
    const Document &document = window.document();
    const Lesson lesson = readLesson(path);
    const int last = int(lesson.steps.size()) - 1;
    const QString opened = absolutePath(lesson.steps[std::size_t(openingStep(lesson, last))].open);
    const bool isSession = isSessionPath(pathBytes(opened)) && absolutePath(document.sessionPath()) == opened;
    const bool isSame =
        isSession || (absolutePath(document.sourcePath()) == opened && holds(opened, document.source()));
    const std::string title = "Step " + std::to_string(last + 2);
    Json step;
    if (isSame) {
        const AnalysisSettings first =
            isSession ? readSession(pathBytes(opened)).settings : firstSettings(document.openedSource());
        step = stepOf(window, title, settingsAfter(stepsSinceOpening(lesson, last), first));
    } else {
        step =
            withOpen(stepOf(window, title, firstSettings(document.openedSource())), sourceFile(document, path), path);
    }
    Json json = readJsonFile(pathBytes(path));
    json["steps"].push_back(step);
    write(path, json);
}

} // namespace faintline
