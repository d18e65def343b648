#include "app/window/Opener.h"

#include "app/base/MessageBar.h"
#include "app/base/distinctLabels.h"
#include "app/base/filePath.h"
#include "app/document/Recovery.h"
#include "app/document/scanScenario.h"
#include "app/features/evaluate/ExperimentsPanel.h"
#include "app/features/opening/OpenOptionsDialog.h"
#include "app/features/opening/WelcomePage.h"
#include "app/features/opening/recordingFiles.h"
#include "app/features/opening/scenarios.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/survey/SurveyPanel.h"
#include "app/features/targets/TargetsPanel.h"
#include "app/lessons/Lesson.h"
#include "app/lessons/LessonGuide.h"
#include "app/lessons/LessonList.h"
#include "app/lessons/writeLesson.h"
#include "app/views/WindowParts.h"
#include "app/window/WindowMemory.h"
#include "base/files/AtomicFile.h"
#include "widgets/base/labelText.h"

#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMimeData>
#include <QUrl>

namespace faintline {

namespace {

    /// The dragged files; empty if anything else is dragged.
    QStringList filesOf(const QMimeData &data)
    {
        QStringList files;
        for (const QUrl &url : data.urls())
            if (const QString path = pathOf(url); !path.isEmpty())
                files << path;
        return files;
    }

} // namespace

Opener::Opener(WindowParts &parts, LessonGuide &lessons, const LessonList &list, const WindowMemory &memory,
               QWidget &window)
    : QObject(&window), m_parts(parts), m_lessons(lessons), m_memory(memory), m_window(window)
{
    const auto startBundled = [this](int lesson) { startLesson(faintline::lessons()[std::size_t(lesson)]); };
    connect(&list, &LessonList::chosen, this, startBundled);
    connect(&lessons, &LessonGuide::lessonRequested, this, startBundled);
    connect(&parts.welcome(), &WelcomePage::openRequested, this, &Opener::chooseFile);
    connect(&parts.welcome(), &WelcomePage::pathChosen, this, [this](const QString &path) { open(path); });
    // Also on text fields, which would otherwise only insert names.
    window.setAcceptDrops(true);
    window.installEventFilter(this);
    for (QWidget *child : window.findChildren<QWidget *>())
        if (child->acceptDrops())
            child->installEventFilter(this);
}

bool Opener::eventFilter(QObject *watched, QEvent *event)
{
    const bool isDrop = event->type() == QEvent::Drop;
    if (!isDrop && event->type() != QEvent::DragEnter && event->type() != QEvent::DragMove)
        return QObject::eventFilter(watched, event);
    auto *drag = static_cast<QDropEvent *>(event);
    const QStringList files = filesOf(*drag->mimeData());
    if (files.isEmpty())
        return QObject::eventFilter(watched, event);
    drag->acceptProposedAction();
    if (isDrop)
        openDropped(files);
    return true;
}

void Opener::open(const QString &path, const OpenOptions &options, const AnalysisController::Adjust &adjust)
{
    if (SurveyPanel::isSurvey(path))
        return m_parts.panel<SurveyPanel>().open(path);
    if (ExperimentsPanel::isExperiment(path))
        return void(m_parts.panel<ExperimentsPanel>().open(path));
    if (const bool isOfScans = isScanScenario(path); isOfScans || isLesson(path)) {
        try {
            return isOfScans ? m_parts.openScans(readScanTest(path)) : startLesson(readLesson(path));
        } catch (const Error &error) {
            return m_parts.showError(error);
        }
    }
    const auto next = [this, path, options, adjust] { openNow(path, options, adjust); };
    if (m_parts.mayLeave(tr("opening something else"), next))
        next();
}

void Opener::openNow(const QString &path, const OpenOptions &options, const AnalysisController::Adjust &adjust)
{
    OpenOptions chosen = options;
    if (m_isAsking && needsRawOptions(path, options)) {
        OpenOptionsDialog dialog(path, &m_window);
        if (dialog.exec() != QDialog::Accepted)
            return;
        chosen = dialog.options();
    }
    if (!m_window.isVisible() || m_parts.document().isEmpty()) {
        for (Bench *one : std::initializer_list<Bench *>{&m_parts.workbench(), &m_parts.pingBench()})
            one->setEmptySentence(tr("Reading %1 …").arg(fileLabel(path)));
        m_parts.showWorkbench();
    }
    m_parts.controller().open(path, chosen, adjust);
}

void Opener::startLesson(const Lesson &lesson)
{
    const auto next = [this, lesson] { m_lessons.start(lesson); };
    if (m_parts.mayLeave(tr("starting the lesson"), next))
        next();
}

void Opener::saveLesson(bool isNew)
{
    const QString filter = tr("Lessons (*.json)");
    const QUrl start = QUrl::fromLocalFile(nameBeside(m_parts.document().sourcePath(), QStringLiteral("-lesson.json")));
    const QString path =
        pathOf(isNew ? QFileDialog::getSaveFileUrl(&m_window, tr("New lesson from what is shown"), start, filter)
                     : QFileDialog::getOpenFileUrl(&m_window, tr("Add what is shown to a lesson"),
                                                   start.adjusted(QUrl::RemoveFilename), filter));
    if (path.isEmpty())
        return;
    try {
        (isNew ? writeNewLesson : addLessonStep)(m_parts, path);
    } catch (const Error &error) {
        return m_parts.showError(error);
    }
    m_parts.messages().showMessage(MessageBar::Kind::Notice, tr("Lesson"),
                                   tr("Written to %1; its titles and texts are to be edited there.")
                                       .arg(labelText(pathBytes(absolutePath(path)), longestPath)),
                                   tr("Start"), [this, path] { open(path); });
}

void Opener::offerRecovery(const QString &folder)
{
    const QStringList left = Recovery::leftBehind(folder);
    if (left.isEmpty())
        return;
    const QString when = QFileInfo(left.first()).lastModified().toString(QStringLiteral("yyyy-MM-dd hh:mm"));
    m_parts.messages().showMessage(MessageBar::Kind::Notice, tr("Unsaved work"),
                                   tr("of %1 can be restored; the program ended unexpectedly.").arg(when),
                                   tr("Restore"), [this, session = left.first()] {
                                       // Discard the old recovery file once it is saved again.
                                       connect(
                                           &m_parts.recovery(), &Recovery::kept, this,
                                           [session] { Recovery::discard(session); }, Qt::SingleShotConnection);
                                       m_parts.controller().recover(session);
                                   });
}

void Opener::newScene()
{
    const auto next = [this] {
        // The layout is taken when the scene is open.
        const auto show = [this] {
            m_parts.showWorkbench();
            m_parts.show(m_parts.panel<TargetsPanel>());
        };
        connect(&m_parts.document(), &Document::opened, this, show, Qt::SingleShotConnection);
        openNow(openSeaPath());
    };
    if (m_parts.mayLeave(tr("opening a new scene"), next))
        next();
}

void Opener::chooseFile()
{
    const QString folder = m_memory.recent().isEmpty() ? QString() : QFileInfo(m_memory.recent().first()).path();
    const QString path =
        pathOf(QFileDialog::getOpenFileUrl(&m_window, tr("Open"), QUrl::fromLocalFile(folder), openFilter()));
    if (!path.isEmpty())
        open(path);
}

void Opener::chooseFolder()
{
    const QString folder = m_memory.recent().isEmpty() ? QString() : QFileInfo(m_memory.recent().first()).path();
    const QString path = pathOf(QFileDialog::getExistingDirectoryUrl(&m_window, tr("Open a folder as one recording"),
                                                                     QUrl::fromLocalFile(folder)));
    if (!path.isEmpty())
        open(path);
}

void Opener::chooseRawFile()
{
    const QString path = pathOf(QFileDialog::getOpenFileUrl(&m_window, tr("Open as raw samples")));
    if (path.isEmpty())
        return;
    OpenOptionsDialog dialog(path, &m_window);
    if (dialog.exec() == QDialog::Accepted)
        open(path, dialog.options());
}

void Opener::openDropped(const QStringList &files)
{
    m_files.setFiles({});
    if (files.size() > 1) {
        QStringList absolute;
        for (const QString &file : files)
            absolute << absolutePath(file);
        m_files.setFiles(absolute);
        connect(
            &m_parts.document(), &Document::opened, this,
            [this, files] {
                m_parts.messages().showMessage(MessageBar::Kind::Notice, tr("%1 files").arg(files.size()),
                                               tr("The first of them is shown. Ctrl+Page Down goes to the next."),
                                               tr("Open as one recording"), [this, files] { openTogether(files); });
            },
            static_cast<Qt::ConnectionType>(Qt::QueuedConnection | Qt::SingleShotConnection));
    }
    open(files.front());
}

void Opener::openTogether(const QStringList &files)
{
    const QString first = QFileInfo(files.front()).absoluteDir().filePath(QStringLiteral("recording.timeline"));
    const QString list = pathOf(QFileDialog::getSaveFileUrl(&m_window, tr("Save the list of files as"),
                                                            QUrl::fromLocalFile(first), tr("Lists (*.timeline)")));
    if (list.isEmpty())
        return;
    try {
        writeTextFile(pathBytes(list), timelineText(files, list), Durability::Machine, Written::Document);
        open(list);
    } catch (const Error &error) {
        m_parts.showError(error);
    }
}

void Opener::goToFile(int by)
{
    const QString path = m_files.neighbour(m_parts.document().sourcePath(), by);
    if (path.isEmpty()) {
        m_parts.messages().showMessage(MessageBar::Kind::Notice, m_parts.document().sourceName(),
                                       by > 0 ? tr("This is the last recording of its folder.")
                                              : tr("This is the first recording of its folder."));
        return;
    }
    const auto next = [this, path] {
        AnalysisSettings settings = m_parts.document().settings();
        settings.selection.fromSeconds = settings.selection.toSeconds =
            0.0; // a selection does not carry over to another recording
        openNow(path, m_parts.document().source().options, [settings](AnalysisSettings &opened) { opened = settings; });
    };
    // The settings are kept: only annotations could be lost.
    if (m_parts.document().annotations().isEmpty() || m_parts.mayLeave(tr("opening something else"), next))
        next();
}

void Opener::takeAsIq(bool isIq)
{
    OpenOptions options = m_parts.document().source().options;
    options.iq = isIq;
    m_parts.controller().reopen(options);
}

bool Opener::canBeIq() const
{
    const Source &source = m_parts.document().source();
    const auto &recording = m_parts.document().recording();
    return recording && m_parts.document().takesAnalyses() && !source.scene && !recording->info().isComplex
           && recording->info().channelCount % 2 == 0;
}

void Opener::offerIq()
{
    if (canBeIq() && m_parts.document().recording()->info().channelCount == 2)
        m_parts.messages().showMessage(MessageBar::Kind::Notice, m_parts.document().sourceName(),
                                       tr("Two channels; showing the first. Treat them as I/Q?"), tr("Treat as I/Q"),
                                       [this] { takeAsIq(true); });
}

void Opener::fillRecentMenu(QMenu &menu)
{
    for (const QString &path : m_memory.recent())
        menu.addAction(buttonText(distinctLabel(path, m_memory.recent())), this, [this, path] { open(path); })
            ->setToolTip(asHtml(labelText(pathBytes(path), longestPath)));
    if (menu.isEmpty())
        menu.addAction(tr("No recent files"))->setEnabled(false);
}

} // namespace faintline
