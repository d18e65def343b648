#pragma once

#include "app/control/LiveRun.h"
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
class LessonGuide;
class LessonList;
class Listening;
class LiveBar;
class Opener;
class Panels;
class Playback;
class ReportWriter;
class SessionSaver;
class ShownEvents;
class TrialViewer;

/// The main window: arranges the panels, and shows what the document's state requires.
class MainWindow : public QMainWindow, public WindowParts
{
    Q_OBJECT

public:
    /// `memory`: stores recent files and the window's layout; null: stores nothing. `recoveryFolder`: holds unsaved
    /// work.
    explicit MainWindow(std::unique_ptr<QSettings> memory = {}, const QString &recoveryFolder = {},
                        QWidget *parent = nullptr);
    ~MainWindow() override;

    using QMainWindow::show;
    void show(QWidget &panel) override;
    void showView(const QString &name); ///< brings its panel to the front
    void showAlone(QWidget &panel, const QString &title, const QString &hint) override;
    void showExperiment(int id) override;
    void showWelcome() override;
    void showWorkbench() override;
    void showError(const Error &error) override;
    void showWritten(const QString &path) override;
    void goTo(int event) override;

    void open(const QString &path, const OpenOptions &options = {},
              const AnalysisController::Adjust &adjust = {}) override;
    void openNow(const QString &path, const OpenOptions &options = {},
                 const AnalysisController::Adjust &adjust = {}) override;
    void openScans(const ScanTest &test) override;
    void newScene() override;
    /// Offers to restore unsaved work left by a crash.
    void offerRecovery();
    bool mayLeave(const QString &what, const std::function<void()> &next) override;
    /// Off: shows no dialogs.
    void setAsking(bool isAsking);

    /// Listens to a source and records into a folder, in files of limited length, with these settings or those of the
    /// open document, which is closed. At the end the recording is opened.
    void listenTo(LiveRun::OpenSource source, const QString &folder,
                  const std::optional<AnalysisSettings> &settings = {}, const RotationSettings &rotation = {});
    LiveRun &live();
    LiveBar &liveBar();
    void setPlaying(bool isPlaying);

    TrialViewer &trials() { return *m_trials; }
    LessonGuide &lessonGuide() { return *m_lessons; }
    ChartMenus &chartMenus() { return *m_chartMenus; }

signals:
    void saved(const QString &sessionPath);

protected:
    void closeEvent(QCloseEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    /// Tab passes over panels that lie behind another one's tab.
    bool focusNextPrevChild(bool next) override;

private:
    friend class CommandTable;

    void buildCentre();
    void buildPanels();
    void buildBottom();
    void buildStatusBar();
    void nameWhatHolds();
    void buildToolBar();
    void connectCommands();
    void connectDocument();
    void connectController();
    void connectLessons();
    void connectParts();

    void showBars();
    void putBenchAside();
    void showHint();
    void showTitle();
    void showFailure(const Error &error);
    void setSnrBandwidth(double hz);
    void exportReport();
    void reproduce(const Reproducible &reproducible, bool quick);
    void setTheme(Theme::Kind kind);
    void about();
    void showEquation(); ///< of the current view
    void showPalette();
    void takeLayout(const QString &name);
    void saveLayout();
    void restoreLayout();

    WindowMemory m_memory;
    QString m_recoveryFolder;
    Panels *m_panels = nullptr;
    Commands *m_commands = nullptr;
    Opener *m_opener = nullptr;
    Listening *m_listening = nullptr;
    SessionSaver *m_saver = nullptr;
    ReportWriter *m_report = nullptr;
    std::unique_ptr<TrialViewer> m_trials;
    LessonGuide *m_lessons = nullptr;
    LessonList *m_lessonList = nullptr;
    ShownEvents *m_shownEvents = nullptr;
    BoxAnalysis *m_boxAnalysis = nullptr;
    Playback *m_playback = nullptr;
    ChartMenus *m_chartMenus = nullptr;
    KeysOverlay *m_keys = nullptr;
    EquationSheet *m_equation = nullptr;
    CommandPalette *m_palette = nullptr;
    QMenu *m_settingsMenu = nullptr; ///< of the palette
    QStackedWidget *m_pages = nullptr;
    std::vector<QToolBar *> m_bottomBars;
    ActivityBar *m_activity = nullptr;
    QLabel *m_hint = nullptr;
    QLabel *m_legend = nullptr; ///< of the marks in the pictures
};

/// The table of the window's commands, as entries of its menus.
Commands *makeCommands(MainWindow &window);

} // namespace faintline
