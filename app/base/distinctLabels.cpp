#include "app/base/distinctLabels.h"

#include "app/base/filePath.h"
#include "widgets/base/labelText.h"

#include <algorithm>

namespace faintline {

namespace {

    /// The folders of a path, the innermost first.
    QStringList foldersOf(const QString &path)
    {
        QStringList folders = path.split(QLatin1Char('/'), Qt::SkipEmptyParts);
        if (!folders.isEmpty())
            folders.removeLast();
        std::reverse(folders.begin(), folders.end());
        return folders;
    }

    /// How many of the innermost folders tell a path from another one of the same name.
    qsizetype foldersNeeded(const QString &path, const QString &other)
    {
        const QStringList a = foldersOf(path);
        const QStringList b = foldersOf(other);
        const auto differing = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
        return std::min<qsizetype>(differing - a.begin() + 1, a.size());
    }

} // namespace

QString distinctLabel(const QString &path, const QStringList &others)
{
    const QString label = fileLabel(path);
    qsizetype needed = 0;
    for (const QString &other : others)
        if (other != path && fileLabel(other) == label)
            needed = std::max(needed, foldersNeeded(path, other));
    if (needed == 0)
        return label;
    QStringList folders = foldersOf(path).mid(0, needed);
    std::reverse(folders.begin(), folders.end());
    return QStringLiteral("%1 (%2)").arg(label, labelText(pathBytes(folders.join(QLatin1Char('/')))));
}

QStringList distinctLabels(const QStringList &paths)
{
    QStringList labels;
    for (const QString &path : paths)
        labels << distinctLabel(path, paths);
    return labels;
}

} // namespace faintline
