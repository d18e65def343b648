#include "app/lessons/LessonAnswers.h"

#include "base/utc.h"

#include <QStringList>

namespace faintline {

namespace {

    const QString style = QStringLiteral("body{font:15px/1.5 system-ui,sans-serif;color:#1c2127;background:#fff;"
                                         "max-width:72em;margin:2em auto;padding:0 1.5em}"
                                         "table{border-collapse:collapse}td,th{padding:.4em 1em .4em 0;text-align:left;"
                                         "vertical-align:top;border-bottom:1px solid #dde1e6}"
                                         "@media print{body{margin:0;max-width:none}tr{break-inside:avoid}}");

    QString text(const std::string &bytes)
    {
        return QString::fromStdString(bytes);
    }

    QString row(const QStringList &cells, const QString &tag = QStringLiteral("td"))
    {
        QString result = QStringLiteral("<tr>");
        for (const QString &cell : cells)
            result += QStringLiteral("<%1>%2</%1>").arg(tag, cell.toHtmlEscaped());
        return result + QStringLiteral("</tr>\n");
    }

    QString questionRow(const LessonStep &step, const LessonAnswers::Step &answer)
    {
        const LessonQuestion &question = *step.question;
        if (answer.choice < 0)
            return row({step.title, question.text, QStringLiteral("—"), QStringLiteral("not answered"), {}});
        const QString verdict =
            answer.choice == question.answer
                ? QStringLiteral("right")
                : QStringLiteral("wrong: the answer is “%1”").arg(question.choices[question.answer]);
        return row({step.title, question.text, question.choices[answer.choice], verdict,
                    text(formatUtc(answer.choiceUnixSeconds))});
    }

    QString taskRow(const LessonStep &step, const LessonAnswers::Step &answer)
    {
        QStringList measured;
        for (const auto &[name, value] : answer.measured)
            measured << QStringLiteral("%1 = %2").arg(text(name), text(value));
        return row({step.title, step.task, answer.isDone ? measured.join(QStringLiteral(", ")) : QStringLiteral("—"),
                    answer.isDone ? QStringLiteral("done") : QStringLiteral("not done"),
                    answer.isDone ? text(formatUtc(answer.doneUnixSeconds)) : QString()});
    }

} // namespace

LessonAnswers::Count LessonAnswers::questions(const Lesson &lesson) const
{
    Count count;
    for (std::size_t i = 0; i < lesson.steps.size(); ++i)
        if (const auto &question = lesson.steps[i].question) {
            ++count.all;
            count.reached += steps[i].choice == question->answer;
        }
    return count;
}

LessonAnswers::Count LessonAnswers::tasks(const Lesson &lesson) const
{
    Count count;
    for (std::size_t i = 0; i < lesson.steps.size(); ++i)
        if (!lesson.steps[i].task.isEmpty()) {
            ++count.all;
            count.reached += steps[i].isDone;
        }
    return count;
}

std::string answersHtml(const Lesson &lesson, const LessonAnswers &answers, const QString &learner)
{
    const QString title = lesson.title.toHtmlEscaped();
    QString page = QStringLiteral("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                                  "<meta name=\"viewport\" content=\"width=device-width\">\n"
                                  "<meta name=\"generator\" content=\"Faintline %1\">\n<title>%2</title>\n"
                                  "<style>%3</style>\n</head>\n<body>\n<h1>%2</h1>\n")
                       .arg(QStringLiteral(FAINTLINE_VERSION), title, style);
    const auto [right, questions] = answers.questions(lesson);
    const auto [done, tasks] = answers.tasks(lesson);
    page += QStringLiteral("<p>Learner: %1</p>\n<p>Questions answered right at the first choice: %2 of %3. Tasks done: "
                           "%4 of %5.</p>\n<table>\n")
                .arg(learner.toHtmlEscaped(), QString::number(right), QString::number(questions), QString::number(done),
                     QString::number(tasks)); // at once: a name may hold %2
    page += row({QStringLiteral("Step"), QStringLiteral("Question or task"),
                 QStringLiteral("Choice or measured values"), QStringLiteral("Result"), QStringLiteral("Time (UTC)")},
                QStringLiteral("th"));
    for (std::size_t i = 0; i < lesson.steps.size(); ++i) {
        if (lesson.steps[i].question)
            page += questionRow(lesson.steps[i], answers.steps[i]);
        if (!lesson.steps[i].task.isEmpty())
            page += taskRow(lesson.steps[i], answers.steps[i]);
    }
    return (page + QStringLiteral("</table>\n</body>\n</html>\n")).toStdString();
}

} // namespace faintline
