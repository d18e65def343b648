#include "app/features/settings/OwnPresets.h"

#include "app/base/filePath.h"
#include "base/files/AtomicFile.h"

#include <QDir>
#include <QFile>
#include <QRegularExpression>

namespace faintline {

namespace {

    constexpr qint64 mostBytes = 1 << 20;

    void checkName(const QString &name)
    {
        static const QRegularExpression pattern(QStringLiteral("^[\\w][\\w .()+-]{0,59}$"),
                                                QRegularExpression::UseUnicodePropertiesOption);
        if (!pattern.match(name).hasMatch())
            throw Error("preset “" + name.toStdString() + "”",
                        "must be 1 … 60 letters, digits, spaces or . - + ( ), beginning with a letter or digit");
    }

    AnalysisSettings withoutSelection(AnalysisSettings settings)
    {
        settings.selection = {};
        return settings;
    }

} // namespace

OwnPresets::OwnPresets(const QString &folder, QObject *parent) : QObject(parent), m_folder(folder)
{
    load();
}

void OwnPresets::load()
{
    m_presets.clear();
    if (m_folder.isEmpty())
        return;
    const QDir folder(m_folder);
    for (const QString &file : folder.entryList({QStringLiteral("*.json")}, QDir::Files, QDir::Name))
        try {
            const std::string text = readBeginning(folder.filePath(file), mostBytes).toStdString();
            const std::string name = file.chopped(5).toStdString();
            m_presets.push_back({name, "", withoutSelection(settingsFromJson(text, name))});
        } catch (const Error &) {
            continue; // not ours, or of another version
        }
}

QString OwnPresets::pathOf(const QString &name) const
{
    return QDir(m_folder).filePath(name + QStringLiteral(".json"));
}

void OwnPresets::save(const QString &name, AnalysisSettings settings)
{
    checkName(name);
    if (m_folder.isEmpty() || !QDir().mkpath(m_folder))
        throw Error(m_folder.isEmpty() ? "presets" : pathBytes(m_folder),
                    "cannot be written; this window keeps nothing", Error::Kind::Failure);
    writeTextFile(pathBytes(pathOf(name)), settingsToJson(withoutSelection(std::move(settings))) + "\n");
    load();
    emit changed();
}

void OwnPresets::remove(const QString &name)
{
    QFile::remove(pathOf(name));
    load();
    emit changed();
}

} // namespace faintline
