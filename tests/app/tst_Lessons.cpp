// Every lesson is gone through as a learner would: what a step says is checked where it says it, the task is open
// before the learner's act, which is done by mouse and keys, and done after it.

#include "app/base/VisibilityWatcher.h"
#include "app/commands/CommandPalette.h"
#include "app/features/inspect/WhyPanel.h"
#include "app/features/opening/WelcomePage.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/RegulationPlot.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/lessons/LessonGuide.h"
#include "app/lessons/LessonList.h"
#include "app/lessons/LessonPanel.h"
#include "app/lessons/PointerFrame.h"
#include "app/lessons/lessonMeasures.h"
#include "app/lessons/writeLesson.h"
#include "app/openWindow.h"
#include "support/errors.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/events/EventTable.h"
#include "widgets/forms/SettingsForm.h"
#include "widgets/pings/PingMap.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/plot/WalkPlot.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QAbstractScrollArea>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QPushButton>
#include <QRadioButton>

#include <qwt_scale_widget.h>

#include <functional>

using namespace faintline;
using namespace faintline::test;

namespace {

using Act = std::function<void(MainWindow &)>;

/// Clicks on the canvas of a waterfall.
void clickAt(WaterfallView &view, double seconds, double hz)
{
    QTest::mouseClick(view.canvas(), Qt::LeftButton, {}, view.positionOf({seconds, hz}).toPoint());
}

void clickOnBrightest(MainWindow &window)
{
    WaterfallView &view = *window.workbench().input();
    const Viewport::Box box = window.document().viewport().visible();
    Viewport::Point best;
    double level = -1e9;
    const Axis &time = window.document().analysis()->time();
    const Axis &hz = view.frequencyAxis();
    for (Index t = time.nearest(box.time.low) + 1; t < time.nearest(box.time.high); ++t)
        for (Index f = hz.nearest(box.frequency.low) + 1; f < hz.nearest(box.frequency.high); ++f)
            if (const auto value = view.valueAt(time.value(double(t)), hz.value(double(f))); value && *value > level) {
                level = *value;
                best = {time.value(double(t)), hz.value(double(f))};
            }
    clickAt(view, best.seconds, best.hz);
}

/// Puts a value into a form's field as a person does.
void enter(QWidget *editor, const QString &value)
{
    QVERIFY(editor && editor->isVisible());
    if (auto *line = qobject_cast<QLineEdit *>(editor)) {
        line->setFocus();
        line->selectAll();
        QTest::keyClicks(line, value);
        QTest::keyClick(line, Qt::Key_Return);
        return;
    }
    if (auto *number = qobject_cast<QAbstractSpinBox *>(editor)) {
        number->setFocus();
        number->selectAll();
        QTest::keyClicks(number, value);
        QTest::keyClick(number, Qt::Key_Return);
        return;
    }
    auto *box = qobject_cast<QComboBox *>(editor);
    QVERIFY(box);
    box->setFocus();
    QTest::keyClick(box, Qt::Key_Home);
    for (int i = 0; i < box->count() && box->currentData().toString() != value; ++i)
        QTest::keyClick(box, Qt::Key_Down);
    QCOMPARE(box->currentData().toString(), value);
}

Act setting(const char *name, const char *value)
{
    return [=](MainWindow &window) {
        enter(window.findChild<SettingsForm *>()->editor(QString::fromLatin1(name)), QString::fromLatin1(value));
    };
}

void clickOnBlueWalk(MainWindow &window)
{
    const auto &walks = window.sequentialTests().walks();
    WalkPlot &plot = window.panel<SequentialPanel>().walk();
    for (int i = 0; i < int(walks.size()); ++i)
        if (const auto &[run, result] = walks[std::size_t(i)];
            !run.hasTarget && window.sequentialTests().selected() != i) {
            QTest::mouseClick(plot.canvas(), Qt::LeftButton, {}, plot.position(i, result.stages).toPoint());
            if (walks[std::size_t(window.sequentialTests().selected())].first.hasTarget == false)
                return;
        }
}

Act dragThresholdTo(double nats)
{
    return [nats](MainWindow &window) {
        ExceedancePlot &plot = window.thresholdPlot();
        const auto at = [&plot](double place) {
            return QPointF(plot.transform(QwtAxis::XBottom, place), 0.5 * plot.canvas()->height()).toPoint();
        };
        QTest::mousePress(plot.canvas(), Qt::LeftButton, {}, at(plot.threshold()));
        QTest::mouseMove(plot.canvas(), at(nats));
        QTest::mouseRelease(plot.canvas(), Qt::LeftButton, {}, at(nats));
    };
}

/// What the learner does in a step, by lesson and number of the step.
const QMap<QString, Act> &acts()
{
    static const QMap<QString, Act> all{
        {"cell 1", clickOnBrightest},
        {"cell 3", setting("spectrogram.windowSeconds", "1")},
        {"p-of-n 1", [](MainWindow &window) { clickAt(*window.workbench().output(), 60.0, 720.0); }},
        {"p-of-n 2", setting("detector.kind", "pOfN")},
        {"p-of-n 3", setting("pOfN.widthCells", "4")},
        {"p-of-n 4", setting("detector.kind", "smd")},
        {"reset 2", setting("smd.lnK", "1.2")},
        {"reset 3", setting("smd.lnK", "-2")},
        {"reset 4", setting("smd.reset", "calibrated")},
        {"choosing-h 2", setting("model.slopeChange", "0.34, 0.33")},
        {"choosing-h 3", [](MainWindow &window) { clickAt(*window.workbench().output(), 48.0, 250.0); }},
        {"assumed-snr 1", setting("model.snr", "0.063")},
        {"thresholds 1", setting("decide.thresholdNats", "12")},
        {"thresholds 2", dragThresholdTo(5.0)},
        {"cfar-loss 2", setting("noise.halfWidthCells", "3")},
        {"real-noise 2",
         [](MainWindow &window) {
             QTest::keyClick(window.findChild<SettingsForm *>()->editor("noise.followLevel"), Qt::Key_Space);
         }},
        {"manoeuvre 1",
         [](MainWindow &window) {
             window.pingBench().output()->plane()->setFocus();
             while (window.pingBench().viewports().place().seconds < 310.0)
                 QTest::keyClick(window.pingBench().output()->plane(), Qt::Key_L);
         }},
        {"manoeuvre 2", setting("model.motion", "manoeuvring")},
        {"manoeuvre 4", setting("model.motion", "bank")},
        {"when-to-stop 1", clickOnBlueWalk},
        {"when-to-stop 3",
         [](MainWindow &window) {
             enter(window.panel<SequentialPanel>().form().editor("sprt.miss"), "0.1");
             for (QPushButton *button : window.panel<SequentialPanel>().findChildren<QPushButton *>())
                 if (button->text() == "Run")
                     QTest::mouseClick(button, Qt::LeftButton);
         }},
    };
    return all;
}

} // namespace

/// The button of an answer.
static QAbstractButton *choice(const LessonPanel &panel, int answer)
{
    return panel.findChildren<QRadioButton *>().at(answer);
}

class tst_Lessons : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void mistakesAreNamed_data()
    {
        QTest::addColumn<QByteArray>("json");
        QTest::addColumn<QByteArray>("about");
        const auto step = [](const char *rest) {
            return QByteArray(
                       R"({"title": "a", "sentence": "b", "steps": [{"title": "c", "text": "d", "open": "e.json")")
                   + rest + "}]}";
        };
        QTest::newRow("no JSON") << QByteArray("{") << QByteArray("JSON");
        QTest::newRow("no steps") << QByteArray(R"({"title": "a", "sentence": "b"})") << QByteArray("steps");
        QTest::newRow("nothing opened") << QByteArray(
            R"({"title": "a", "sentence": "b", "steps": [{"title": "c", "text": "d"}]})")
                                        << QByteArray("steps[0].open");
        QTest::newRow("key") << step(R"(, "moon": 1)") << QByteArray("steps[0].moon");
        QTest::newRow("setting") << step(R"(, "settings": {"smd.moon": 1})") << QByteArray("smd.moon");
        QTest::newRow("value") << step(R"(, "settings": {"model.snr": -3})") << QByteArray("model.snr");
        QTest::newRow("point of a curve") << step(R"(, "facts": {"pd.0.1": 1})") << QByteArray("facts.pd.0.1");
        QTest::newRow("experiment") << step(R"(, "experiment": 1)") << QByteArray("steps[0].experiment");
        QTest::newRow("measure") << step(R"(, "facts": {"moon": 1})") << QByteArray("facts.moon");
        QTest::newRow("bounds") << step(R"(, "facts": {"events": [3, 1]})") << QByteArray("facts.events");
        QTest::newRow("widget") << step(R"(, "point": "moon")") << QByteArray("moon");
        QTest::newRow("task without end") << step(R"(, "do": "something")") << QByteArray("until");
        QTest::newRow("answer") << step(R"(, "ask": {"question": "?", "choices": ["1", "2"], "answer": 2, "why": "!"})")
                                << QByteArray("answer");
    }

    void mistakesAreNamed()
    {
        QFETCH(QByteArray, json);
        QFETCH(QByteArray, about);
        const std::string said = test::errorOf([&] { lessonFromJson(json.toStdString(), "/somewhere/lesson.json"); });
        QVERIFY2(said.starts_with("/somewhere/lesson.json"), said.c_str());
        QVERIFY2(test::contains(said, about.toStdString()), said.c_str());
        QVERIFY2(!test::contains(said, "\n"), said.c_str());
    }

    void everyLessonIsTrueAndCanBeDone_data()
    {
        QTest::addColumn<int>("number");
        QVERIFY(lessons().size() >= 6);
        int number = 0;
        for (const Lesson &lesson : lessons())
            QTest::newRow(qPrintable(QFileInfo(lesson.path).baseName())) << number++;
    }

    void everyLessonIsTrueAndCanBeDone()
    {
        QFETCH(int, number);
        const Lesson &lesson = lessons()[std::size_t(number)];
        const QString name = QFileInfo(lesson.path).baseName();
        const auto window = newWindow();
        LessonGuide &guide = window->lessonGuide();
        LessonPanel &panel = guide.panel();
        window->open(lesson.path);
        for (int i = 0; i < int(lesson.steps.size()); ++i) {
            const LessonStep &step = lesson.steps[std::size_t(i)];
            const QByteArray where = QStringLiteral("%1, step %2: ").arg(name).arg(i + 1).toUtf8();
            const auto fails = [&](const LessonCondition &condition) {
                return where.toStdString() + failure(*window, condition);
            };
            QTRY_VERIFY2_WITH_TIMEOUT(isReady(guide), where, patience);
            QCOMPARE(guide.step(), i);
            QVERIFY2(panel.isVisible() && panel.text().contains(step.text), where);
            QVERIFY2(holds(*window, step.facts), fails(step.facts).c_str());

            QWidget *target = guide.widgetNamed(step.point);
            QCoreApplication::processEvents();
            QVERIFY2(target && isInSight(*target), where + "nothing to point at");
            QVERIFY2(guide.frame().isVisible() && guide.frame().testAttribute(Qt::WA_TransparentForMouseEvents), where);
            for (QWidget *around = target->parentWidget(); around != window.get(); around = around->parentWidget())
                if (const auto *area = qobject_cast<QAbstractScrollArea *>(around)) {
                    const QRect inSight(area->viewport()->mapTo(window.get(), QPoint()), area->viewport()->size());
                    QVERIFY2(inSight.contains(guide.frame().geometry()), where + "the frame leaves the form");
                }

            if (step.question) {
                QVERIFY2(!panel.text().contains(step.question->why), where + "the answer is there before the choice");
                const QWidget *row = choice(panel, step.question->answer)->parentWidget();
                QTest::mouseClick(row->findChild<QLabel *>(), Qt::LeftButton); // its words
                QCOMPARE(panel.choice(), step.question->answer);
                QVERIFY2(panel.text().contains("Right. " + step.question->why), where);
            }
            const Act act = acts().value(QStringLiteral("%1 %2").arg(name).arg(i + 1));
            QCOMPARE(static_cast<bool>(act), !step.until.isEmpty());
            if (act) {
                QVERIFY2(!holds(*window, step.until) && !panel.isDone(), where + "is done before anybody did it");
                act(*window);
                if (QTest::currentTestFailed())
                    return;
                QTRY_VERIFY2_WITH_TIMEOUT(panel.isDone(), fails(step.until).c_str(), patience);
                QVERIFY2(holds(*window, step.thenFacts), fails(step.thenFacts).c_str());
                QVERIFY2(panel.text().contains(step.then), where);
            }
            QTest::mouseClick(panel.next(), Qt::LeftButton);
        }
        QVERIFY(panel.learner() && !guide.frame().isVisible());
        for (const bool areTasks : {false, true}) {
            const auto all = std::ranges::count_if(lesson.steps, [&](const LessonStep &step) {
                return areTasks ? !step.until.isEmpty() : step.question.has_value();
            });
            QVERIFY2(all == 0 || panel.text().contains(tr("%1 of %1").arg(all)), qPrintable(panel.text()));
        }
        QCOMPARE(panel.next()->isVisible(), number + 1 < int(lessons().size()));
        QTest::mouseClick(panel.leave(), Qt::LeftButton);
        QVERIFY(!guide.isRunning());
        QVERIFY(!panel.isVisible());
    }

    void aWrongAnswerReadsAsWrong()
    {
        LessonPanel panel;
        const Lesson &lesson = lessons().front();
        const auto step =
            std::ranges::find_if(lesson.steps, [](const LessonStep &each) { return each.question.has_value(); });
        panel.setStep(lesson, int(step - lesson.steps.begin()));
        const LessonQuestion &question = *step->question;
        const auto why = [&panel] {
            const auto labels = panel.findChildren<QLabel *>();
            return *std::ranges::find_if(labels, [](const QLabel *label) {
                return label->text().startsWith("Wrong. ") || label->text().startsWith("Right. ");
            });
        };
        choice(panel, (question.answer + 1) % int(question.choices.size()))->click();
        QCOMPARE(why()->text(), "Wrong. The answer is “" + question.choices[question.answer] + "”. " + question.why);
        QCOMPARE(why()->palette().color(QPalette::WindowText), Theme::colours(panel).error);
        QVERIFY(panel.text().contains("✓ " + question.choices[question.answer]));
        QVERIFY(panel.text().contains("✗ " + question.choices[panel.choice()]));
        choice(panel, question.answer)->click();
        QCOMPARE(why()->text(), "Right. " + question.why);
        QCOMPARE(why()->palette().color(QPalette::WindowText), Theme::colours(panel).text);
    }

    /// Also in the presentation; a field keeps the digits that are typed into it.
    void numberKeysAnswer()
    {
        const auto window = newWindow();
        LessonGuide &guide = window->lessonGuide();
        const Lesson lesson = readLesson(":/lessons/reset.json");
        const auto step =
            std::ranges::find_if(lesson.steps, [](const LessonStep &each) { return each.question.has_value(); });
        guide.start(lesson, int(step - lesson.steps.begin()));
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        const auto before = window->document().annotations();
        QVERIFY(std::ssize(window->document().shownEvents()) > 0);
        window->eventTable().setSelectedEvent(window->document().shownEvents().front().id);
        // A step that points to a field leaves the keys to its question, until the field is clicked.
        guide.goTo(guide.step() + 1);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QVERIFY(guide.lesson().steps[std::size_t(guide.step())].question);
        QVERIFY(guide.panel().isAncestorOf(window->focusWidget()));
        auto *field = window->findChild<SettingsForm *>()->editor("smd.lnK");
        field->setFocus();
        QTest::keyClick(field, Qt::Key_1);
        QCOMPARE(guide.panel().choice(), -1);
        window->workbench().output()->setFocus();
        QTest::keyClick(window->workbench().output(), Qt::Key_2);
        QCOMPARE(guide.panel().choice(), 1);
        QCOMPARE(window->document().annotations(), before); // no class was set
        QTest::keyClick(window.get(), Qt::Key_F5);
        QTest::keyClick(window->workbench().output(), Qt::Key_1);
        QCOMPARE(guide.panel().choice(), 0);
        QTest::keyClick(window.get(), Qt::Key_F5); // its size of words is that of all windows
    }

    /// The first choice and the first time count; Back returns from the end to the last step.
    void answersAreHandedInAsAPage()
    {
        const auto window = newWindow();
        LessonGuide &guide = window->lessonGuide();
        LessonPanel &panel = guide.panel();
        const QString path = writeFile(m_folder, "mine.json", R"({"title": "Yes <or> no", "sentence": "s", "steps": [
        {"title": "One", "text": "t", "open": "scene.json", "settings": {"decide.thresholdNats": 12},
         "ask": {"question": "Is it?", "choices": ["yes & no", "no"], "answer": 1, "why": "w"},
         "do": "Set the threshold to 20 nat.", "until": {"decide.thresholdNats": 20}, "thenFacts": {"threshold": 20}},
        {"title": "Two", "text": "t", "ask": {"question": "Or not?", "choices": ["a", "b"],
                                             "answer": 0, "why": "w"}}]})");
        QVERIFY(QFile::copy(":/lessons/scenes/line-that-ends.json", m_folder.filePath("scene.json")));
        window->open(path);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QTest::mouseClick(choice(panel, 0), Qt::LeftButton);
        QTest::mouseClick(choice(panel, 1), Qt::LeftButton);
        window->controller().edit("decide.thresholdNats", 20.0, "Change the threshold");
        QTRY_VERIFY_WITH_TIMEOUT(panel.isDone(), patience);
        QTest::mouseClick(panel.next(), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QTest::mouseClick(panel.next(), Qt::LeftButton);
        QVERIFY(panel.learner());
        QVERIFY2(panel.text().contains("0 of 2") && panel.text().contains("1 of 1"), qPrintable(panel.text()));
        QVERIFY(!panel.next()->isVisible()); // no bundled lesson follows

        QTest::keyClicks(panel.learner(), "Ada <L> %2");
        QSignalSpy asked(&panel, &LessonPanel::saveRequested);
        disconnect(&panel, &LessonPanel::saveRequested, &guide, nullptr); // it asks for a file
        QTest::mouseClick(buttonOf(panel, "Save answers…"), Qt::LeftButton);
        QCOMPARE(asked.value(0).value(0).toString(), QString("Ada <L> %2"));
        const QString page = m_folder.filePath("answers.html");
        guide.writeAnswers(page, asked.value(0).value(0).toString());
        QFile file(page);
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QString html = QString::fromUtf8(file.readAll());
        for (const char *needed :
             {"<h1>Yes &lt;or&gt; no</h1>", "Ada &lt;L&gt; %2", "yes &amp; no", "wrong: the answer is “no”",
              "not answered", "decide.thresholdNats = 20, threshold = 20", "<td>done</td>", "0 of 2", "1 of 1"})
            QVERIFY2(html.contains(QString::fromUtf8(needed)), needed);
        QCOMPARE(html.count(QRegularExpression("<td>20\\d\\d-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ</td>")), 2);

        QTest::mouseClick(buttonOf(panel, "Back"), Qt::LeftButton);
        QVERIFY(!panel.learner());
        QCOMPARE(guide.step(), 1);
    }

    void theEndLeadsToTheNextLessonAndTicksThisOne()
    {
        const auto memory = [this] {
            return std::make_unique<QSettings>(m_folder.filePath("memory.ini"), QSettings::IniFormat);
        };
        const auto ticks = [](MainWindow &window) {
            QStringList ticked;
            for (const QPushButton *each : window.findChild<LessonList *>()->findChildren<QPushButton *>())
                if (each->text().startsWith(QStringLiteral("✓")))
                    ticked << each->text();
            for (const QAction *each : window.findChildren<QAction *>())
                if (each->text().startsWith(QStringLiteral("✓")))
                    ticked << each->text();
            return ticked;
        };
        {
            const auto window = newWindow({1400, 900}, memory());
            LessonGuide &guide = window->lessonGuide();
            QCOMPARE(ticks(*window), QStringList());
            const auto &reset = lessons()[2];
            guide.start(reset, int(reset.steps.size()) - 1);
            QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
            QTest::mouseClick(guide.panel().next(), Qt::LeftButton);
            QVERIFY(guide.panel().text().contains(lessons()[3].title));
            QTest::mouseClick(guide.panel().next(), Qt::LeftButton);
            QTRY_VERIFY_WITH_TIMEOUT(isReady(guide) && !guide.panel().learner(), patience);
            QCOMPARE(guide.lesson().title, lessons()[3].title);
            QCOMPARE(guide.step(), 0);
        }
        const auto again = newWindow({1400, 900}, memory());
        const QStringList ticked = ticks(*again);
        QCOMPARE(ticked.size(), 2); // in the list and in the menu
        for (const QString &text : ticked)
            QVERIFY2(text.contains(lessons()[2].title), qPrintable(text));
    }

    /// What is written opens as a lesson, and shows the same.
    void whatIsShownBecomesALesson_data()
    {
        QTest::addColumn<QString>("open");
        QTest::addColumn<bool>("isInjected");
        QTest::addColumn<QStringList>("files");
        const QString bundled = ":/lessons/scenes/line-that-ends.json";
        QTest::newRow("bundled scene") << bundled << false << QStringList{"new-scene.json", "new.json"};
        QTest::newRow("own scene") << "own.json" << false << QStringList{"new.json", "own.json"};
        QTest::newRow("added line") << bundled << true << QStringList{"new-scene.faintline", "new.json"};
    }

    void whatIsShownBecomesALesson()
    {
        QFETCH(QString, open);
        QFETCH(bool, isInjected);
        QFETCH(QStringList, files);
        const QTemporaryDir folder;
        const QString path = folder.filePath("new.json");
        if (!open.startsWith(':')) {
            QVERIFY(QFile::copy(":/lessons/scenes/line-that-ends.json", folder.filePath(open)));
            open = folder.filePath(open);
        }
        const auto window = newWindow();
        Document &document = window->document();
        QVERIFY(openAndSettle(*window, open, [](AnalysisSettings &settings) {
            for (const auto &[name, value] : lessons()[2].steps.front().settings)
                settingField(name).set(settings, value);
        }));
        if (isInjected) {
            window->controller().inject(
                {.snrDb = 9.0, .startSeconds = 20.0, .durationSeconds = 60.0, .frequencyHz = 700.0});
            QVERIFY(settle(*window));
        }
        document.viewport().zoomTo({20.0, 80.0}, {300.0, 500.0});
        document.viewport().setCursor({60.0, 400.0});
        auto *dock = window->findChild<QDockWidget *>("whyDock");
        dock->show();
        dock->raise();
        QTRY_VERIFY(isInSight(window->panel<WhyPanel>()));
        writeNewLesson(*window, path);
        const AnalysisSettings first = document.settings();
        const auto firstBox = document.viewport().visible();

        window->controller().edit("decide.thresholdNats", 30.0, "Change the threshold");
        QVERIFY(settle(*window));
        document.viewport().showAll();
        document.viewport().setCursor({10.0, 100.0});
        if (!isInjected
            && open.startsWith(':')) // otherwise what is open is no file; saved twice it would be another scene
            QVERIFY(openAndSettle(*window, folder.filePath("new-scene.json"),
                                  [after = document.settings()](AnalysisSettings &settings) { settings = after; }));
        document.viewport().setCursor({10.0, 100.0});
        if (!isInjected)
            addLessonStep(*window, path);
        const AnalysisSettings second = document.settings();
        QCOMPARE(QDir(folder.path()).entryList(QDir::Files, QDir::Name), files);

        const Lesson lesson = readLesson(path);
        QCOMPARE(lesson.steps.size(), isInjected ? 1u : 2u);
        QVERIFY(lesson.steps.front().facts.parts.size() >= 7);
        QVERIFY(lesson.steps.front().show.contains("why"));
        const auto again = newWindow();
        again->open(path);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(again->lessonGuide()), patience);
        QVERIFY(again->document().settings() == first);
        QVERIFY(again->panel<WhyPanel>().isVisible());
        QCOMPARE(again->document().viewport().visible(), firstBox);
        QCOMPARE(again->document().viewport().cursor(), std::optional(Viewport::Point{60.0, 400.0}));
        QCOMPARE(failure(*again, lesson.steps.front().facts), std::string());
        if (isInjected)
            return;
        QVERIFY(lesson.steps.back().open.isEmpty());
        again->lessonGuide().goTo(1);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(again->lessonGuide()), patience);
        QVERIFY(again->document().settings() == second);
        QVERIFY(again->document().viewport().showsAll());
        QCOMPARE(again->document().viewport().cursor(), std::optional(Viewport::Point{10.0, 100.0}));
        QCOMPARE(failure(*again, lesson.steps.back().facts), std::string());
    }

    void undoLeavesTheStepAsItBegan()
    {
        const auto window = newWindow();
        LessonGuide &guide = window->lessonGuide();
        Document &document = window->document();
        window->open(":/lessons/reset.json");
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        const AnalysisSettings first = document.settings();
        QCOMPARE(document.undoStack().count(), 0);
        guide.goTo(1);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QCOMPARE(document.undoStack().count(), 0); // the lesson's own changes are not the learner's
        QVERIFY(!document.isModified());
        const AnalysisSettings second = document.settings();
        QVERIFY(second != first);

        window->controller().edit("smd.lnK", 1.0, "Change ln K");
        document.undoStack().undo();
        QVERIFY(document.settings() == second);
        window->controller().edit("smd.lnK", 1.2, "Change ln K");
        QTRY_VERIFY_WITH_TIMEOUT(guide.panel().isDone(), patience);
        QVERIFY(!document.isModified()); // the task asked for it

        QTest::mouseClick(buttonOf(guide.panel(), "Back"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QCOMPARE(guide.step(), 0);
        QVERIFY(document.settings() == first);
        QVERIFY(!buttonOf(guide.panel(), "Back")->isEnabled());

        // Whatever the learner has done meanwhile, a step begins as it says.
        window->controller().edit("model.snr", 2.0, "Change the SNR");
        guide.goTo(1);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QVERIFY(document.settings() == second);
    }

    void openingSomethingElseLeaves()
    {
        const auto window = newWindow();
        LessonGuide &guide = window->lessonGuide();
        window->open(":/lessons/reset.json");
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        window->open(":/lessons/scenes/two-near-lines.json");
        QTRY_VERIFY_WITH_TIMEOUT(!guide.isRunning(), patience);
        QVERIFY(!guide.panel().isVisible());
        QTRY_VERIFY_WITH_TIMEOUT(!window->controller().isBusy(), patience);
        QVERIFY(window->workbench().isVisible());

        guide.start(lessons().front());
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        window->showWelcome();
        QVERIFY(!guide.isRunning() && !guide.dock()->isVisible());
    }

    void aLessonOfScansPutsTheRecordingAside()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, QStringLiteral(":/scenarios/faint-drifting-line.json")));
        const QString title = window->windowTitle();
        QVERIFY(window->workbench().isVisible());
        window->open(QStringLiteral(":/lessons/when-to-stop.json"));
        QTRY_VERIFY_WITH_TIMEOUT(isReady(window->lessonGuide()), patience);
        QVERIFY(window->panel<SequentialPanel>().isVisible());
        QVERIFY(!window->workbench().isVisible());
        QVERIFY2(window->windowTitle().startsWith("Radar scans"), qPrintable(window->windowTitle()));
        window->lessonGuide().leave();
        QVERIFY(window->workbench().isVisible());
        QCOMPARE(window->windowTitle(), title);
    }

    void presentedItIsLargerAndStays()
    {
        const auto window = newWindow();
        LessonGuide &guide = window->lessonGuide();
        window->open(":/lessons/cell.json");
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        const auto size = [&] {
            int largest = 0;
            for (const QLabel *label : guide.panel().findChildren<QLabel *>())
                largest = std::max(largest, label->font().pixelSize());
            return largest;
        };
        const int plain = size();
        const auto words = [&] {
            return window->workbench().input()->axisWidget(QwtAxis::XBottom)->font().pixelSize();
        };
        const int plainWords = words();
        window->resize(1920, 1080); // on smaller ones it is less wide
        QTest::keyClick(window.get(), Qt::Key_F5);
        QVERIFY(!window->menuBar()->isVisible());
        QVERIFY(guide.panel().isVisible());
        QVERIFY(size() >= 26);
        QVERIFY(guide.panel().width() >= 500);
        QVERIFY2(words() >= 16, qPrintable(QString::number(words())));
        guide.goTo(1);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QVERIFY(size() > plain);
        guide.leave();
        QTest::keyClick(window.get(), Qt::Key_F5);
        QTRY_VERIFY(!guide.dock()->isVisible()); // though it was there when the presentation began
        QVERIFY(window->menuBar()->isVisible());
        QCOMPARE(words(), plainWords);
        QCOMPARE(guide.panel().minimumWidth(), 0);
    }

    /// What does not fit is scrolled to.
    void presentedNoTextIsCut()
    {
        const auto cut = [](const QWidget &panel) {
            QStringList all;
            for (const QLabel *label : panel.findChildren<QLabel *>())
                if (label->isVisible() && label->wordWrap() && label->height() < label->heightForWidth(label->width()))
                    all << QStringLiteral("%1 < %2: %3")
                               .arg(label->height())
                               .arg(label->heightForWidth(label->width()))
                               .arg(label->text());
            for (const QRadioButton *button : panel.findChildren<QRadioButton *>())
                if (button->height() != button->fontMetrics().height()) // beside the first line of its choice
                    all << button->accessibleName();
            return all.join("; ");
        };
        QWidget window;
        auto *panel = new LessonPanel(&window);
        panel->setLarge(true);
        window.show();
        for (const QSize size : {QSize(384, 530), QSize(384, 760), QSize(410, 400), QSize(560, 1000)})
            for (const Lesson &lesson : lessons())
                for (int step = 0; step < int(lesson.steps.size()); ++step) {
                    panel->setStep(lesson, step);
                    window.resize(size);
                    panel->setGeometry(QRect(QPoint(), size));
                    for (int pass = 0; pass < 20; ++pass) // each may ask for another layout; there is an end
                        QCoreApplication::processEvents();
                    QVERIFY2(cut(*panel).isEmpty(), qPrintable(lesson.title + ": " + cut(*panel)));
                }
    }

    void presentedAnAnswerLeavesTheTaskInSight()
    {
        QWidget window;
        auto *panel = new LessonPanel(&window);
        panel->setLarge(true);
        window.resize(384, 900);
        window.show();
        panel->setGeometry(window.rect());
        const auto layOut = [] {
            for (int pass = 0; pass < 20; ++pass)
                QCoreApplication::processEvents();
        };
        int asked = 0;
        for (const Lesson &lesson : lessons())
            for (int step = 0; step < int(lesson.steps.size()); ++step) {
                const LessonStep &now = lesson.steps[std::size_t(step)];
                if (!now.question || now.task.isEmpty())
                    continue;
                panel->setStep(lesson, step);
                layOut();
                choice(*panel, now.question->answer)->click();
                layOut();
                for (const QLabel *label : panel->findChildren<QLabel *>())
                    if (label->text().endsWith(now.task)) {
                        ++asked;
                        QVERIFY2(label->visibleRegion().boundingRect() == label->rect(), qPrintable(label->text()));
                    }
            }
        QVERIFY(asked > 5);
    }

    /// What a step is about is there, though a presentation puts away all panels.
    void presentedTheStepKeepsItsPanel()
    {
        const auto window = newWindow();
        LessonGuide &guide = window->lessonGuide();
        guide.start(readLesson(":/lessons/reset.json"), 1);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QTest::keyClick(window.get(), Qt::Key_F5);
        auto *form = window->findChild<SettingsForm *>();
        QVERIFY(form->isVisible() && form->editor("smd.lnK")->isVisible());
        QVERIFY(!window->findChild<QDockWidget *>("thresholdDock")->isVisible());
        QTest::keyClick(window.get(), Qt::Key_F5);
        QTRY_VERIFY(isInSight(*form->editor("smd.lnK"))); // nor does its end take it away
        guide.leave();
    }

    void whereOneChartFitsItIsTheOneToLookAt()
    {
        const auto window = newWindow({1280, 700});
        LessonGuide &guide = window->lessonGuide();
        guide.start(readLesson(":/lessons/reset.json"), 0);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QTRY_VERIFY(window->workbench().regulationPlot()->isVisible());
        QVERIFY(!window->workbench().statisticPlot()->isVisible());
        guide.leave();
        QTRY_VERIFY(window->workbench().statisticPlot()->isVisible());
    }

    void presentedPanelsOfOtherStepsAreAway()
    {
        const auto window = newWindow();
        LessonGuide &guide = window->lessonGuide();
        guide.start(readLesson(":/lessons/choosing-h.json"), 2);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QTest::keyClick(window.get(), Qt::Key_F5);
        QVERIFY(window->panel<WhyPanel>().isVisible());
        guide.goTo(3); // points to a picture
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QVERIFY(!window->panel<WhyPanel>().isVisible());
        QVERIFY(!window->findChild<SettingsForm *>()->isVisible());
        QTest::keyClick(window.get(), Qt::Key_F5);
        QVERIFY(window->findChild<SettingsForm *>()->isVisible());
        guide.leave();
    }

    /// On a small screen the panels of the step lie below the lesson, and the pictures keep their width.
    void presentedOnASmallScreenItSharesAColumn()
    {
        const auto window = newWindow({1280, 800});
        LessonGuide &guide = window->lessonGuide();
        guide.start(readLesson(":/lessons/thresholds.json"), 0);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        QCOMPARE(window->dockWidgetArea(guide.dock()), Qt::LeftDockWidgetArea);
        QTest::keyClick(window.get(), Qt::Key_F5);
        QCOMPARE(window->dockWidgetArea(guide.dock()), Qt::RightDockWidgetArea); // widths: walks/teacher.cpp
        QVERIFY(guide.panel().isVisible());
        QTest::keyClick(window.get(), Qt::Key_F5);
        QCOMPARE(window->dockWidgetArea(guide.dock()), Qt::LeftDockWidgetArea);
    }

    void presentedAChartIsAsWideAsTheLesson()
    {
        const auto window = newWindow({1920, 1080});
        LessonGuide &guide = window->lessonGuide();
        guide.start(readLesson(":/lessons/thresholds.json"), 1); // points to the plot itself
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        guide.present(true); // not full screen, which has another size here
        QTRY_VERIFY2(window->thresholdPlot().width() > 380,
                     qPrintable(QString::number(window->thresholdPlot().width())));
    }

    /// On a large screen: also a label that becomes bold. Afterwards everything is as before.
    void presentedTheFormIsLarger()
    {
        const auto window = newWindow({1920, 1080});
        LessonGuide &guide = window->lessonGuide();
        guide.start(readLesson(":/lessons/reset.json"), 1);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        auto *form = window->findChild<SettingsForm *>();
        const auto sizes = [&] {
            std::vector<int> all;
            for (const QWidget *widget : form->findChildren<QWidget *>())
                if (widget->inherits("QLabel") || widget->inherits("QAbstractSpinBox") || widget->inherits("QComboBox"))
                    all.push_back(widget->font().pixelSize());
            return all;
        };
        const std::vector<int> plain = sizes();
        QTest::keyClick(window.get(), Qt::Key_F5);
        QVERIFY(std::ranges::min(sizes()) >= 17);
        window->controller().edit("smd.lnK", 1.0, "Change ln K");
        QVERIFY(settle(*window));
        QVERIFY(std::ranges::min(sizes()) >= 17);
        QTest::keyClick(window.get(), Qt::Key_F5);
        QCOMPARE(sizes(), plain);
    }

    void escapeLeavesAPresentationFromAnyField()
    {
        const auto window = newWindow();
        LessonGuide &guide = window->lessonGuide();
        guide.start(readLesson(":/lessons/reset.json"), 1);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(guide), patience);
        for (int place = 0; place < 3; ++place) {
            QTest::keyClick(window.get(), Qt::Key_F5);
            QVERIFY(!window->menuBar()->isVisible());
            QWidget *places[]{window->findChild<SettingsForm *>()->editor("smd.lnK"), choice(guide.panel(), 0),
                              window->workbench().output()};
            QWidget *focus = places[place];
            focus->setFocus();
            QTest::keyClick(focus, Qt::Key_Escape);
            QVERIFY2(window->menuBar()->isVisible(), qPrintable(QString::number(place)));
            QVERIFY(guide.isRunning() && guide.panel().isVisible());
        }
        QTest::keyClick(window.get(), Qt::Key_F5);
        auto *choices = qobject_cast<QComboBox *>(window->findChild<SettingsForm *>()->editor("smd.reset"));
        QVERIFY(choices);
        choices->showPopup();
        QTRY_VERIFY(QApplication::activePopupWidget());
        QTest::keyClick(QApplication::activePopupWidget(), Qt::Key_Escape);
        QVERIFY(!QApplication::activePopupWidget());
        QVERIFY(!window->menuBar()->isVisible());
    }

    void menuPaletteAndWelcomePageOfferThem()
    {
        const auto window = newWindow();
        const QString title = lessons()[1].title;
        QAction *action = nullptr;
        for (QAction *each : window->findChildren<QAction *>())
            if (each->text() == title)
                action = each;
        QVERIFY(action);
        action->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(isReady(window->lessonGuide()), patience);
        QCOMPARE(window->lessonGuide().lesson().title, title);

        window->showWelcome();
        QPushButton *link = nullptr;
        for (QPushButton *each : window->welcome().findChildren<QPushButton *>())
            if (each->text().contains(lessons()[2].title))
                link = each;
        QVERIFY(link && link->isVisible());
        QTest::mouseClick(link, Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(window->lessonGuide()), patience);
        QCOMPARE(window->lessonGuide().lesson().title, lessons()[2].title);

        auto *palette = window->findChild<CommandPalette *>();
        QTest::keyClick(window.get(), Qt::Key_K, Qt::ControlModifier);
        QTest::keyClicks(palette->line(), lessons()[0].title);
        QTest::keyClick(palette->line(), Qt::Key_Return);
        QTRY_VERIFY_WITH_TIMEOUT(isReady(window->lessonGuide()), patience);
        QCOMPARE(window->lessonGuide().lesson().title, lessons()[0].title);
    }

private:
    QTemporaryDir m_folder;
};

FAINTLINE_WINDOW_TEST(tst_Lessons)
#include "tst_Lessons.moc"
