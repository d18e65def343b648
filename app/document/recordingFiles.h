#pragma once

#include <QString>
#include <QStringList>

#include <string>

namespace faintline {

/// The kinds of files of the *Open* dialog, recordings first.
QString openFilter();

/// What a list of files says that make one recording (.timeline): a name a line, relative to the list's folder.
std::string timelineText(const QStringList &files, const QString &list);

/// The files that one goes through one by one: those that were dropped together, else the recordings in the folder of
/// the one that is open, in the order of their names (2 before 10).
class FileSequence
{
public:
    void setFiles(const QStringList &files) { m_files = files; }

    /// The one that is so many files after that one; empty where there is none.
    QString neighbour(const QString &path, int by) const;

private:
    QStringList m_files; ///< none: those of the folder
};

} // namespace faintline
