#include "app/lessons/LessonGuide.h"

#include "app/base/StartColumn.h"
#include "app/base/filePath.h"
#include "app/base/writeAndReport.h"
#include "app/document/OutputLayers.h"
#include "app/document/scanScenario.h"
#include "app/features/evaluate/EvaluatePanel.h"
#include "app/features/evaluate/ExperimentsPanel.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/settings/PipelinePanel.h"
#include "app/lessons/LessonPanel.h"
#include "app/lessons/PointerFrame.h"
#include "app/lessons/lessonMeasures.h"
#include "app/views/WindowParts.h"
#include "app/views/WindowViews.h"
#include "base/files/AtomicFile.h"
#include "exchange/Session.h"
#include "widgets/base/ReadOut.h"
#include "widgets/forms/SettingsForm.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/plot/StripPlot.h"

#include <QDateTime>
#include <QDir>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QKeyEvent>
#include <QMainWindow>
#include <QUrl>

#include <algorithm>
#include <utility>

namespace faintline {

namespace {

    constexpr int watchMs = 150;

    double nowUnixSeconds()
    {
        return double(QDateTime::currentSecsSinceEpoch());
    }

    /// Rounded to the digits needed on a learner's page.
    std::string roughly(const FieldValue &value)
    {
        const auto *number = std::get_if<double>(&value);
        return number ? QString::number(*number, 'g', 5).toStdString() : formatFieldValue(value);
    }

} // namespace

LessonGuide::LessonGuide(QMainWindow &window, WindowParts &parts)
    : QObject(&window), m_window(window), m_parts(parts), m_panel(new LessonPanel), m_layout(window, parts, *m_panel),
      m_frame(new PointerFrame(&window))
{
    // Layouts are restored from when a lesson was running.
    connect(dock(), &QDockWidget::visibilityChanged, this, [this](bool isVisible) {
        if (isVisible && !isRunning())
            QMetaObject::invokeMethod(dock(), &QWidget::hide, Qt::QueuedConnection);
    });
    m_watch.setInterval(watchMs);
    connect(&m_watch, &QTimer::timeout, this, &LessonGuide::check);
    connect(m_panel, &LessonPanel::backRequested, this, [this] { goTo(m_isAtEnd ? m_step : m_step - 1); });
    connect(m_panel, &LessonPanel::nextRequested, this, &LessonGuide::goOn);
    connect(m_panel, &LessonPanel::saveRequested, this, &LessonGuide::saveAnswers);
    connect(m_panel, &LessonPanel::answered, this, [this](int choice) {
        if (auto &answer = m_answers.steps[std::size_t(m_step)]; answer.choice < 0) {
            answer.choice = choice;
            answer.choiceUnixSeconds = nowUnixSeconds();
        }
    });
    connect(m_panel, &LessonPanel::leaveRequested, this, &LessonGuide::leave);
    connect(this, &LessonGuide::runningChanged, this,
            [layers = &parts.workbench().layers(), before = std::optional<OutputLayer>()](bool isRunning) mutable {
                if (isRunning && !before)
                    before = layers->chosen();
                layers->setLayer(isRunning ? OutputLayer::Statistic : before.value_or(layers->chosen()));
                if (!isRunning)
                    before.reset();
            }); // lessons speak of the statistic
    window.installEventFilter(this);
}

/// Number keys, which otherwise are shortcuts of the window, answer a question, unless a field takes them.
bool LessonGuide::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::ShortcutOverride && isRunning()
        && m_panel->chooseByKey(*static_cast<QKeyEvent *>(event))) {
        event->accept();
        return true;
    }
    return QObject::eventFilter(watched, event);
}

void LessonGuide::start(const Lesson &lesson, int step)
{
    m_lesson = lesson;
    m_answers.steps.assign(lesson.steps.size(), {});
    m_opened.clear();
    m_experiments.clear();
    goTo(step);
    emit runningChanged(isRunning());
}

void LessonGuide::goTo(int step)
{
    if (step < 0)
        return;
    if (step >= int(m_lesson.steps.size()))
        return end();
    m_watch.stop(); // until a condition has to be watched
    m_step = step;
    m_isReady = m_isRevealed = m_isAtEnd = false;
    m_frame->pointAt(nullptr);
    m_panel->setStep(m_lesson, step);
    m_panel->setWaiting(true);
    set();
    m_watch.start();
}

void LessonGuide::goOn()
{
    if (!m_isAtEnd)
        return goTo(m_step + 1);
    if (const auto next = following())
        emit lessonRequested(*next);
}

void LessonGuide::end()
{
    m_isAtEnd = true;
    m_frame->pointAt(nullptr);
    const auto next = following();
    m_panel->setEnd(m_lesson, m_answers, next ? lessons()[std::size_t(*next)].title : QString());
    emit finished(m_lesson.path);
}

/// The lesson after this one; none after the last and after those that are not bundled.
std::optional<int> LessonGuide::following() const
{
    const auto &all = lessons();
    const auto own =
        std::find_if(all.begin(), all.end(), [&](const Lesson &each) { return each.path == m_lesson.path; });
    if (own == all.end() || own + 1 == all.end())
        return {};
    return int(own + 1 - all.begin());
}

void LessonGuide::saveAnswers(const QString &learner)
{
    const QString name = QFileInfo(m_lesson.path).completeBaseName() + QStringLiteral("-answers.html");
    const QString path = pathOf(QFileDialog::getSaveFileUrl(
        &m_window, tr("Save answers"), QUrl::fromLocalFile(QDir::home().filePath(name)), tr("Web pages (*.html)")));
    if (!path.isEmpty())
        writeAndReport(*this, path, [&] { writeAnswers(path, learner); });
}

void LessonGuide::writeAnswers(const QString &path, const QString &learner) const
{
    writeTextFile(pathBytes(path), answersHtml(m_lesson, m_answers, learner));
}

/// The measures of the task's conditions as they are now.
void LessonGuide::recordTask()
{
    auto &answer = m_answers.steps[std::size_t(m_step)];
    if (std::exchange(answer.isDone, true))
        return;
    answer.doneUnixSeconds = nowUnixSeconds();
    m_parts.document().undoStack().setClean(); // what the lesson asks for need not be saved
    for (const LessonCondition *condition : {&now().until, &now().thenFacts})
        for (const LessonCondition::Part &part : condition->parts)
            if (const auto value = lessonMeasure(m_parts, part.measure))
                answer.measured.emplace_back(part.measure, roughly(*value));
}

/// Settings of the source that this lesson opened, before those of the lesson.
AnalysisSettings LessonGuide::settingsAtOpening() const
{
    return isSessionPath(pathBytes(m_opened)) ? readSession(pathBytes(m_opened)).settings
                                              : firstSettings(m_parts.document().openedSource());
}

bool LessonGuide::isOpen(const QString &path) const
{
    const Document &document = m_parts.document();
    return document.sourcePath() == path || document.sessionPath() == path;
}

/// Opens the source and applies the settings that the step needs; `check` notices when the window has settled.
void LessonGuide::set()
{
    const QString path = m_lesson.steps[std::size_t(openingStep(m_lesson, m_step))].open;
    Document &document = m_parts.document();
    if (isScanScenario(path)) {
        m_opened = path;
        setScans(path);
    } else if (m_opened != path || !isOpen(path)) {
        m_parts.openNow(path, {}, [steps = stepsSinceOpening(m_lesson, m_step)](AnalysisSettings &settings) {
            settings = settingsAfter(steps, settings);
        });
        m_opened = path;
        if (!m_parts.controller().isBusy()) // the user keeps the open document, or the source cannot be opened
            leave();
    } else {
        document.startFrom(settingsAfter(stepsSinceOpening(m_lesson, m_step), settingsAtOpening()));
    }
}

/// Runs the tests of a radar's scenario, unless the same tests are open already.
void LessonGuide::setScans(const QString &path)
{
    try {
        m_parts.openScansOf(path);
    } catch (const Error &error) {
        m_parts.showError(error);
        leave();
    }
}

/// Runs the step's experiment, unless this lesson has done so, and shows its curves.
void LessonGuide::showExperiment()
{
    if (now().experiment.isEmpty())
        return;
    int &id = m_experiments[now().experiment];
    if (m_parts.experiments().entry(id))
        m_parts.panel<ExperimentsPanel>().show(id);
    else
        id = m_parts.panel<ExperimentsPanel>().open(now().experiment);
}

bool LessonGuide::isBusy() const
{
    const auto *experiment = m_parts.experiments().entry(m_experiments.value(now().experiment));
    return m_parts.controller().isBusy() || m_parts.sequentialTests().isBusy() || (experiment && experiment->isOpen());
}

void LessonGuide::check()
{
    if (!isRunning())
        return;
    const bool isOfScans = isScanScenario(m_opened);
    const bool isShown = isOfScans || isOpen(m_opened);
    if (isShown && m_parts.bench().isVisible())
        m_layout.showDock(isOfScans); // its text can be read while the detector runs
    if (isBusy())
        return;
    if (!isShown)
        return leave(); // another document is open now
    m_layout.showDock(isOfScans);
    if (m_isAtEnd)
        return;
    if (!m_isReady && !std::exchange(m_isRevealed, true)) {
        showExperiment();
        return LessonLayout::reveal(widgetNamed(now().point));
    }
    if (!m_isReady) {
        arrange();
        m_isReady = true;
        m_panel->setWaiting(false);
        emit ready();
    }
    m_frame->follow();
    if (!m_panel->isDone() && !now().until.isEmpty() && holds(m_parts, now().until)) {
        m_panel->setDone(true);
        recordTask();
    }
}

/// Scrolls the step's subject into view.
void LessonGuide::arrange()
{
    const LessonStep &step = now();
    Viewport &viewport = m_parts.document().viewport();
    if (step.showsAll)
        viewport.showAll();
    else if (step.zoomSeconds || step.zoomHz)
        viewport.zoomTo(step.zoomSeconds.value_or(viewport.full().time),
                        step.zoomHz.value_or(viewport.full().frequency));
    if (step.cursorSeconds || step.cursorRange || step.cursorBearing)
        m_parts.bench().setPlace({step.cursorSeconds, step.cursorHz, step.cursorRange, step.cursorBearing});
    m_parts.workbench().setRegulationFirst(step.point == QLatin1String("regulation"));
    m_frame->pointAt(pointOut());
    giveKeys();
    if (m_layout.isPresenting())
        keepInSight();
}

/// Brings the parts that the step needs to the front, and returns the one to which it points.
QWidget *LessonGuide::pointOut()
{
    QList<QWidget *> others;
    for (const QString &name : now().show)
        others << widgetNamed(name);
    QWidget *target = widgetNamed(now().point);
    m_layout.pointOut(target, others, !now().task.isEmpty());
    return target;
}

/// To a question that is still open: a field that is pointed to would take its number keys.
void LessonGuide::giveKeys()
{
    if (isRunning() && now().question && m_panel->choice() < 0)
        m_panel->takeKeys();
}

/// Scrolls the step's subject into view again once the panels around it have their size.
void LessonGuide::keepInSight()
{
    constexpr int laidOutMs = 250;
    QTimer::singleShot(laidOutMs, this, [this] {
        if (isRunning() && m_isReady && !m_isAtEnd) {
            m_layout.fit(widgetNamed(now().point)); // now that the width of its text is known
            m_frame->follow();
        }
    });
}

QWidget *LessonGuide::widgetNamed(const QString &name)
{
    if (name.isEmpty())
        return nullptr;
    if (name.startsWith(QLatin1String("setting "))) {
        SettingsForm *form = m_parts.panel<PipelinePanel>().form();
        const QString setting = name.mid(8);
        QWidget *editor = form->editor(setting);
        if (!editor)
            return nullptr;
        LessonLayout::reveal(form);
        form->reveal(setting);
        giveKeys();
        return editor->parentWidget();
    }
    if (name == QLatin1String("regulation"))
        return m_parts.workbench().regulationPlot();
    if (name == QLatin1String("profile"))
        return m_parts.workbench().statisticPlot();
    if (name == QLatin1String("roc"))
        return &m_parts.panel<EvaluatePanel>().roc();
    if (name == QLatin1String("pipeline"))
        return m_parts.panel<PipelinePanel>().form();
    if (name == QLatin1String("readout"))
        return &m_parts.readOut();
    return m_parts.views().named(name);
}

void LessonGuide::present(bool isPresenting)
{
    m_layout.setPresenting(isPresenting);
    // At its end, too: the layout before it may have had other panels in front.
    if (isRunning() && m_isReady && !m_isAtEnd) {
        pointOut();
        m_frame->follow();
        keepInSight();
    }
}

void LessonGuide::leave()
{
    if (!isRunning())
        return;
    m_step = -1;
    m_isAtEnd = false;
    m_opened.clear();
    m_watch.stop();
    m_frame->pointAt(nullptr);
    dock()->hide();
    m_layout.setFormsVisible(true);
    m_parts.workbench().setRegulationFirst(false);
    emit runningChanged(false);
}

} // namespace faintline
