#pragma once

#include "app/AnalysisController.h"
#include "app/Comparer.h"
#include "app/Document.h"
#include "app/Experiments.h"
#include "app/SequentialTests.h"
#include "app/WindowMemory.h"
#include "widgets/Theme.h"

#include <QMainWindow>

#include <memory>

class QLabel;
class QMenu;
class QStackedWidget;
class QToolBar;

namespace faintline {

class ActivityBar;
class Bench;
class CommandPalette;
class EquationSheet;
class ComparePanel;
class EvaluatePanel;
class EventReviews;
class EventTable;
class ExceedancePlot;
class ExperimentsPanel;
class HandLinePanel;
class InfoPanel;
class KeysOverlay;
class LatencyPanel;
class LessonGuide;
struct Lesson;
class MessageBar;
class NoiseFitPanel;
class OverviewStrip;
class Panels;
class PingBench;
class PipelinePanel;
class ReadOut;
class Recovery;
class ReportWriter;
class ReproductionPanel;
class ScenarioCard;
class SequentialPanel;
class SessionSaver;
class StateSlicePanel;
class SweepPanel;
class TrialViewer;
class WelcomePage;
class WhyPanel;
class WindowViews;
class Workbench;

/// The window: it puts the panels in their places and connects them to the document and its controller.
class MainWindow : public QMainWindow
{
    Q_OBJECT

public:
    /// `memory`: where recent files and the window's layout are kept; null keeps nothing. `recoveryFolder`: where unsaved work is.
    explicit MainWindow(std::unique_ptr<QSettings> memory = {}, const QString &recoveryFolder = {}, QWidget *parent = nullptr);
    ~MainWindow() override;

    /// Opens a recording, a scenario or a session. Asks only what the file itself cannot tell.
    void open(const QString &path, const OpenOptions &options = {}, const AnalysisController::Adjust &adjust = {});
    /// The same of a recording, a scenario or a session, whatever is unsaved.
    void openNow(const QString &path, const OpenOptions &options = {}, const AnalysisController::Adjust &adjust = {});
    void showWelcome();
    /// Offers unsaved work that a program left behind when it died.
    void offerRecovery();

    Document &document() { return m_document; }
    AnalysisController &controller() { return m_controller; }
    Workbench &workbench() { return *m_workbench; }
    PingBench &pingBench() { return *m_pings; }
    WelcomePage &welcome() { return *m_welcome; }
    MessageBar &messages() { return *m_messages; }
    ExceedancePlot &thresholdPlot() { return *m_threshold; }
    EventTable &eventTable() { return *m_events; }
    EventReviews &reviews() { return *m_reviews; }
    Experiments &experiments() { return m_experiments; }
    EvaluatePanel &evaluation() { return *m_evaluate; }
    ExperimentsPanel &experimentList() { return *m_experimentList; }
    ReproductionPanel &reproduction() { return *m_reproduction; }
    NoiseFitPanel &noiseFit() { return *m_noiseFit; }
    WhyPanel &why() { return *m_why; }
    InfoPanel &info() { return *m_info; }
    Recovery &recovery() { return *m_recovery; }
    StateSlicePanel &states() { return *m_states; }
    LatencyPanel &latency() { return *m_latency; }
    TrialViewer &trials() { return *m_trials; }
    LessonGuide &lessonGuide() { return *m_lessons; }
    HandLinePanel &handLine() { return *m_handLine; }
    Comparer &comparer() { return m_comparer; }
    ComparePanel &comparePanel() { return *m_compare; }
    SweepPanel &sweep() { return *m_sweep; }
    WindowViews &views() { return *m_views; }
    Bench &bench(); ///< the one for what is open

    /// A radar's sequential test on simulated scans. Where no recording is open, nothing else is shown.
    void openScans(const ScanTest &test);
    SequentialTests &sequentialTests() { return m_sequentialTests; }
    SequentialPanel &sequential() { return *m_sequential; }

    void showNoiseFit();
    void showWhy();
    void showStates();
    void showLatency();
    void showHandLine();
    void learnMotion();
    void showCompare();
    void showSweep();

    /// Off: nobody is there to answer a dialog.
    void setAsking(bool isAsking);

signals:
    void saved(const QString &sessionPath);

protected:
    void closeEvent(QCloseEvent *event) override;

private:
    void buildCentre();
    void buildDocks();
    void buildBottom();
    void buildStatusBar();
    void buildMenus();
    void buildFileMenu();
    void nameWhatHolds();
    void buildEditMenu();
    void buildViewMenu();
    void addLayerMenu(QMenu &menu);
    void buildDetectMenu();
    void buildReviewMenu();
    void buildEvaluateMenu();
    void buildReproduceMenu();
    void buildHelpMenu();
    void buildToolBar();
    void connectDocument();
    void connectController();
    void connectViews();
    void connectEvaluation();
    /// An action that makes sense only while a recording is shown.
    QAction *addViewAction(QMenu &menu, const QString &text, const QKeySequence &key, std::function<void()> action);

    void showWorkbench();
    void showAnalysis();
    void showEvents();
    void showHint();
    void showTitle();
    void startLesson(const Lesson &lesson);
    void showError(const Error &error);
    void showFailure(const Error &error);
    void offerIq();
    void openScenario(ScenarioCard *card);
    void chooseFile();
    void chooseRawFile();
    void exportReport();
    void injectLine();
    void reproduce(const Reproducible &reproducible, bool quick);
    void showExperiment(int id);
    void setTheme(Theme::Kind kind);
    void about();
    void showEquation(); ///< of the view one is at

    void fillRecentMenu();
    void saveLayout();
    void restoreLayout();

    Document m_document;
    AnalysisController m_controller;
    Comparer m_comparer;
    Experiments m_experiments;
    SequentialTests m_sequentialTests;
    WindowMemory m_memory;
    bool m_isAsking = true;

    Panels *m_panels = nullptr;
    WindowViews *m_views = nullptr;
    SessionSaver *m_saver = nullptr;
    Recovery *m_recovery = nullptr;
    QString m_recoveryFolder;
    MessageBar *m_messages = nullptr;
    QStackedWidget *m_pages = nullptr;
    WelcomePage *m_welcome = nullptr;
    Workbench *m_workbench = nullptr;
    PingBench *m_pings = nullptr;
    PipelinePanel *m_pipeline = nullptr;
    ExceedancePlot *m_threshold = nullptr;
    EventTable *m_events = nullptr;
    EventReviews *m_reviews = nullptr;
    ReportWriter *m_report = nullptr;
    WhyPanel *m_why = nullptr;
    InfoPanel *m_info = nullptr;
    EvaluatePanel *m_evaluate = nullptr;
    ExperimentsPanel *m_experimentList = nullptr;
    ReproductionPanel *m_reproduction = nullptr;
    NoiseFitPanel *m_noiseFit = nullptr;
    SequentialPanel *m_sequential = nullptr;
    StateSlicePanel *m_states = nullptr;
    LatencyPanel *m_latency = nullptr;
    HandLinePanel *m_handLine = nullptr;
    ComparePanel *m_compare = nullptr;
    SweepPanel *m_sweep = nullptr;
    std::unique_ptr<TrialViewer> m_trials;
    LessonGuide *m_lessons = nullptr;
    OverviewStrip *m_overview = nullptr;
    ReadOut *m_readOut = nullptr;
    ActivityBar *m_activity = nullptr;
    QLabel *m_hint = nullptr;
    KeysOverlay *m_keys = nullptr;
    EquationSheet *m_equation = nullptr;
    CommandPalette *m_palette = nullptr;
    QMenu *m_recentMenu = nullptr;
    QMenu *m_panelsMenu = nullptr;
    QAction *m_stopAction = nullptr;
    QAction *m_iqAction = nullptr;
    QAction *m_playAction = nullptr;
    QAction *m_presentAction = nullptr;
    std::vector<QAction *> m_viewActions;
    std::vector<QToolBar *> m_bottomBars;
};

} // namespace faintline
