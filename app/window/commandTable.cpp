#include "app/window/MainWindow.h"

#include "app/base/filePath.h"
#include "app/commands/CommandPalette.h"
#include "app/commands/Commands.h"
#include "app/commands/KeysOverlay.h"
#include "app/commands/ToolBar.h"
#include "app/document/OutputLayers.h"
#include "app/document/SessionSaver.h"
#include "app/features/evaluate/ExperimentsPanel.h"
#include "app/features/evaluate/InjectDialog.h"
#include "app/features/events/ComparePanel.h"
#include "app/features/events/EventFiles.h"
#include "app/features/events/EventReviews.h"
#include "app/features/events/ShownEvents.h"
#include "app/features/events/StraightenDialog.h"
#include "app/features/events/chosenEvents.h"
#include "app/features/help/EquationSheet.h"
#include "app/features/opening/WelcomePage.h"
#include "app/features/opening/scenarios.h"
#include "app/features/pictures/BoxAnalysis.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/PlainInput.h"
#include "app/features/pictures/Playback.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/features/settings/LearnMotionDialog.h"
#include "app/features/settings/PipelinePanel.h"
#include "app/lessons/LessonGuide.h"
#include "app/views/ReportWriter.h"
#include "app/views/WindowViews.h"
#include "app/window/Listening.h"
#include "app/window/Opener.h"
#include "app/window/Panels.h"
#include "app/window/currentView.h"
#include "plan/makeDetector.h"
#include "widgets/base/icon.h"
#include "widgets/base/settingWords.h"
#include "widgets/events/EventCard.h"
#include "widgets/events/EventTable.h"
#include "widgets/forms/SettingsForm.h"
#include "widgets/waterfall/waterfallCommands.h"

#include <QApplication>
#include <QFileDialog>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QStackedWidget>

namespace faintline {

/// The table of the main window's commands, a function a menu, and what they alone do.
class CommandTable : public Commands
{
public:
    explicit CommandTable(MainWindow &window);

private:
    static constexpr auto Shown = Command::Shown, Always = Command::Always;

    void addFile();
    void addEdit();
    void addView();
    void addLayers();
    void addLooks();
    void addPlay();
    void addLines();
    void addAnalyse();
    void addHelp();
    void buildToolBar();

    /// An action that holds what is on or off, and is changed in other places as well.
    template <class Set>
    QAction *toggle(const char *name, Set set);
    void connectMarks();
    void connectPlay();
    void connectPresentation();

    /// Brings a panel to the front.
    std::function<void()> show(const char *view)
    {
        return [this, view] { w.showView(QString::fromLatin1(view)); };
    }
    void injectLine();
    void learnMotion();
    void straighten(); ///< along the selected event's track, or the strongest's
    void exportReport();
    void reproduce(const Reproducible &reproducible, bool quick);
    void setTheme(Theme::Kind kind);
    void showEquation(); ///< of the current view
    void showPalette();
    void about();

    MainWindow &w;
    const CommandKey noKey;
    const QString noTip;
    const std::function<void()> noRun;
    KeysOverlay *m_keys;
    EquationSheet *m_equation;
    CommandPalette *m_palette;
    QMenu *m_settings; ///< of the palette
};

CommandTable::CommandTable(MainWindow &window)
    : Commands(window), w(window), m_keys(new KeysOverlay(&window)), m_equation(new EquationSheet(&window)),
      m_palette(new CommandPalette(&window)), m_settings(new QMenu(tr("Setting"), &window))
{
    addFile();
    addEdit();
    addView();
    addLayers();
    addLooks();
    addPlay();
    addLines();
    addAnalyse();
    addHelp();
    buildToolBar();
    connectMarks();
    connectPlay();
    connectPresentation();
}

void CommandTable::addFile()
{
    const auto showIq = [this](QAction &action) {
        action.setCheckable(true);
        action.setChecked(w.m_document.source().options.iq);
        action.setVisible(w.m_opener->canBeIq() || action.isChecked());
    };
    const auto toggleIq = [this] { w.m_opener->takeAsIq(!w.m_document.source().options.iq); };
    add(tr("&File"),
        {{tr("&Open…"), QKeySequence::Open, [this] { w.m_opener->chooseFile(); },
          tr("Open a recording, a scenario or a session"), Always, "open"},
         {tr("Open &folder as one recording…"), noKey, [this] { w.m_opener->chooseFolder(); },
          tr("Put the recordings of a folder on one timeline by their time stamps"), Always},
         {tr("Open as &raw samples…"), noKey, [this] { w.m_opener->chooseRawFile(); }, noTip, Always},
         {tr("&Listen…"), Qt::CTRL | Qt::Key_L, [this] { w.m_listening->ask(); },
          tr("Detect signals in live samples, and record the samples"), Always},
         {tr("New sonar sc&ene"), noKey, [this] { w.m_opener->newScene(); },
          tr("Open a scene of noise, and place targets in it"), Always},
         {.text = tr("Open re&cent"), .entries = [this](QMenu &recent) { w.m_opener->fillRecentMenu(recent); }}});
    for (const auto &examples : {exampleRecordings(), scenarios()})
        for (const Scenario &example : examples)
            add(tr("&File/Exa&mples"), {{example.title, noKey, [this, path = example.path] { w.m_opener->open(path); },
                                         example.sentence, Always}});
    add(tr("&File"), {{tr("&Next file of the folder"), Qt::CTRL | Qt::Key_PageDown, [this] { w.m_opener->goToFile(1); },
                       tr("Open the next recording with the same settings")},
                      {tr("Previo&us file of the folder"), Qt::CTRL | Qt::Key_PageUp,
                       [this] { w.m_opener->goToFile(-1); }, tr("Open the previous recording with the same settings")},
                      {tr("&Welcome page"), noKey, [this] { w.showWelcome(); }, noTip, Always},
                      {},
                      {tr("Take channels as &I and Q"), noKey, toggleIq, noTip, Shown, "", noTip, false, showIq},
                      {},
                      {tr("&Save session"), QKeySequence::Save, [this] { w.m_saver->save(); }},
                      {tr("Save session &as…"), QKeySequence::SaveAs, [this] { w.m_saver->saveAs(); }},
                      {}});
    for (const WindowView &view : windowViews())
        add(tr("&File/Export &picture"),
            {{view.title, noKey, [this, name = view.name] { w.m_views->exportPicture(name); }}});
    add(tr("&File"), {{tr("Export repor&t…"), noKey, [this] { exportReport(); }},
                      {},
                      {tr("&Quit"), Qt::CTRL | Qt::Key_Q, [this] { w.close(); }, noTip, Always}});
}

void CommandTable::addEdit()
{
    QAction *undo = w.m_document.undoStack().createUndoAction(this, tr("&Undo"));
    QAction *redo = w.m_document.undoStack().createRedoAction(this, tr("&Redo"));
    undo->setShortcut(QKeySequence::Undo);
    redo->setShortcuts({QKeySequence(Qt::CTRL | Qt::Key_Y), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_Z)});
    const auto reset = [this] {
        w.m_controller.setSettings(firstSettings(w.m_document.openedSource()), tr("Reset all settings"));
    };
    add(tr("&Edit"), {{.when = Always, .actions = {undo, redo}},
                      {},
                      {tr("Reset all &settings"), noKey, reset},
                      {tr("Save settings as &preset…"), noKey, [this] { w.panel<PipelinePanel>().savePreset(); }},
                      {tr("&Delete preset…"), noKey, [this] { w.panel<PipelinePanel>().removePreset(); }}});
}

void CommandTable::addView()
{
    WaterfallView *input = w.m_workbench->input();
    WaterfallView *output = w.m_workbench->output();
    Viewport *viewport = &w.m_document.viewport();
    PictureDisplay *display = &w.m_document.display();
    add(tr("&View"),
        {{tr("Show &all"), Qt::Key_0, [viewport] { viewport->showAll(); }, tr("The whole recording"), Shown,
          "show-all"},
         {tr("Zoom &back"), Qt::Key_Backspace, [viewport] { viewport->zoomBack(); }},
         {tr("To the &newest frames"), Qt::Key_End, [this] { w.m_document.followNewest(); },
          tr("While listening, go to the newest frames")},
         {},
         {tr("Next &orientation"), Qt::Key_O, [this] { w.bench().firstView()->direction().cycle(); },
          tr("Newest on top, oldest on top, left to right"), Shown, "orientation", tr("Orientation")},
         onOff({tr("&Logarithmic frequency"), Qt::SHIFT | Qt::Key_L,
                [viewport] { viewport->setLogarithmic(!viewport->isLogarithmic()); },
                tr("Show frequencies on a logarithmic scale; not for I/Q, whose frequencies may be negative")},
               [viewport] { return viewport->isLogarithmic(); }),
         onOff({tr("&Radio frequency"), Qt::SHIFT | Qt::Key_R,
                [this] { w.m_workbench->setRadioAxis(!w.m_workbench->isRadioAxis()); },
                tr("Label the frequency axis with the recording's centre frequency added, where it is known")},
               [this] { return w.m_workbench->isRadioAxis(); }),
         {tr("Next &colour map"), Qt::Key_C, [display] { display->cycleColourMap(); }, noTip, Shown, "colours",
          tr("Colours")},
         {tr("A&utomatic range"), Qt::Key_A, [this] { w.bench().setAutomaticRange(); }},
         {.when = Shown, .actions = {w.m_workbench->plainInput().action()}},
         {},
         {tr("&Measure a box"), Qt::Key_M, [display] { display->setMeasuring(!display->isMeasuring()); }},
         {tr("&Harmonics"), Qt::Key_H, noRun, noTip, Shown, "harmonics"},
         {tr("S&idebands"), Qt::Key_I, noRun, noTip, Shown, "sidebands"},
         {tr("Cursor to the pea&k nearby"), Qt::Key_K,
          [input, output] { (input->hasFocus() ? input : output)->moveCursorToPeak(); }},
         {tr("S&pectrum"), Qt::SHIFT | Qt::Key_S, show("spectrum"),
          tr("Spectrum at the cursor, and mean spectrum of the visible part")},
         {tr("C&hannels side by side"), noKey, show("channels"),
          tr("The input of each channel of the recording; a click selects the channel that is analysed")},
         {},
         {.text = tr("P&icture"), .entries = [output](QMenu &menu) { addCommands(menu, *output); }}});
}

/// What the output shows.
void CommandTable::addLayers()
{
    OutputLayers *layers = &w.m_workbench->layers();
    add(tr("&View"), {{tr("What was &found, or the statistic D"), Qt::Key_F, [layers] { layers->toggleFound(); }}});
    const std::pair<QString, OutputLayer> all[]{{tr("Layer: &statistic D"), OutputLayer::Statistic},
                                                {tr("Layer: winning s&lope or range rate"), OutputLayer::Rate},
                                                {tr("Layer: winning &bearing rate"), OutputLayer::SecondRate},
                                                {tr("Layer: path &age since the last reset"), OutputLayer::Age},
                                                {tr("Layer: &resets"), OutputLayer::Reset},
                                                {tr("Layer: &inhibited cells"), OutputLayer::Inhibited},
                                                {tr("Layer: &presence of the tracks"), OutputLayer::Presence}};
    for (const auto &[text, layer] : all) {
        const auto choose = [layers, layer = layer] { layers->setLayer(layer); };
        const auto showState = [layers, layer = layer](QAction &action) {
            action.setCheckable(true);
            action.setChecked(layers->layer() == layer);
            action.setVisible(layers->isOffered(layer));
        };
        add(tr("&View/&Output layer"), {{text, noKey, choose, noTip, Shown, "", noTip, true, showState}});
    }
    add(tr("&View/&Output layer"), {{},
                                    {tr("Layer: &next"), Qt::Key_V, [layers] { layers->cycleLayer(); }},
                                    onOff({tr("Layer &over the statistic"), Qt::SHIFT | Qt::Key_V,
                                           [layers] { layers->setOverlay(!layers->isOverlay()); }},
                                          [layers] { return layers->isOverlay(); })});
    add(tr("&View"), {{tr("Share of &resets and ln K over time"),
                       noKey,
                       {},
                       tr("How much the detector forgets, below the pictures"),
                       Shown,
                       "regulation"}});
    const std::pair<QString, double> bandwidths[]{{tr("of one &bin, as detected"), 0.0},
                                                  {tr("of &1 Hz"), 1.0},
                                                  {tr("of &500 Hz"), 500.0},
                                                  {tr("of &2500 Hz, as WSJT-X gives it"), 2500.0}};
    for (const auto &[text, hz] : bandwidths) {
        const auto setBandwidth = [this, hz = hz] {
            w.m_memory.setSnrBandwidthHz(hz);
            w.m_shownEvents->setSnrBandwidth(hz);
        };
        add(tr("&View/S&NR in the bandwidth"),
            {onOff({text, noKey, setBandwidth, noTip, Always, "", noTip, true},
                   [this, hz = hz] { return hz == w.m_shownEvents->snrBandwidth(); })});
    }
}

/// Panels, layouts, themes.
void CommandTable::addLooks()
{
    add(tr("&View/&Panels"), {{.when = Shown, .actions = w.m_panels->toggleActions()}});
    for (const QString &name : Panels::layoutNames())
        add(tr("&View/La&yout"), {{name, noKey, [this, name] { w.takeLayout(name); }}});
    add(tr("&View/La&yout"),
        {{tr("&Lecture: the pictures alone, full screen"), Qt::Key_F5, noRun, noTip, Shown, "present"}});
    add(tr("&View"), {{tr("Ma&ximise panel"), Qt::Key_F11, [this] { w.m_panels->toggleMaximised(); },
                       tr("Give the whole window to the panel that has the focus, or put it back")}});
    const auto change = [this] {
        setTheme(Theme::kind(w.palette()) == Theme::Kind::Light ? Theme::Kind::Dark : Theme::Kind::Light);
    };
    add(tr("&View/&Theme"), {{tr("Light &or dark"), Qt::Key_F6, change, noTip, Always}, {}});
    const std::pair<QString, Theme::Kind> kinds[]{{tr("&Light"), Theme::Kind::Light},
                                                  {tr("&Dark"), Theme::Kind::Dark},
                                                  {tr("&High contrast"), Theme::Kind::HighContrast}};
    for (const auto &[text, kind] : kinds)
        add(tr("&View/&Theme"),
            {onOff({text, noKey, [this, kind = kind] { setTheme(kind); }, noTip, Always, "", noTip, true},
                   [this, kind = kind] { return Theme::kind(w.palette()) == kind; })});
}

void CommandTable::addPlay()
{
    add(tr("&Play"), {{tr("P&lay"), Qt::Key_Space, noRun, noTip, Shown, "play"}});
    add(tr("&Play/Play &what"), {{.when = Always, .actions = w.m_playback->actions()}});
    add(tr("&Play"),
        {{},
         {tr("Frame &back"), Qt::Key_J, [this] { w.bench().stepFrames(-1); }, noTip, Shown, "step-back"},
         {tr("Frame &forward"), Qt::Key_L, [this] { w.bench().stepFrames(1); }, noTip, Shown, "step-forward"}});
}

/// What is done with single lines and targets.
void CommandTable::addLines()
{
    const auto hear = [this] {
        w.m_playback->chooseLine();
        action("play")->setChecked(true);
    };
    add(tr("&Lines"),
        {{tr("&Next event"), Qt::Key_N, [this] { w.m_events->selectNext(); }, noTip, Shown, "next-event"},
         {tr("&Previous event"), Qt::SHIFT | Qt::Key_N, [this] { w.m_events->selectPrevious(); }},
         {tr("&Why (not) detected"), Qt::Key_W, show("why"), noTip, Shown, "why", tr("Why")},
         {tr("&Hear the line"), Qt::SHIFT | Qt::Key_H, hear, tr("Play the selected event's line alone, at 700 Hz"),
          Shown, "hear", tr("Hear")},
         {},
         {.when = Always, .actions = w.m_reviews->actions()},
         {},
         {tr("Doppler &fit"), Qt::Key_D, show("doppler"),
          tr("Fit a source that passes at constant speed to the selected event's track"), Shown, "doppler"},
         {tr("S&traighten recording along this track…"), Qt::Key_T, [this] { straighten(); }, noTip, Shown,
          "straighten", tr("Straighten…")},
         {tr("Learn &motion from tracks…"), noKey, [this] { learnMotion(); }},
         {},
         {tr("Draw a line &by hand"), Qt::CTRL | Qt::Key_D, show("hand")},
         {tr("Pla&ce sonar targets"), Qt::CTRL | Qt::SHIFT | Qt::Key_D, show("targets"),
          tr("Place the targets of a simulated scene on the map, and edit them in a table")},
         {tr("&Inject a line…"), Qt::CTRL | Qt::Key_I, [this] { injectLine(); }}});
}

/// Runs of the detector, and what tells how good they are.
void CommandTable::addAnalyse()
{
    QAction *presenting = action("present"); // which Escape leaves
    const auto stop = [this, presenting] {
        if (QWidget *list = QApplication::activePopupWidget(); list && !qobject_cast<QMenu *>(list))
            return void(list->close()); // the choices of a field
        presenting->isChecked() ? presenting->setChecked(false) : w.m_controller.stop();
    };
    const auto keep = [this] {
        w.showView(QStringLiteral("compare"));
        w.panel<ComparePanel>().keep();
    };
    const auto test = [this] {
        w.showView(QStringLiteral("sequential"));
        w.panel<SequentialPanel>().startOnSelection();
    };
    add(tr("&Analyse"),
        {{tr("&Run again"), Qt::CTRL | Qt::Key_R, [this] { w.m_controller.run(); }, noTip, Shown, "run", tr("Run")},
         {tr("&Stop"), Qt::Key_Escape, stop, noTip, Always, "stop"},
         {},
         {.when = Always, .actions = w.m_boxAnalysis->actions()},
         {},
         {tr("Threshold &down"), Qt::Key_Comma, [this] { w.m_controller.stepThreshold(-1); }},
         {tr("Threshold &up"), Qt::Key_Period, [this] { w.m_controller.stepThreshold(1); }},
         {},
         {tr("&Keep as A"), Qt::CTRL | Qt::Key_B, keep},
         {tr("Swap &A and B"), Qt::CTRL | Qt::SHIFT | Qt::Key_B, [this] { w.panel<ComparePanel>().swap(); }},
         {tr("&Go to A"), noKey, [this] { w.panel<ComparePanel>().goToA(); }},
         {},
         {tr("&Pd and ROC"), Qt::CTRL | Qt::Key_P, show("pd"),
          tr("How often lines of an SNR are found, at a rate of false alarms")},
         {tr("&Experiments"), noKey, [this] { w.show(w.panel<ExperimentsPanel>()); }},
         {tr("S&weep a setting"), Qt::CTRL | Qt::SHIFT | Qt::Key_P, show("sweep"),
          tr("How often lines are found with each of several values of a setting")},
         {tr("&Noise fit"), noKey, show("noisefit"),
          tr("Whether the recording's noise is as the rate of false alarms assumes")},
         {tr("S&tate space"), Qt::Key_S, show("slice"),
          tr("What the detector holds of every frequency and drift at the cursor's time")},
         {tr("&Latency of pings"), noKey, show("latency")},
         {},
         {tr("Se&quential test"), Qt::CTRL | Qt::Key_T, show("sequential"),
          tr("Decide scan by scan whether there is a target, or go on")},
         {tr("Sequential test on the selecti&on"), Qt::CTRL | Qt::SHIFT | Qt::Key_T, test}});
}

void CommandTable::addHelp()
{
    const auto keys = [this] { m_keys->toggle(currentView(w, w), w.menuBar()->actions()); };
    add(tr("&Help"),
        {{tr("&Keys and mouse"), Qt::Key_F1, keys, noTip, Always, "keys"},
         {tr("&Equation of this view"), Qt::SHIFT | Qt::Key_F1, [this] { showEquation(); }, noTip, Always}});
    action("keys")->setShortcuts(
        {QKeySequence(Qt::Key_F1), QKeySequence(Qt::Key_Question), QKeySequence(Qt::SHIFT | Qt::Key_Question)});
    for (const Lesson &lesson : lessons()) {
        const auto tick = [this, &lesson](QAction &action) {
            const bool isDone = w.m_memory.doneLessons().contains(lesson.path);
            action.setText((isDone ? QStringLiteral("✓ ") : QString()) + lesson.title);
        };
        add(tr("&Help/&Lessons"), {{lesson.title,
                                    noKey,
                                    [this, &lesson] { w.m_opener->startLesson(lesson); },
                                    lesson.sentence,
                                    Always,
                                    "",
                                    {},
                                    false,
                                    tick}});
    }
    add(tr("&Help/&Lessons"),
        {{},
         {tr("&New lesson from what is shown…"), noKey, [this] { w.m_opener->saveLesson(true); }},
         {tr("&Add what is shown to a lesson…"), noKey, [this] { w.m_opener->saveLesson(false); }}});
    const auto isQuick = std::make_shared<bool>(true);
    const QString papers = tr("&Help/&Reproduce a paper’s figure");
    add(papers, {onOff({tr("&Quick: a tenth of the trials"), noKey, [isQuick] { *isQuick = !*isQuick; }, noTip, Always},
                       [isQuick] { return *isQuick; }),
                 {}});
    for (const Reproducible &paper : reproducibles())
        add(papers, {{QString::fromStdString(paper.title), noKey,
                      [this, &paper, isQuick] { reproduce(paper, *isQuick); }, noTip, Always}});
    add(tr("&Help"),
        {{tr("&Find a command or setting…"), Qt::CTRL | Qt::Key_K, [this] { showPalette(); }, noTip, Always},
         {tr("&About Faintline"), noKey, [this] { about(); }, noTip, Always}});
}

void CommandTable::buildToolBar()
{
    auto *bar = new ToolBar(tr("Tools"));
    w.addToolBar(bar);
    bar->setObjectName(QStringLiteral("toolBar"));
    const auto add = [this, bar](std::initializer_list<const char *> names, bool keepsText) {
        for (const char *name : names)
            bar->addAction(action(name), QLatin1String(name), keepsText);
    };
    add({"open"}, true);
    QAction *examples = menu(tr("&File/Exa&mples"))->menuAction();
    examples->setToolTip(tr("Open a recording or a simulated scene that comes with the program"));
    bar->addAction(examples, QStringLiteral("scenario"), true);
    bar->addSeparator();
    add({"run", "stop"}, true);
    bar->addSeparator();
    add({"orientation", "colours", "show-all"}, false);
    bar->addSeparator();
    add({"step-back", "play", "step-forward"}, false);
    bar->addSeparator();
    add({"next-event"}, false);
}

template <class Set>
QAction *CommandTable::toggle(const char *name, Set set)
{
    QAction *action = this->action(name);
    action->setCheckable(true);
    connect(action, &QAction::toggled, this, set);
    return action;
}

void CommandTable::connectMarks()
{
    PictureDisplay *display = &w.m_document.display();
    QAction *harmonics = toggle("harmonics", [display](bool isOn) { display->setHarmonics(isOn); });
    QAction *sidebands = toggle("sidebands", [this](bool isOn) { w.m_workbench->output()->setSidebands(isOn); });
    connect(display, &PictureDisplay::linesChanged, this, [display, harmonics, sidebands] {
        harmonics->setChecked(display->hasHarmonics());
        sidebands->setChecked(display->sidebandSpacing() > 0.0);
    });
    w.m_events->card().setActions({action("why"), action("hear"), harmonics, action("straighten"), action("doppler")});
}

void CommandTable::connectPlay()
{
    QAction *play = toggle("play", [this](bool isPlaying) { w.setPlaying(isPlaying); });
    connect(play, &QAction::toggled, play,
            [play](bool isOn) { play->setIcon(icon(isOn ? QStringLiteral("pause") : QStringLiteral("play"))); });
    connect(w.m_playback, &Playback::playingChanged, play, &QAction::setChecked);
    // Space also presses the focused button, so it plays only in the pictures.
    play->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    w.removeAction(play);
    for (Bench *one : std::initializer_list<Bench *>{w.m_workbench, w.m_pings}) {
        connect(one, &Bench::playingChanged, play, &QAction::setChecked);
        one->addAction(play);
    }
}

void CommandTable::connectPresentation()
{
    toggle("regulation", [this](bool isOn) { w.m_workbench->setRegulationWanted(isOn); })->setChecked(true);
    QAction *stop = action("stop");
    stop->setEnabled(false);
    QAction *presenting = toggle("present", [this, stop](bool isPresenting) {
        stop->setEnabled(isPresenting || w.m_controller.isBusy());
        w.m_panels->setPresenting(isPresenting);
        if (!isPresenting && w.m_pages->currentWidget() == &w.bench())
            w.showBars(); // of what is open now
        Theme::setPlotScale(isPresenting ? 1.5 : 1.0);
        w.m_lessons->present(isPresenting);
    });
    connect(&w.m_controller, &AnalysisController::busyChanged, stop,
            [stop, presenting](bool isBusy) { stop->setEnabled(isBusy || presenting->isChecked()); });
}

void CommandTable::exportReport()
{
    const QString path = QFileDialog::getSaveFileName(
        &w, tr("Export report"), nameBeside(w.m_document.sourcePath(), QStringLiteral(".html")), tr("Report (*.html)"));
    if (!path.isEmpty())
        w.m_report->write(path);
}

void CommandTable::reproduce(const Reproducible &reproducible, bool quick)
{
    ReproduceOptions options;
    options.quick = quick;
    w.showWorkbench();
    w.show(w.panel<ExperimentsPanel>());
    w.m_experiments.start(reproducible, options);
}

void CommandTable::setTheme(Theme::Kind kind)
{
    Theme::apply(kind);
    w.m_memory.setTheme(kind);
}

void CommandTable::showEquation()
{
    const QString name = currentView(w, w);
    const bool isOfTracks =
        w.m_workbench->layers().layer() == OutputLayer::Presence && !w.m_workbench->layers().isOverlay();
    const QString detector = isOfTracks
                                 ? QStringLiteral("presence")
                                 : QString::fromLatin1(detectorNames[w.m_document.settings().detector.index()].data());
    // If the first view is a map, input and output are maps, too.
    const bool isMap = w.bench().firstViewName() == QLatin1String("map")
                       && (name == QLatin1String("input") || name == QLatin1String("output"));
    m_equation->toggle(equationOf(isMap ? QStringLiteral("map") : name, detector), w.m_lessons->widgetNamed(name));
}

void CommandTable::showPalette()
{
    refresh();
    m_settings->clear();
    QList<QAction *> commands = w.menuBar()->actions();
    if (w.m_pages->currentWidget() != w.m_welcome) {
        SettingsForm *form = w.panel<PipelinePanel>().form();
        for (const auto &field : AnalysisSettings::fields()) {
            const QString name = QString::fromStdString(field.name);
            if (!form->isOffered(name))
                continue;
            const QString stage = stageLabel(name.section(QLatin1Char('.'), 0, 0));
            m_settings->addAction(QStringLiteral("%1: %2").arg(stage, settingLabel(name)), [this, form, name] {
                w.show(w.panel<PipelinePanel>());
                form->reveal(name);
            });
        }
        commands << m_settings->menuAction();
    }
    m_palette->open(commands);
}

void CommandTable::about()
{
    QMessageBox::about(&w, tr("About Faintline"),
                       tr("<b>Faintline %1</b><p>Track-before-detect for faint lines that drift and wander.</p>"
                          "<p>Free software under the GNU General Public License, version 3 or later.</p>"
                          "<p>Based in part on the work of the Qwt project (http://qwt.sf.net).</p>")
                           .arg(QStringLiteral(FAINTLINE_VERSION)));
}

void CommandTable::injectLine()
{
    const auto &analysis = w.m_document.analysis();
    if (!analysis || !analysis->frames->geometry().isOfSpectra())
        return;
    const RecordingInfo &info = w.m_document.recording()->info();
    const Viewport &viewport = w.m_document.viewport();
    const Viewport::Point at =
        viewport.cursor().value_or(Viewport::Point{viewport.full().time.middle(), viewport.full().frequency.middle()});
    InjectDialog dialog(info, at.seconds, at.hz, analysis->frames->geometry().windowSeconds, &w);
    if (dialog.exec() == QDialog::Accepted)
        w.m_controller.inject(dialog.line());
}

void CommandTable::learnMotion()
{
    if (!w.m_document.analysis())
        return;
    auto *dialog = new LearnMotionDialog(w.m_document.analysis(), w.m_controller, &w);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void CommandTable::straighten()
{
    const std::vector<Event> events = chosenEvents(w.m_document, *w.m_events);
    if (!w.m_document.lineAnalysis() || !w.m_document.recording() || events.empty())
        return w.showError(Error(tr("Straighten").toStdString(), "requires a recording with an event to follow"));
    auto *dialog = new StraightenDialog(w.m_document, events.front(), w.m_reviews->files().provenance(), &w);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &StraightenDialog::written, &w, &MainWindow::showWritten);
    dialog->open();
}

Commands *makeCommands(MainWindow &window)
{
    return new CommandTable(window);
}

} // namespace faintline
