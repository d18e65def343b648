#include "app/window/WindowMemory.h"

#include "app/base/filePath.h"
#include "app/document/OutputLayers.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "app/views/WindowParts.h"

#include <QFileInfo>
#include <QMainWindow>

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

void WindowMemory::keepLayout(const QMainWindow &window, const WindowParts &parts, bool isRegulationShown)
{
    if (!m_store)
        return;
    const ViewState view = parts.workbench().viewState();
    const std::string_view layer = outputLayerNames[std::size_t(parts.workbench().layers().chosen())];
    m_store->setValue(&parts.bench() == &parts.pingBench() ? pingSplittersKey : splittersKey,
                      parts.bench().saveSplitters()); // the hidden bench keeps its own
    m_store->setValue(geometryKey, window.saveGeometry());
    m_store->setValue(panelsKey, window.saveState());
    m_store->setValue(colourMapKey, view.colourMap);
    m_store->setValue(orientationKey, view.orientation);
    m_store->setValue(logarithmicKey, view.isLogarithmic);
    m_store->setValue(radioKey, view.isRadioAxis);
    m_store->setValue(layerKey, QString::fromLatin1(layer.data(), qsizetype(layer.size())));
    m_store->setValue(regulationKey, isRegulationShown);
}

void WindowMemory::restoreLayout(QMainWindow &window, const WindowParts &parts) const
{
    Workbench &workbench = parts.workbench();
    workbench.restore({{},
                       {},
                       m_store ? m_store->value(orientationKey, "leftToRight").toString() : QString(),
                       m_store ? m_store->value(colourMapKey).toString() : QString(),
                       m_store && m_store->value(logarithmicKey).toBool(),
                       m_store && m_store->value(radioKey).toBool()});
    if (!m_store)
        return;
    window.restoreGeometry(m_store->value(geometryKey).toByteArray());
    if (m_store->contains(splittersKey))
        workbench.restoreSplitters(m_store->value(splittersKey).toByteArray());
    if (m_store->contains(pingSplittersKey))
        parts.pingBench().restoreSplitters(m_store->value(pingSplittersKey).toByteArray());
    const auto layer =
        std::ranges::find(outputLayerNames, m_store->value(layerKey, "presence").toString().toStdString());
    if (layer != outputLayerNames.end())
        workbench.layers().setLayer(OutputLayer(layer - outputLayerNames.begin()));
}

QByteArray WindowMemory::panels() const
{
    return m_store ? m_store->value(panelsKey).toByteArray() : QByteArray();
}

bool WindowMemory::isRegulationShown() const
{
    return !m_store || m_store->value(regulationKey, m_store->contains(panelsKey)).toBool();
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
