#pragma once

#include <QString>
#include <QStringList>

#include <string>

namespace faintline {

/// File filters of the *Open* dialog, recordings first.
QString openFilter();

/// Content of a list (.timeline) of files that form one recording: one name per line, relative to the list's folder.
std::string timelineText(const QStringList &files, const QString &list);

/// The files through which the user can step: those that were dropped together, else the recordings in the folder of
/// the open one, in natural order (2 before 10).
class FileSequence
{
public:
    void setFiles(const QStringList &files) { m_files = files; }

    /// The file `by` positions after `path`; empty if there is none.
    QString neighbour(const QString &path, int by) const;

private:
    QStringList m_files; ///< empty: those of the folder
};

} // namespace faintline
