#pragma once

#include "app/control/LiveRun.h"
#include "app/document/recordingFiles.h"
#include "app/views/WindowParts.h"
#include "app/window/WindowMemory.h"
#include "widgets/base/Theme.h"

#include <QMainWindow>

#include <memory>

class QLabel;
class QMenu;
class QStackedWidget;
class QToolBar;

namespace faintline {

class ActivityBar;
class BoxAnalysis;
class ChartMenus;
class CommandPalette;
class Commands;
class EquationSheet;
class KeysOverlay;
class ListenDialog;
class LiveBar;
class LessonGuide;
class LessonList;
struct Lesson;
class OverviewStrip;
class OwnPresets;
class Panels;
class Playback;
class ReportWriter;
class SessionSaver;
class TrialViewer;

/// The main window: arranges the panels and connects them to the document and its controller.
class MainWindow : public QMainWindow, public WindowParts
{
    Q_OBJECT

public:
    /// `memory`: stores recent files and the window's layout; null: stores nothing. `recoveryFolder`: holds unsaved
    /// work.
    explicit MainWindow(std::unique_ptr<QSettings> memory = {}, const QString &recoveryFolder = {},
                        QWidget *parent = nullptr);
    ~MainWindow() override;

    /// Opens a recording, a scenario or a session. Asks only for what the file does not contain.
    void open(const QString &path, const OpenOptions &options = {}, const AnalysisController::Adjust &adjust = {});
    void openNow(const QString &path, const OpenOptions &options = {},
                 const AnalysisController::Adjust &adjust = {}) override;
    void showWelcome();
    /// Offers to restore unsaved work left by a crash.
    void offerRecovery();

    TrialViewer &trials() { return *m_trials; }
    LessonGuide &lessonGuide() { return *m_lessons; }
    ChartMenus &chartMenus() { return *m_chartMenus; }

    void openScans(const ScanTest &test) override;

    /// Listens to a source and records into a folder, in files of limited length, with these settings or those of the
    /// open document, which is closed. At the end the recording is opened.
    void listenTo(LiveRun::OpenSource source, const QString &folder,
                  const std::optional<AnalysisSettings> &settings = {}, const RotationSettings &rotation = {});
    LiveRun &live() { return *m_live; }
    LiveBar &liveBar() { return *m_liveBar; }

    void showView(const QString &name); ///< brings its panel to the front
    void newScene();                    ///< of sonar pings, without targets
    void learnMotion();
    void setPlaying(bool isPlaying);
    void straighten(); ///< along the selected event's track, or the strongest's

    /// Off: shows no dialogs.
    void setAsking(bool isAsking);

signals:
    void saved(const QString &sessionPath);

protected:
    void closeEvent(QCloseEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    /// Tab passes over panels that lie behind another one's tab.
    bool focusNextPrevChild(bool next) override;

private:
    friend class CommandTable;

    void showBars();
    void putBenchAside();
    void buildCentre();
    void buildPanels();
    void buildDocks();
    void buildSettingsDock();
    void buildBottom();
    void buildStatusBar();
    void nameWhatHolds();
    void buildToolBar();
    void connectCommands();
    void connectDocument();
    void connectController();
    void connectWelcome(); ///< and the lessons
    void connectEvents();
    void connectViews();
    void connectSurvey();
    void connectTargets();
    void connectLive();
    void connectEvaluation();

    void showWorkbench();
    void showAnalysis();
    void showPlan(const AnalysisPlan &plan);
    void showLive(const LiveView &view);
    void tellNotice(const ListenNotice &notice);
    void endLive();
    void listen(); ///< asks for the source
    /// Whether the document may be closed: no live run, and unsaved work may be lost (SessionSaver::mayLose).
    bool mayLeave(const QString &what, const std::function<void()> &next);
    void showEvents();
    void setSnrBandwidth(double hz);
    void showHint();
    void showTitle();
    void startLesson(const Lesson &lesson);
    void saveLesson(bool isNew); ///< what is shown, as a new lesson or a further step
    void showError(const Error &error);
    void showFailure(const Error &error);
    void offerIq();
    void takeAsIq(bool isIq);
    void takeLayout(const QString &name);
    /// Gives the whole window to a panel that needs no recording, until one is opened.
    void showAlone(QWidget *panel, const QString &title, const QString &hint);
    void chooseFile();
    void chooseFolder();
    void chooseRawFile();
    void openDropped(const QStringList &files);
    void openTogether(const QStringList &files); ///< as one recording
    /// Opens the file `by` places after the current one, with the same settings.
    void goToFile(int by);
    void showWritten(const QString &path);
    void exportReport();
    void injectLine();
    void reproduce(const Reproducible &reproducible, bool quick);
    void showExperiment(int id);
    void setTheme(Theme::Kind kind);
    void about();
    void showEquation(); ///< of the current view
    void showPalette();

    void fillRecentMenu(QMenu &menu);
    void saveLayout();
    void restoreLayout();

    WindowMemory m_memory;
    FileSequence m_files;
    bool m_isAsking = true;

    Panels *m_panels = nullptr;
    SessionSaver *m_saver = nullptr;
    LiveRun *m_live = nullptr;
    LiveBar *m_liveBar = nullptr;
    ListenDialog *m_listenDialog = nullptr; ///< remembers its entries
    Index m_overviewFrames = 0;             ///< live frames shown by the overview
    std::optional<Error> m_liveTrouble;     ///< last error of the live run
    bool m_isLeaving = false;               ///< close once the live run has ended
    QString m_recoveryFolder;
    QStackedWidget *m_pages = nullptr;
    ReportWriter *m_report = nullptr;
    std::unique_ptr<TrialViewer> m_trials;
    LessonGuide *m_lessons = nullptr;
    LessonList *m_lessonList = nullptr;
    BoxAnalysis *m_boxAnalysis = nullptr;
    Playback *m_playback = nullptr;
    ChartMenus *m_chartMenus = nullptr;
    OwnPresets *m_ownPresets = nullptr;
    OverviewStrip *m_overview = nullptr;
    ActivityBar *m_activity = nullptr;
    QLabel *m_hint = nullptr;
    double m_snrBandwidthHz = 0.0; ///< 0: of a bin
    QLabel *m_legend = nullptr;    ///< of the marks in the pictures
    KeysOverlay *m_keys = nullptr;
    EquationSheet *m_equation = nullptr;
    Commands *m_commands = nullptr;
    CommandPalette *m_palette = nullptr;
    QMenu *m_settingsMenu = nullptr; ///< of the palette
    std::vector<QToolBar *> m_bottomBars;
};

/// The table of the window's commands, as entries of its menus.
Commands *makeCommands(MainWindow &window);

} // namespace faintline
