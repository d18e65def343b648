#pragma once

#include "app/views/WindowParts.h"
#include "app/window/WindowMemory.h"

#include <QMainWindow>

#include <memory>

class QLabel;
class QStackedWidget;
class QToolBar;

namespace faintline {

class ActivityBar;
class BoxAnalysis;
class ChartMenus;
class Commands;
class LessonGuide;
class LessonList;
class Listening;
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
    bool mayLeave(const QString &what, const std::function<void()> &next) override;
    /// Off: shows no dialogs.
    void setAsking(bool isAsking);

    void setPlaying(bool isPlaying);

    Opener &opener() { return *m_opener; }
    Listening &listening() { return *m_listening; }
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
    void connectDocument();
    void connectController();
    void connectLessons();
    void connectParts();

    void showBars();
    void putBenchAside();
    void showHint();
    void showTitle();
    void showFailure(const Error &error);
    void takeLayout(const QString &name);
    void keepLayout();

    WindowMemory m_memory;
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
    QStackedWidget *m_pages = nullptr;
    std::vector<QToolBar *> m_bottomBars;
    ActivityBar *m_activity = nullptr;
    QLabel *m_hint = nullptr;
    QLabel *m_legend = nullptr; ///< of the marks in the pictures
};

/// The table of the window's commands, as entries of its menus.
Commands *makeCommands(MainWindow &window);

} // namespace faintline
