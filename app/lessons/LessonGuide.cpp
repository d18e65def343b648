#include "app/lessons/LessonGuide.h"

#include "app/base/MessageBar.h"
#include "app/document/scanScenario.h"
#include "app/lessons/LessonPanel.h"
#include "app/lessons/PointerFrame.h"
#include "app/lessons/lessonMeasures.h"
#include "app/panels/PipelinePanel.h"
#include "app/panels/SequentialPanel.h"
#include "app/views/WindowParts.h"
#include "app/views/WindowViews.h"
#include "app/workspace/PingBench.h"
#include "app/workspace/Workbench.h"
#include "widgets/base/ReadOut.h"
#include "widgets/forms/SettingsForm.h"
#include "widgets/plot/StripPlot.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QTabWidget>

#include <utility>

namespace faintline {

namespace {

    constexpr int watchMs = 150;

    /// Words a shown lesson's panel has room for, as a share of the window.
    constexpr int panelPercent = 22;

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

} // namespace

LessonGuide::LessonGuide(QMainWindow &window, WindowParts &parts)
    : QObject(&window), m_window(window), m_parts(parts), m_dock(new QDockWidget(tr("Lesson"), &window)),
      m_panel(new LessonPanel), m_frame(new PointerFrame(&window))
{
    m_dock->setObjectName(QStringLiteral("lessonDock"));
    m_dock->setWidget(m_panel);
    m_dock->setFeatures(QDockWidget::DockWidgetMovable
                        | QDockWidget::DockWidgetFloatable); // a lesson is left with its button
    m_dock->hide();
    // Layouts are restored from when a lesson was running.
    connect(m_dock, &QDockWidget::visibilityChanged, this, [this](bool isVisible) {
        if (isVisible && !isRunning())
            QMetaObject::invokeMethod(m_dock, &QWidget::hide, Qt::QueuedConnection);
    });
    m_watch.setInterval(watchMs);
    connect(&m_watch, &QTimer::timeout, this, &LessonGuide::check);
    connect(m_panel, &LessonPanel::backRequested, this, [this] { goTo(m_step - 1); });
    connect(m_panel, &LessonPanel::nextRequested, this, [this] { goTo(m_step + 1); });
    connect(m_panel, &LessonPanel::leaveRequested, this, &LessonGuide::leave);
}

void LessonGuide::start(const Lesson &lesson, int step)
{
    m_lesson = lesson;
    m_opened.clear();
    goTo(step);
    emit runningChanged(isRunning());
}

void LessonGuide::goTo(int step)
{
    if (step < 0)
        return;
    if (step >= int(m_lesson.steps.size())) {
        leave();
        return emit finished();
    }
    m_watch.stop(); // until a condition has to be watched
    m_step = step;
    m_isReady = m_isRevealed = false;
    m_frame->pointAt(nullptr);
    m_panel->setStep(m_lesson, step);
    m_panel->setWaiting(true);
    set();
    m_watch.start();
}

int LessonGuide::openingStep() const
{
    int opening = m_step;
    while (m_lesson.steps[std::size_t(opening)].open.isEmpty())
        --opening;
    return opening;
}

/// Those since something was opened, up to the present one.
std::vector<LessonStep> LessonGuide::stepsNow() const
{
    return {m_lesson.steps.begin() + openingStep(), m_lesson.steps.begin() + m_step + 1};
}

/// Opens the source and applies the settings that the step needs; `check` notices when the window has settled.
void LessonGuide::set()
{
    const QString path = m_lesson.steps[std::size_t(openingStep())].open;
    Document &document = m_parts.document();
    if (isScanScenario(path)) {
        m_opened = path;
        setScans(path);
    } else if (m_opened != path || document.source().path != path) {
        m_parts.openNow(
            path, {}, [steps = stepsNow()](AnalysisSettings &settings) { settings = settingsAfter(steps, settings); });
        m_opened = path;
        if (!m_parts.controller().isBusy()) // the user keeps the open document, or the source cannot be opened
            leave();
    } else {
        const bool wasSaved = !document.isModified();
        document.edit(settingsAfter(stepsNow(), firstSettings(document.openedSource())),
                      tr("Lesson: %1").arg(now().title));
        if (wasSaved)
            document.undoStack().setClean(); // changes made by a lesson need not be saved
    }
}

/// Runs the tests of a radar's scenario, unless the same tests are open already.
void LessonGuide::setScans(const QString &path)
{
    try {
        m_parts.openScansOf(path);
    } catch (const Error &error) {
        m_parts.messages().showMessage(MessageBar::Kind::Error, QString::fromStdString(error.where()),
                                       QString::fromStdString(error.why()));
        leave();
    }
}

bool LessonGuide::isBusy() const
{
    return m_parts.controller().isBusy() || m_parts.sequentialTests().isBusy();
}

void LessonGuide::check()
{
    if (!isRunning() || isBusy())
        return;
    const bool isOfScans = isScanScenario(m_opened);
    if (!isOfScans && m_parts.document().source().path != m_opened)
        return leave(); // another document is open now
    showPanel();
    if (!m_isReady && !std::exchange(m_isRevealed, true))
        return reveal(widgetNamed(now().point));
    if (!m_isReady) {
        arrange();
        m_isReady = true;
        m_panel->setWaiting(false);
        emit ready();
    }
    m_frame->follow();
    if (!m_panel->isDone() && !now().until.isEmpty() && holds(m_parts, now().until))
        m_panel->setDone(true);
}

/// Scrolls the step's subject into view.
void LessonGuide::arrange()
{
    const LessonStep &step = now();
    for (const QString &name : step.show)
        reveal(widgetNamed(name));
    Viewport &viewport = m_parts.document().viewport();
    if (step.showsAll)
        viewport.showAll();
    else if (step.zoomSeconds || step.zoomHz)
        viewport.zoomTo(step.zoomSeconds.value_or(viewport.full().time),
                        step.zoomHz.value_or(viewport.full().frequency));
    if (step.cursorSeconds || step.cursorRange || step.cursorBearing)
        m_parts.bench().setPlace({step.cursorSeconds, step.cursorHz, step.cursorRange, step.cursorBearing});
    QWidget *target = widgetNamed(step.point);
    reveal(target);
    m_frame->pointAt(target);
}

/// Raises it among its tabs.
void LessonGuide::reveal(QWidget *widget)
{
    for (QWidget *each = widget; each; each = each->parentWidget()) {
        auto *above = each->parentWidget() ? qobject_cast<QTabWidget *>(each->parentWidget()->parentWidget()) : nullptr;
        if (above && above->indexOf(each) >= 0)
            above->setCurrentWidget(each);
        if (auto *dock = qobject_cast<QDockWidget *>(each)) {
            dock->show();
            dock->raise();
        }
    }
}

QWidget *LessonGuide::widgetNamed(const QString &name)
{
    if (name.isEmpty())
        return nullptr;
    if (name.startsWith(QLatin1String("setting "))) {
        SettingsForm *form = m_parts.pipeline().form();
        const QString setting = name.mid(8);
        QWidget *editor = form->editor(setting);
        if (!editor)
            return nullptr;
        reveal(form);
        form->reveal(setting);
        return editor->parentWidget();
    }
    if (name == QLatin1String("regulation"))
        return m_parts.workbench().regulationPlot();
    if (name == QLatin1String("profile"))
        return m_parts.workbench().statisticPlot();
    if (name == QLatin1String("pipeline"))
        return m_parts.pipeline().form();
    if (name == QLatin1String("readout"))
        return &m_parts.readOut();
    return m_parts.views().named(name);
}

void LessonGuide::showPanel()
{
    if (!m_dock->isHidden())
        return;
    m_window.addDockWidget(Qt::LeftDockWidgetArea, m_dock, Qt::Vertical);
    auto *below = m_window.findChild<QDockWidget *>(QStringLiteral("pipelineDock"));
    if (below && m_window.dockWidgetArea(below) == Qt::LeftDockWidgetArea) {
        m_window.splitDockWidget(m_dock, below, Qt::Vertical);
        m_dock->show();
        if (!below->isHidden())
            m_window.resizeDocks({m_dock, below}, {7, 3}, Qt::Vertical);
    }
    m_dock->show();
    m_window.resizeDocks({m_dock}, {m_window.width() * panelPercent / 100}, Qt::Horizontal);
}

/// In a presentation the text is larger, and only the panels that the step needs are visible.
void LessonGuide::present(bool isPresenting)
{
    m_panel->setLarge(isPresenting);
    if (isRunning() && isPresenting && m_isReady) {
        for (const QString &name : now().show)
            reveal(widgetNamed(name));
        reveal(widgetNamed(now().point));
        if (auto *below = m_window.findChild<QDockWidget *>(QStringLiteral("pipelineDock"));
            below && below->isVisible())
            m_window.resizeDocks({m_dock, below}, {5, 1}, Qt::Vertical);
        m_frame->follow();
    }
}

void LessonGuide::leave()
{
    if (!isRunning())
        return;
    m_step = -1;
    m_opened.clear();
    m_watch.stop();
    m_frame->pointAt(nullptr);
    m_dock->hide();
    emit runningChanged(false);
}

} // namespace faintline
