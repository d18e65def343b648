#pragma once

#include "app/document/AnalysisController.h"
#include "app/document/Document.h"
#include "app/document/RecordingCheck.h"
#include "app/features/evaluate/Experiments.h"
#include "app/features/events/Comparer.h"
#include "app/features/sequential/SequentialTests.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace faintline {

class Bench;
class EventReviews;
class EventTable;
class ExceedancePlot;
class MessageBar;
class OwnPresets;
class PingBench;
class ReadOut;
class Recovery;
class WelcomePage;
class WindowViews;
class Workbench;

/// Parts of a window: the document, the controllers and the panels. Lessons, reports, views and render use the window
/// through this interface; MainWindow creates the parts and alone knows their layout and its menus.
class WindowParts
{
public:
    Document &document() { return m_document; }
    const Document &document() const { return m_document; }
    AnalysisController &controller() { return m_controller; }
    Comparer &comparer() { return m_comparer; }
    RecordingCheck &recordingCheck() { return m_check; }
    Experiments &experiments() { return m_experiments; }
    SequentialTests &sequentialTests() { return m_sequentialTests; }
    Recovery &recovery() { return *m_recovery; }

    Workbench &workbench() const { return *m_workbench; }
    PingBench &pingBench() const { return *m_pings; }
    Bench &bench() const; ///< the bench in use for the open document
    WelcomePage &welcome() const { return *m_welcome; }
    MessageBar &messages() const { return *m_messages; }
    ReadOut &readOut() const { return *m_readOut; }
    ExceedancePlot &thresholdPlot() const { return *m_threshold; }
    EventTable &eventTable() const { return *m_events; }
    EventReviews &reviews() const { return *m_reviews; }
    WindowViews &views() const { return *m_views; }
    OwnPresets &ownPresets() const { return *m_ownPresets; }

    /// The panel of that class, which is one of panelList().
    template <class P>
    P &panel() const
    {
        const auto is = [](const auto &docked) { return qobject_cast<P *>(docked.second) != nullptr; };
        return *qobject_cast<P *>(std::ranges::find_if(m_docked, is)->second);
    }
    /// What the dock of that name holds.
    QWidget *docked(const QString &dock) const;

    /// What a session keeps of the window: the view of the bench and of the panels.
    ViewState viewState() const;
    void restore(const ViewState &view);

    /// Brings a panel to the front.
    virtual void show(QWidget &panel) = 0;
    /// Gives the whole window to a panel that needs no recording, until one is opened.
    virtual void showAlone(QWidget &panel, const QString &title, const QString &hint) = 0;
    virtual void showWelcome() = 0;
    virtual void showWorkbench() = 0;
    virtual void showError(const Error &error) = 0;
    virtual void showWritten(const QString &path) = 0;
    virtual void goTo(int event) = 0; ///< selects it everywhere
    virtual void newScene() = 0;      ///< of sonar pings, without targets
    /// Whether the document may be closed: no live run, and unsaved work may be lost; otherwise `next` may follow later.
    virtual bool mayLeave(const QString &what, const std::function<void()> &next) = 0;

    /// Opens a recording, a scenario or a session. Asks only for what the file does not contain.
    virtual void open(const QString &path, const OpenOptions &options = {},
                      const AnalysisController::Adjust &adjust = {}) = 0;
    /// The same without asking about unsaved changes.
    virtual void openNow(const QString &path, const OpenOptions &options = {},
                         const AnalysisController::Adjust &adjust = {}) = 0;
    /// Opens a radar's sequential test on simulated scans. If no recording is open, only the test is shown.
    virtual void openScans(const ScanTest &test) = 0;
    /// Opens the scenario of such a test unless that test is open already. Throws Error.
    void openScansOf(const QString &path);

protected:
    WindowParts();
    virtual ~WindowParts();
    WindowParts(const WindowParts &) = delete;
    WindowParts &operator=(const WindowParts &) = delete;

    Document m_document;
    AnalysisController m_controller;
    Comparer m_comparer;
    RecordingCheck m_check;
    Experiments m_experiments;
    SequentialTests m_sequentialTests;

    Recovery *m_recovery = nullptr;
    Workbench *m_workbench = nullptr;
    PingBench *m_pings = nullptr;
    WelcomePage *m_welcome = nullptr;
    MessageBar *m_messages = nullptr;
    ReadOut *m_readOut = nullptr;
    ExceedancePlot *m_threshold = nullptr;
    EventTable *m_events = nullptr;
    EventReviews *m_reviews = nullptr;
    WindowViews *m_views = nullptr;
    OwnPresets *m_ownPresets = nullptr;
    std::vector<std::pair<QString, QWidget *>> m_docked; ///< by the names of their docks
};

} // namespace faintline
