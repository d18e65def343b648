#pragma once

#include "analysis/AnalysisSettings.h"

#include <QObject>

#include <vector>

namespace faintline {

/// Settings that somebody gave a name, to start from in any recording: one file each, NAME.json, in a folder. The
/// command line takes such a file as well (--session NAME.json). Which part of a recording is looked at is not among
/// them.
class OwnPresets : public QObject
{
    Q_OBJECT

public:
    /// What cannot be read in the folder is left out. An empty folder's name: nothing is kept.
    explicit OwnPresets(const QString &folder, QObject *parent = nullptr);

    const std::vector<Preset> &all() const { return m_presets; } ///< by name

    /// Replaces one of that name. Throws Error, also for names that are no file's.
    void save(const QString &name, AnalysisSettings settings);
    void remove(const QString &name);

signals:
    void changed();

private:
    void load();
    QString pathOf(const QString &name) const;

    QString m_folder;
    std::vector<Preset> m_presets;
};

} // namespace faintline
