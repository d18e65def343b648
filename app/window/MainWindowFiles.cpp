// Opening files, scenarios, lessons and unsaved work.

#include "app/window/MainWindow.h"

#include "app/base/MessageBar.h"
#include "app/base/distinctLabels.h"
#include "app/base/filePath.h"
#include "app/document/Recovery.h"
#include "app/document/SessionSaver.h"
#include "app/document/recordingFiles.h"
#include "app/document/scanScenario.h"
#include "app/document/scenarios.h"
#include "app/lessons/Lesson.h"
#include "app/lessons/LessonGuide.h"
#include "app/lessons/writeLesson.h"
#include "app/panels/ExperimentsPanel.h"
#include "app/panels/OpenOptionsDialog.h"
#include "app/panels/SequentialPanel.h"
#include "app/panels/SurveyPanel.h"
#include "app/welcome/WelcomePage.h"
#include "app/window/Commands.h"
#include "app/window/Panels.h"
#include "app/workspace/PingBench.h"
#include "app/workspace/Workbench.h"
#include "base/files/AtomicFile.h"
#include "widgets/base/labelText.h"
#include "widgets/plot/WalkPlot.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QStackedWidget>
#include <QUrl>

namespace faintline {

void MainWindow::open(const QString &path, const OpenOptions &options, const AnalysisController::Adjust &adjust)
{
    if (SurveyPanel::isSurvey(path))
        return m_survey->open(path);
    if (ExperimentsPanel::isExperiment(path))
        return void(m_experimentList->open(path));
    if (const bool isOfScans = isScanScenario(path); isOfScans || isLesson(path)) {
        try {
            return isOfScans ? openScans(readScanTest(path)) : startLesson(readLesson(path));
        } catch (const Error &error) {
            return showError(error);
        }
    }
    const auto next = [this, path, options, adjust] { openNow(path, options, adjust); };
    if (mayLeave(tr("opening something else"), next))
        next();
}

void MainWindow::startLesson(const Lesson &lesson)
{
    const auto next = [this, lesson] { m_lessons->start(lesson); };
    if (mayLeave(tr("starting the lesson"), next))
        next();
}

void MainWindow::saveLesson(bool isNew)
{
    const QString filter = tr("Lessons (*.json)");
    const QString beside = m_document.sourcePath();
    const QUrl start =
        QUrl::fromLocalFile(beside.startsWith(QLatin1Char(':')) ? QDir::home().filePath(QStringLiteral("lesson.json"))
                                                                : nameBeside(beside, QStringLiteral("-lesson.json")));
    const QString path =
        pathOf(isNew ? QFileDialog::getSaveFileUrl(this, tr("New lesson from what is shown"), start, filter)
                     : QFileDialog::getOpenFileUrl(this, tr("Add what is shown to a lesson"),
                                                   start.adjusted(QUrl::RemoveFilename), filter));
    if (path.isEmpty())
        return;
    try {
        (isNew ? writeNewLesson : addLessonStep)(*this, path);
    } catch (const Error &error) {
        return showError(error);
    }
    m_messages->showMessage(MessageBar::Kind::Notice, tr("Lesson"),
                            tr("Written to %1; its titles and texts are to be edited there.")
                                .arg(labelText(pathBytes(absolutePath(path)), longestPath)),
                            tr("Start"), [this, path] { open(path); });
}

void MainWindow::openNow(const QString &path, const OpenOptions &options, const AnalysisController::Adjust &adjust)
{
    OpenOptions chosen = options;
    if (m_isAsking && needsRawOptions(path, options)) {
        OpenOptionsDialog dialog(path, this);
        if (dialog.exec() != QDialog::Accepted)
            return;
        chosen = dialog.options();
    }
    if (!isVisible() || m_document.isEmpty()) {
        for (Bench *one : std::initializer_list<Bench *>{m_workbench, m_pings})
            one->setEmptySentence(tr("Reading %1 …").arg(fileLabel(path)));
        showWorkbench();
    }
    m_controller.open(path, chosen, adjust);
}

void MainWindow::offerRecovery()
{
    const QStringList left = Recovery::leftBehind(m_recoveryFolder);
    if (left.isEmpty())
        return;
    const QString when = QFileInfo(left.first()).lastModified().toString(QStringLiteral("yyyy-MM-dd hh:mm"));
    m_messages->showMessage(MessageBar::Kind::Notice, tr("Unsaved work"),
                            tr("of %1 can be restored; the program ended unexpectedly.").arg(when), tr("Restore"),
                            [this, session = left.first()] {
                                // Discard the old recovery file once it is saved again.
                                connect(
                                    m_recovery, &Recovery::kept, this, [session] { Recovery::discard(session); },
                                    Qt::SingleShotConnection);
                                m_controller.recover(session);
                            });
}

void MainWindow::newScene()
{
    const auto next = [this] {
        // The layout is taken when the scene is open.
        const auto show = [this] {
            showWorkbench();
            showView(QStringLiteral("targets"));
        };
        connect(&m_document, &Document::opened, this, show, Qt::SingleShotConnection);
        openNow(openSeaPath());
    };
    if (mayLeave(tr("opening a new scene"), next))
        next();
}

void MainWindow::openScans(const ScanTest &test)
{
    m_commands->action("present")->setEnabled(true);
    if (m_lessons->isRunning())
        putBenchAside(); // an open recording has nothing to do with the lesson
    showAlone(m_sequential, tr("Radar scans — Faintline"),
              tr("Click a walk to follow that test. J and L step through its stages."));
    m_sequential->start(test);
    m_sequential->walk().setFocus(); // for J and L
}

void MainWindow::showAlone(QWidget *panel, const QString &title, const QString &hint)
{
    m_messages->dismiss();
    if (m_document.isEmpty() || m_pages->currentWidget() == m_welcome) {
        m_pages->hide(); // makes room for the panel
        setWindowTitle(title);
        m_hint->setText(hint);
    }
    m_panels->show(panel);
}

void MainWindow::chooseFile()
{
    const QString folder = m_memory.recent().isEmpty() ? QString() : QFileInfo(m_memory.recent().first()).path();
    const QString path =
        pathOf(QFileDialog::getOpenFileUrl(this, tr("Open"), QUrl::fromLocalFile(folder), openFilter()));
    if (!path.isEmpty())
        open(path);
}

void MainWindow::chooseFolder()
{
    const QString folder = m_memory.recent().isEmpty() ? QString() : QFileInfo(m_memory.recent().first()).path();
    const QString path = pathOf(
        QFileDialog::getExistingDirectoryUrl(this, tr("Open a folder as one recording"), QUrl::fromLocalFile(folder)));
    if (!path.isEmpty())
        open(path);
}

void MainWindow::chooseRawFile()
{
    const QString path = pathOf(QFileDialog::getOpenFileUrl(this, tr("Open as raw samples")));
    if (path.isEmpty())
        return;
    OpenOptionsDialog dialog(path, this);
    if (dialog.exec() == QDialog::Accepted)
        open(path, dialog.options());
}

void MainWindow::openDropped(const QStringList &files)
{
    m_files.setFiles({});
    if (files.size() > 1) {
        QStringList absolute;
        for (const QString &file : files)
            absolute << absolutePath(file);
        m_files.setFiles(absolute);
        connect(
            &m_document, &Document::opened, this,
            [this, files] {
                m_messages->showMessage(MessageBar::Kind::Notice, tr("%1 files").arg(files.size()),
                                        tr("The first of them is shown. Ctrl+Page Down goes to the next."),
                                        tr("Open as one recording"), [this, files] { openTogether(files); });
            },
            static_cast<Qt::ConnectionType>(Qt::QueuedConnection | Qt::SingleShotConnection));
    }
    open(files.front());
}

void MainWindow::openTogether(const QStringList &files)
{
    const QString first = QFileInfo(files.front()).absoluteDir().filePath(QStringLiteral("recording.timeline"));
    const QString list = pathOf(QFileDialog::getSaveFileUrl(this, tr("Save the list of files as"),
                                                            QUrl::fromLocalFile(first), tr("Lists (*.timeline)")));
    if (list.isEmpty())
        return;
    try {
        writeTextFile(pathBytes(list), timelineText(files, list), Durability::Machine, Written::Document);
        open(list);
    } catch (const Error &error) {
        showError(error);
    }
}

void MainWindow::goToFile(int by)
{
    const QString path = m_files.neighbour(m_document.sourcePath(), by);
    if (path.isEmpty()) {
        m_messages->showMessage(MessageBar::Kind::Notice, m_document.sourceName(),
                                by > 0 ? tr("This is the last recording of its folder.")
                                       : tr("This is the first recording of its folder."));
        return;
    }
    const auto next = [this, path] {
        AnalysisSettings settings = m_document.settings();
        settings.selection.fromSeconds = settings.selection.toSeconds =
            0.0; // a selection does not carry over to another recording
        openNow(path, m_document.source().options, [settings](AnalysisSettings &opened) { opened = settings; });
    };
    // The settings are kept: only annotations could be lost.
    if (m_document.annotations().isEmpty() || mayLeave(tr("opening something else"), next))
        next();
}

void MainWindow::showWritten(const QString &path)
{
    m_messages->showMessage(MessageBar::Kind::Notice, tr("Written"),
                            labelText(pathBytes(absolutePath(path)), longestPath));
}

void MainWindow::takeAsIq(bool isIq)
{
    OpenOptions options = m_document.source().options;
    options.iq = isIq;
    m_controller.reopen(options);
}

void MainWindow::offerIq()
{
    QAction *action = m_commands->action("iq");
    const bool isIq = m_document.source().options.iq;
    action->setChecked(isIq);
    if (!m_document.recording() || m_live->isRunning())
        return action->setVisible(false);
    const RecordingInfo &info = m_document.recording()->info();
    const bool isPossible = !m_document.source().scene && !info.isComplex && info.channelCount % 2 == 0;
    action->setVisible(isPossible || isIq);
    if (isPossible && info.channelCount == 2)
        m_messages->showMessage(MessageBar::Kind::Notice, m_document.sourceName(),
                                tr("Two channels; showing the first. Treat them as I/Q?"), tr("Treat as I/Q"),
                                [this] { takeAsIq(true); });
}

void MainWindow::fillRecentMenu(QMenu &menu)
{
    for (const QString &path : m_memory.recent())
        menu.addAction(buttonText(distinctLabel(path, m_memory.recent())), this, [this, path] { open(path); })
            ->setToolTip(asHtml(labelText(pathBytes(path), longestPath)));
    if (menu.isEmpty())
        menu.addAction(tr("No recent files"))->setEnabled(false);
}

} // namespace faintline
