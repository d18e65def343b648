// Menus and tool bar of the main window: all actions with their keys, except those of the View menu.

#include "app/window/MainWindow.h"

#include "app/control/BoxAnalysis.h"
#include "app/control/EventReviews.h"
#include "app/control/Playback.h"
#include "app/document/SessionSaver.h"
#include "app/document/scenarios.h"
#include "app/help/KeysOverlay.h"
#include "app/lessons/LessonGuide.h"
#include "app/lessons/LessonList.h"
#include "app/panels/ComparePanel.h"
#include "app/panels/EvaluatePanel.h"
#include "app/panels/ExperimentsPanel.h"
#include "app/panels/PipelinePanel.h"
#include "app/panels/SequentialPanel.h"
#include "app/views/WindowViews.h"
#include "app/welcome/WelcomePage.h"
#include "app/window/CommandPalette.h"
#include "app/window/Panels.h"
#include "app/window/ToolBar.h"
#include "app/window/currentView.h"
#include "app/window/settingCommands.h"
#include "app/workspace/PingBench.h"
#include "app/workspace/Workbench.h"
#include "widgets/base/icon.h"
#include "widgets/events/EventCard.h"
#include "widgets/events/EventTable.h"

#include <QMenu>
#include <QMenuBar>
#include <QStackedWidget>
#include <QToolButton>

namespace faintline {

void MainWindow::buildMenus()
{
    buildFileMenu();
    buildEditMenu();
    buildViewMenu();
    buildPlayMenu();
    buildLinesMenu();
    buildAnalyseMenu();
    buildHelpMenu();
    nameWhatHolds();
    // Shortcuts of a hidden menu do not work, so add the actions to the window for presentations.
    for (const QAction *menu : menuBar()->actions())
        for (QAction *action : menu->menu()->actions())
            if (action != m_playAction)
                addAction(action);
}

/// Names focusable container widgets after the panel that contains them.
void MainWindow::nameWhatHolds()
{
    for (QWidget *widget : findChildren<QWidget *>()) {
        const bool isHolder = widget->inherits("QScrollArea") || widget->inherits("QTabWidget");
        if (!isHolder || !widget->accessibleName().isEmpty())
            continue;
        QWidget *panel = widget->parentWidget();
        while (panel && panel->windowTitle().isEmpty() && panel != this)
            panel = panel->parentWidget();
        widget->setAccessibleName(panel && panel != this ? panel->windowTitle() : tr("Welcome"));
    }
}

void MainWindow::buildFileMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&File"));
    menu->addAction(tr("&Open…"), QKeySequence::Open, this, &MainWindow::chooseFile);
    menu->addAction(tr("Open &folder as one recording…"), this, &MainWindow::chooseFolder)
        ->setToolTip(tr("Put the recordings of a folder on one timeline by their time stamps"));
    menu->addAction(tr("Open as &raw samples…"), this, &MainWindow::chooseRawFile);
    menu->addAction(tr("&Listen…"), QKeySequence(Qt::CTRL | Qt::Key_L), this, &MainWindow::listen)
        ->setToolTip(tr("Detect signals in live samples, and record the samples"));
    menu->addAction(tr("New sonar sc&ene"), this, [this] { newScene(); })
        ->setToolTip(tr("Open a scene of noise, and place targets in it"));
    m_recentMenu = menu->addMenu(tr("Open re&cent"));
    connect(m_recentMenu, &QMenu::aboutToShow, this, &MainWindow::fillRecentMenu);
    addViewAction(*menu, tr("&Next file of the folder"), QKeySequence(Qt::CTRL | Qt::Key_PageDown), [this] {
        goToFile(1);
    })->setToolTip(tr("Open the next recording with the same settings"));
    addViewAction(*menu, tr("Previo&us file of the folder"), QKeySequence(Qt::CTRL | Qt::Key_PageUp), [this] {
        goToFile(-1);
    })->setToolTip(tr("Open the previous recording with the same settings"));
    menu->addAction(tr("&Welcome page"), this, &MainWindow::showWelcome);
    menu->addSeparator();
    m_iqAction = addViewAction(*menu, tr("Take channels as &I and Q"), {}, [this] {
        OpenOptions options = m_document.source().options;
        options.iq = m_iqAction->isChecked();
        m_controller.reopen(options);
    });
    m_iqAction->setCheckable(true);
    menu->addSeparator();
    addViewAction(*menu, tr("&Save session"), QKeySequence::Save, [this] { m_saver->save(); });
    addViewAction(*menu, tr("Save session &as…"), QKeySequence::SaveAs, [this] { m_saver->saveAs(); });
    menu->addSeparator();
    QMenu *pictures = menu->addMenu(tr("Export &picture"));
    for (const WindowView &view : windowViews())
        pictures->addAction(view.title, this, [this, name = view.name] { m_views->exportPicture(name); });
    m_viewActions.push_back(pictures->menuAction());
    addViewAction(*menu, tr("Export repor&t…"), {}, [this] { exportReport(); });
    menu->addSeparator();
    menu->addAction(tr("&Quit"), QKeySequence(Qt::CTRL | Qt::Key_Q), this, &QWidget::close);
}

void MainWindow::buildEditMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&Edit"));
    QAction *undo = m_document.undoStack().createUndoAction(this, tr("&Undo"));
    QAction *redo = m_document.undoStack().createRedoAction(this, tr("&Redo"));
    undo->setShortcut(QKeySequence::Undo);
    redo->setShortcuts({QKeySequence(Qt::CTRL | Qt::Key_Y), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_Z)});
    menu->addActions({undo, redo});
    menu->addSeparator();
    addViewAction(*menu, tr("Reset all &settings"), {}, [this] {
        m_controller.setSettings(firstSettings(m_document.openedSource()), tr("Reset all settings"));
    });
    addViewAction(*menu, tr("Save settings as &preset…"), {}, [this] { m_pipeline->savePreset(); });
    addViewAction(*menu, tr("&Delete preset…"), {}, [this] { m_pipeline->removePreset(); });
}

void MainWindow::buildPlayMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&Play"));
    m_playAction = addViewAction(*menu, tr("P&lay"), Qt::Key_Space, {});
    m_playAction->setCheckable(true);
    connect(m_playAction, &QAction::toggled, this, &MainWindow::setPlaying);
    connect(m_playback, &Playback::playingChanged, m_playAction, &QAction::setChecked);
    for (Bench *one : std::initializer_list<Bench *>{m_workbench, m_pings})
        connect(one, &Bench::playingChanged, m_playAction, &QAction::setChecked);
    // Space also presses the focused button, so it plays only in the pictures.
    m_playAction->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    m_workbench->addAction(m_playAction);
    m_pings->addAction(m_playAction);
    m_playback->addActionsTo(*menu->addMenu(tr("Play &what")));
    menu->addSeparator();
    addViewAction(*menu, tr("Frame &back"), Qt::Key_J, [this] { bench().stepFrames(-1); });
    addViewAction(*menu, tr("Frame &forward"), Qt::Key_L, [this] { bench().stepFrames(1); });
}

/// What is done with single lines and targets.
void MainWindow::buildLinesMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&Lines"));
    menu->setToolTipsVisible(true);
    addViewAction(*menu, tr("&Next event"), Qt::Key_N, [this] { m_events->selectNext(); });
    addViewAction(*menu, tr("&Previous event"), QKeySequence(Qt::SHIFT | Qt::Key_N),
                  [this] { m_events->selectPrevious(); });
    QAction *why = addViewAction(*menu, tr("&Why (not) detected"), QKeySequence(Qt::Key_W),
                                 [this] { showView(QStringLiteral("why")); });
    QAction *hear = addViewAction(*menu, tr("&Hear the line"), QKeySequence(Qt::SHIFT | Qt::Key_H), [this] {
        m_playback->chooseLine();
        m_playAction->setChecked(true);
    });
    hear->setToolTip(tr("Play the selected event's line alone, at 700 Hz"));
    menu->addSeparator();
    m_reviews->addActionsTo(*menu);
    menu->addSeparator();
    QAction *doppler =
        addViewAction(*menu, tr("Doppler &fit"), Qt::Key_D, [this] { showView(QStringLiteral("doppler")); });
    doppler->setToolTip(tr("Fit a source that passes at constant speed to the selected event's track"));
    QAction *straight =
        addViewAction(*menu, tr("S&traighten recording along this track…"), Qt::Key_T, [this] { straighten(); });
    straight->setIconText(tr("Straighten…"));
    why->setIconText(tr("Why"));
    hear->setIconText(tr("Hear"));
    m_events->card().setActions({why, hear, m_harmonicsAction, straight, doppler});
    addViewAction(*menu, tr("Learn &motion from tracks…"), {}, [this] { learnMotion(); });
    menu->addSeparator();
    addViewAction(*menu, tr("Draw a line &by hand"), QKeySequence(Qt::CTRL | Qt::Key_D),
                  [this] { showView(QStringLiteral("hand")); });
    addViewAction(*menu, tr("Pla&ce sonar targets"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_D), [this] {
        showView(QStringLiteral("targets"));
    })->setToolTip(tr("Place the targets of a simulated scene on the map, and edit them in a table"));
    addViewAction(*menu, tr("&Inject a line…"), QKeySequence(Qt::CTRL | Qt::Key_I), [this] { injectLine(); });
}

/// Runs of the detector, and what tells how good they are.
void MainWindow::buildAnalyseMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&Analyse"));
    menu->setToolTipsVisible(true);
    addViewAction(*menu, tr("&Run again"), QKeySequence(Qt::CTRL | Qt::Key_R), [this] { m_controller.run(); });
    m_stopAction = menu->addAction(tr("&Stop"), QKeySequence(Qt::Key_Escape), &m_controller, &AnalysisController::stop);
    m_stopAction->setEnabled(false);
    m_boxAnalysis->addActionsTo(*menu);
    menu->addSeparator();
    addViewAction(*menu, tr("Threshold &down"), Qt::Key_Comma, [this] { m_controller.stepThreshold(-1); });
    addViewAction(*menu, tr("Threshold &up"), Qt::Key_Period, [this] { m_controller.stepThreshold(1); });
    menu->addSeparator();
    addViewAction(*menu, tr("&Keep as A"), QKeySequence(Qt::CTRL | Qt::Key_B), [this] {
        showView(QStringLiteral("compare"));
        m_compare->keep();
    });
    addViewAction(*menu, tr("Swap &A and B"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_B),
                  [this] { m_compare->swap(); });
    addViewAction(*menu, tr("&Go to A"), {}, [this] { m_compare->goToA(); });
    menu->addSeparator();
    addViewAction(*menu, tr("&Pd and ROC"), QKeySequence(Qt::CTRL | Qt::Key_P), [this] {
        m_panels->show(m_evaluate);
    })->setToolTip(tr("How often lines of an SNR are found, at a rate of false alarms"));
    addViewAction(*menu, tr("&Experiments"), {}, [this] { m_panels->show(m_experimentList); });
    addViewAction(*menu, tr("S&weep a setting"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_P), [this] {
        showView(QStringLiteral("sweep"));
    })->setToolTip(tr("How often lines are found with each of several values of a setting"));
    addViewAction(*menu, tr("&Noise fit"), {}, [this] {
        showView(QStringLiteral("noisefit"));
    })->setToolTip(tr("Whether the recording's noise is as the rate of false alarms assumes"));
    addViewAction(*menu, tr("S&tate space"), Qt::Key_S, [this] {
        showView(QStringLiteral("slice"));
    })->setToolTip(tr("What the detector holds of every frequency and drift at the cursor's time"));
    addViewAction(*menu, tr("&Latency of pings"), {}, [this] { showView(QStringLiteral("latency")); });
    menu->addSeparator();
    addViewAction(*menu, tr("Se&quential test"), QKeySequence(Qt::CTRL | Qt::Key_T), [this] {
        m_panels->show(m_sequential);
    })->setToolTip(tr("Decide scan by scan whether there is a target, or go on"));
    addViewAction(*menu, tr("Sequential test on the selecti&on"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_T),
                  [this] {
                      m_panels->show(m_sequential);
                      m_sequential->startOnSelection();
                  });
}

void MainWindow::addReproductions(QMenu &help)
{
    QMenu *menu = help.addMenu(tr("&Reproduce a paper’s figure"));
    QAction *quick = menu->addAction(tr("&Quick: a tenth of the trials"));
    quick->setCheckable(true);
    quick->setChecked(true);
    menu->addSeparator();
    for (const Reproducible &entry : reproducibles()) {
        QAction *action = menu->addAction(QString::fromStdString(entry.title));
        action->setData(QString::fromStdString(entry.name));
        connect(action, &QAction::triggered, this, [this, &entry, quick] { reproduce(entry, quick->isChecked()); });
    }
}

void MainWindow::buildHelpMenu()
{
    QMenu *menu = menuBar()->addMenu(tr("&Help"));
    QAction *keys = menu->addAction(tr("&Keys and mouse"), this, [this] { m_keys->toggle(currentView(*this, *this)); });
    keys->setShortcuts(
        {QKeySequence(Qt::Key_F1), QKeySequence(Qt::Key_Question), QKeySequence(Qt::SHIFT | Qt::Key_Question)});
    menu->addAction(tr("&Equation of this view"), QKeySequence(Qt::SHIFT | Qt::Key_F1), this,
                    &MainWindow::showEquation);
    addLessonMenu(*menu);
    addReproductions(*menu);
    m_settingsMenu = new QMenu(tr("Setting"), this);
    menu->addAction(tr("&Find a command or setting…"), QKeySequence(Qt::CTRL | Qt::Key_K), this,
                    &MainWindow::showPalette);
    menu->addAction(tr("&About Faintline"), this, &MainWindow::about);
}

void MainWindow::showPalette()
{
    m_settingsMenu->clear();
    QList<QAction *> commands = menuBar()->actions();
    if (m_pages->currentWidget() != m_welcome) {
        listSettings(*m_settingsMenu, *m_pipeline->form(), [this] { m_panels->show(m_pipeline); });
        commands << m_settingsMenu->menuAction();
    }
    m_palette->open(commands);
}

void MainWindow::addLessonMenu(QMenu &menu)
{
    QMenu *all = menu.addMenu(tr("&Lessons"));
    for (const Lesson &lesson : lessons())
        all->addAction(lesson.title, this, [this, &lesson] { startLesson(lesson); })->setToolTip(lesson.sentence);
    const auto tick = [this, actions = all->actions()] {
        const QStringList done = m_memory.doneLessons();
        m_lessonList->setDone(done);
        for (std::size_t i = 0; i < lessons().size(); ++i) {
            const Lesson &lesson = lessons()[i];
            actions[qsizetype(i)]->setText((done.contains(lesson.path) ? QStringLiteral("✓ ") : QString())
                                           + lesson.title);
        }
    };
    tick();
    all->addSeparator();
    addViewAction(*all, tr("&New lesson from what is shown…"), {}, [this] { saveLesson(true); });
    addViewAction(*all, tr("&Add what is shown to a lesson…"), {}, [this] { saveLesson(false); });
    connect(m_lessons, &LessonGuide::finished, this, [this, tick](const QString &path) {
        m_memory.addDoneLesson(path);
        tick();
    });
}

QAction *MainWindow::addViewAction(QMenu &menu, const QString &text, const QKeySequence &key,
                                   std::function<void()> action)
{
    QAction *result = menu.addAction(text);
    result->setShortcut(key);
    if (action)
        connect(result, &QAction::triggered, this, action);
    m_viewActions.push_back(result);
    return result;
}

void MainWindow::buildToolBar()
{
    auto *bar = new ToolBar(tr("Tools"));
    addToolBar(bar);
    bar->setObjectName(QStringLiteral("toolBar"));
    const auto add = [this, bar](const QString &text, const char *icon, const QString &toolTip, bool keepsText,
                                 auto action) {
        auto *result = new QAction(text, bar);
        connect(result, &QAction::triggered, this, action);
        result->setToolTip(toolTip);
        bar->addAction(result, QString::fromLatin1(icon), keepsText);
        return result;
    };
    const auto addOfView = [&](const QString &text, const char *icon, const QString &toolTip, bool keepsText,
                               auto action) { m_viewActions.push_back(add(text, icon, toolTip, keepsText, action)); };
    add(tr("Open…"), "open", tr("Open a recording, a scenario or a session (Ctrl+O)"), true, &MainWindow::chooseFile);

    auto *scenarioMenu = new QMenu(this);
    const auto addExamples = [this, scenarioMenu](const std::vector<Scenario> &examples) {
        for (const Scenario &example : examples)
            scenarioMenu->addAction(example.title, this, [this, path = example.path] { open(path); })
                ->setToolTip(example.sentence);
    };
    addExamples(exampleRecordings());
    scenarioMenu->addSeparator();
    addExamples(scenarios());
    auto *scenarioButton = new QToolButton;
    scenarioButton->setText(tr("Examples"));
    scenarioButton->setToolTip(tr("Open a recording or a simulated scene that comes with the program"));
    scenarioButton->setMenu(scenarioMenu);
    scenarioButton->setPopupMode(QToolButton::InstantPopup);
    bar->addButton(scenarioButton, QStringLiteral("scenario"), true);
    bar->addSeparator();

    addOfView(tr("Run"), "run", tr("Run the chain again (Ctrl+R)"), true, [this] { m_controller.run(); });
    bar->addAction(m_stopAction, QStringLiteral("stop"), true);
    bar->addSeparator();
    addOfView(tr("Orientation"), "orientation", tr("Newest on top, oldest on top, left to right (O)"), false,
              [this] { bench().cycleOrientation(); });
    addOfView(tr("Colours"), "colours", tr("Next colour map (C)"), false, [this] { bench().cycleColourMap(); });
    addOfView(tr("Show all"), "show-all", tr("The whole recording (0)"), false,
              [this] { m_document.viewport().showAll(); });
    bar->addSeparator();
    addOfView(tr("Frame back"), "step-back", tr("One frame back (J)"), false, [this] { bench().stepFrames(-1); });
    bar->addAction(m_playAction, QStringLiteral("play"), false);
    connect(m_playAction, &QAction::toggled, this, [this](bool isPlaying) {
        m_playAction->setIcon(icon(isPlaying ? QStringLiteral("pause") : QStringLiteral("play")));
    });
    addOfView(tr("Frame forward"), "step-forward", tr("One frame forward (L)"), false,
              [this] { bench().stepFrames(1); });
    bar->addSeparator();
    addOfView(tr("Next event"), "next-event", tr("Go to the next event (N)"), false,
              [this] { m_events->selectNext(); });
}

} // namespace faintline
