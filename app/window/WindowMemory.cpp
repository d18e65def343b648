#include "app/window/WindowMemory.h"

#include "app/base/filePath.h"

#include <QFileInfo>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr int mostRecent = 10;
    const QString recentKey = QStringLiteral("recent");
    const QString classesKey = QStringLiteral("classes");
    const QString snrBandwidthKey = QStringLiteral("view/snrBandwidth");
    const QString lessonsKey = QStringLiteral("lessons");
    const QString themeKey = QStringLiteral("view/theme");
    const QString colourMapKey = QStringLiteral("view/colourMap");
    const QString orientationKey = QStringLiteral("view/orientation");
    const QString logarithmicKey = QStringLiteral("view/logarithmic");
    const QString radioKey = QStringLiteral("view/radio");
    const QString regulationKey = QStringLiteral("view/regulation");
    const QString layerKey = QStringLiteral("view/layer");
    const QString geometryKey = QStringLiteral("window/geometry");
    const QString panelsKey = QStringLiteral("window/panels");
    const QString splittersKey = QStringLiteral("window/splitters");
    const QString pingSplittersKey = QStringLiteral("window/pingSplitters");

} // namespace

std::unique_ptr<QSettings> WindowMemory::programStore()
{
    return std::make_unique<QSettings>(QSettings::IniFormat, QSettings::UserScope, QStringLiteral("faintline"),
                                       QStringLiteral("faintline"));
}

QStringList WindowMemory::recent() const
{
    return m_store ? m_store->value(recentKey).toStringList() : QStringList();
}

void WindowMemory::addRecent(const QString &path)
{
    if (!m_store)
        return;
    const QString absolute = absolutePath(path);
    QStringList paths = recent();
    paths.removeAll(absolute);
    paths.prepend(absolute);
    m_store->setValue(recentKey, QStringList(paths.mid(0, mostRecent)));
}

QString WindowMemory::presetFolder() const
{
    return m_store ? QFileInfo(m_store->fileName()).path() + QStringLiteral("/presets") : QString();
}

QStringList WindowMemory::classNames() const
{
    return m_store ? m_store->value(classesKey).toStringList() : QStringList();
}

void WindowMemory::setClassNames(const QStringList &names)
{
    if (m_store)
        m_store->setValue(classesKey, names);
}

double WindowMemory::snrBandwidthHz() const
{
    const double hz = m_store ? m_store->value(snrBandwidthKey).toDouble() : 0.0;
    return std::isfinite(hz) ? std::max(hz, 0.0) : 0.0;
}

void WindowMemory::setSnrBandwidthHz(double hz)
{
    if (m_store)
        m_store->setValue(snrBandwidthKey, hz);
}

QStringList WindowMemory::doneLessons() const
{
    return m_store ? m_store->value(lessonsKey).toStringList() : QStringList();
}

void WindowMemory::addDoneLesson(const QString &path)
{
    QStringList paths = doneLessons();
    if (!m_store || paths.contains(path))
        return;
    paths.append(path);
    m_store->setValue(lessonsKey, paths);
}

WindowMemory::Layout WindowMemory::layout() const
{
    if (!m_store)
        return {};
    return {m_store->value(geometryKey).toByteArray(),
            m_store->value(panelsKey).toByteArray(),
            m_store->value(splittersKey).toByteArray(),
            m_store->value(pingSplittersKey).toByteArray(),
            m_store->value(colourMapKey).toString(),
            m_store->value(orientationKey, "leftToRight").toString(),
            m_store->value(logarithmicKey).toBool(),
            m_store->value(radioKey).toBool(),
            m_store->value(layerKey, "presence").toString(),
            m_store->value(regulationKey, m_store->contains(panelsKey)).toBool()};
}

void WindowMemory::setLayout(const Layout &layout)
{
    if (!m_store)
        return;
    m_store->setValue(geometryKey, layout.geometry);
    m_store->setValue(panelsKey, layout.panels);
    m_store->setValue(splittersKey, layout.splitters);
    m_store->setValue(pingSplittersKey, layout.pingSplitters);
    m_store->setValue(colourMapKey, layout.colourMap);
    m_store->setValue(orientationKey, layout.orientation);
    m_store->setValue(logarithmicKey, layout.isLogarithmic);
    m_store->setValue(radioKey, layout.isRadioAxis);
    m_store->setValue(layerKey, layout.layer);
    m_store->setValue(regulationKey, layout.isRegulationShown);
}

Theme::Kind WindowMemory::theme() const
{
    return m_store ? Theme::named(m_store->value(themeKey).toString()) : Theme::Kind::Dark;
}

void WindowMemory::setTheme(Theme::Kind kind)
{
    if (m_store)
        m_store->setValue(themeKey, Theme::nameOf(kind));
}

} // namespace faintline
