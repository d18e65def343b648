#pragma once

#include <QList>
#include <QRgb>
#include <QString>
#include <QStringList>

#include <array>

namespace faintline {

/// 256 colours from low to high, perceptually uniform and readable without colour vision.
class ColourMap
{
public:
    /// "inferno", "magma", "viridis", "cividis", "grey", "paper" (grey reversed), "blue-red" and "ice-fire" (diverging
    /// around a light and a dark middle).
    static const QStringList &names();
    static const QString &defaultName();

    /// The map of that name, or the default one if it is unknown.
    static const ColourMap &named(const QString &name);

    /// The name after `name` in `names()`, cyclically.
    static QString next(const QString &name);

    const QString &name() const { return m_name; }
    const std::array<QRgb, 256> &entries() const { return m_entries; }

    /// The colour at 0 … 1, clamped; NaN has that of 0.
    QRgb at(double position) const;

    /// `stops`: equidistant sRGB colours, interpolated linearly.
    ColourMap(QString name, const QList<QRgb> &stops);

private:
    QString m_name;
    std::array<QRgb, 256> m_entries;
};

} // namespace faintline
