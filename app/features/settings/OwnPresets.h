#pragma once

#include "plan/AnalysisSettings.h"

#include <QObject>

#include <vector>

namespace faintline {

/// The user's named settings for any recording: one file each, NAME.json, in a folder. The command line accepts such a
/// file as well (--session NAME.json). They do not include the selected part of a recording.
class OwnPresets : public QObject
{
    Q_OBJECT

public:
    /// Unreadable files in the folder are ignored. With an empty folder name nothing is stored.
    explicit OwnPresets(const QString &folder, QObject *parent = nullptr);

    const std::vector<Preset> &all() const { return m_presets; } ///< by name

    /// Replaces a preset of that name. Throws Error, also for names that are not valid file names.
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
