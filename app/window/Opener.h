#pragma once

#include "app/document/AnalysisController.h"
#include "app/features/opening/recordingFiles.h"

#include <QObject>
#include <QStringList>

class QMenu;
class QWidget;

namespace faintline {

class LessonGuide;
class LessonList;
struct Lesson;
class WindowMemory;
class WindowParts;

/// Opens recordings, scenarios, sessions, surveys, experiments and lessons in a window: asks which, how, and whether what
/// is open may be left.
class Opener : public QObject
{
public:
    /// Call after the window has created all its children.
    Opener(WindowParts &parts, LessonGuide &lessons, const LessonList &list, const WindowMemory &memory,
           QWidget &window);

    /// Off: shows no dialogs.
    void setAsking(bool isAsking) { m_isAsking = isAsking; }
    bool isAsking() const { return m_isAsking; }

    void open(const QString &path, const OpenOptions &options = {}, const AnalysisController::Adjust &adjust = {});
    void openNow(const QString &path, const OpenOptions &options = {}, const AnalysisController::Adjust &adjust = {});
    void startLesson(const Lesson &lesson);
    void saveLesson(bool isNew); ///< what is shown, as a new lesson or a further step
    /// Offers to restore unsaved work left by a crash.
    void offerRecovery(const QString &folder);
    void newScene();

    void chooseFile();
    void chooseFolder();
    void chooseRawFile();
    /// Opens the file `by` places after the current one, with the same settings.
    void goToFile(int by);

    bool canBeIq() const;
    void takeAsIq(bool isIq);
    void offerIq();

    void fillRecentMenu(QMenu &menu);

protected:
    /// Opens files that are dropped anywhere on the window.
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void openDropped(const QStringList &files);
    void openTogether(const QStringList &files); ///< as one recording

    WindowParts &m_parts;
    LessonGuide &m_lessons;
    const WindowMemory &m_memory;
    QWidget &m_window;
    FileSequence m_files;
    bool m_isAsking = true;
};

} // namespace faintline
