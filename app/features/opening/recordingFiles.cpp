#include "app/features/opening/recordingFiles.h"

#include "app/base/filePath.h"
#include "app/base/tr.h"
#include "signal/fileFormats.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>

#include <algorithm>
#include <filesystem>

namespace faintline {

namespace {

    /// Pads numbers with zeros: 2 sorts before 10.
    QString sortKey(const QString &path)
    {
        constexpr qsizetype digits = 20;
        QString key;
        for (qsizetype i = 0; i < path.size();) {
            qsizetype end = i;
            while (end < path.size() && path[end].isDigit())
                ++end;
            if (end > i)
                key += path.mid(i, end - i).rightJustified(digits, QLatin1Char('0'));
            else
                key += path[end++].toLower();
            i = end;
        }
        return key;
    }

    QStringList recordingsBeside(const QString &path)
    {
        QStringList files;
        std::error_code failure;
        const std::filesystem::path folder = std::filesystem::path(pathBytes(path)).parent_path();
        for (auto it = std::filesystem::directory_iterator(folder, failure);
             !failure && it != std::filesystem::directory_iterator(); it.increment(failure)) {
            const QString file = pathText(it->path().string());
            if (file == path || (isNamedLikeRecording(pathBytes(file)) && isRegularFile(file)))
                files << file;
        }
        std::sort(files.begin(), files.end(),
                  [](const QString &a, const QString &b) { return sortKey(a) < sortKey(b); });
        return files;
    }

} // namespace

QString openFilter()
{
    QStringList patterns;
    for (const std::string &name : recordingEndings()) {
        const QString ending = QString::fromStdString(name);
        patterns << QStringLiteral("*.") + ending << QStringLiteral("*.") + ending.toUpper();
    }
    patterns << QStringLiteral("*.timeline");
    return QStringList{tr("Recordings (%1)").arg(patterns.join(QLatin1Char(' '))), tr("Sessions (*.faintline)"),
                       tr("Surveys (*.sqlite)"), tr("Scenarios, lessons and experiments (*.json)"), tr("All files (*)")}
        .join(QStringLiteral(";;"));
}

std::string timelineText(const QStringList &files, const QString &list)
{
    const QDir folder = QFileInfo(absolutePath(list)).dir();
    std::string text;
    for (const QString &file : files)
        text += pathBytes(folder.relativeFilePath(absolutePath(file))) + "\n";
    return text;
}

QString FileSequence::neighbour(const QString &path, int by) const
{
    const QString here = absolutePath(path);
    if (here.isEmpty() || here.startsWith(QLatin1Char(':')))
        return {};
    const QStringList files = m_files.contains(here) ? m_files : recordingsBeside(here);
    const auto index = files.indexOf(here);
    return index < 0 ? QString() : files.value(index + by);
}

} // namespace faintline
