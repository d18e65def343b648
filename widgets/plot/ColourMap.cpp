#include "widgets/plot/ColourMap.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace faintline {

namespace {

    // Viridis, magma, inferno: S. van der Walt and N. Smith (2015, CC0); cividis: J. Nuñez, C. Anderton, R. Renslow,
    // PLOS ONE 13(7), 2018; every 15th of their 256 colours, accurate to 5 of 255 everywhere. Blue-red: C. Brewer's
    // RdBu. Ice-fire: similar, with a dark middle.
    std::vector<ColourMap> makeMaps()
    {
        std::vector<ColourMap> maps;
        maps.emplace_back(QStringLiteral("inferno"),
                          QList<QRgb>{0x000004, 0x0a0722, 0x1e0c45, 0x380962, 0x510e6c, 0x69166e, 0x801f6c, 0x982766,
                                      0xb0315b, 0xc63d4d, 0xd94d3d, 0xe9612b, 0xf47918, 0xfa9407, 0xfcb014, 0xf8cd37,
                                      0xf2ea69, 0xfcffa4});
        maps.emplace_back(QStringLiteral("magma"),
                          QList<QRgb>{0x000004, 0x090720, 0x1a1042, 0x311165, 0x4a1079, 0x621980, 0x792282, 0x912b81,
                                      0xaa337d, 0xc23b75, 0xd9466b, 0xec5860, 0xf7725c, 0xfc8e64, 0xfeaa74, 0xfec68a,
                                      0xfde2a3, 0xfcfdbf});
        maps.emplace_back(QStringLiteral("viridis"),
                          QList<QRgb>{0x440154, 0x481769, 0x472a7a, 0x433d84, 0x3d4e8a, 0x355e8d, 0x2e6d8e, 0x297b8e,
                                      0x23898e, 0x1f978b, 0x21a585, 0x2eb37c, 0x46c06f, 0x65cb5e, 0x89d548, 0xb0dd2f,
                                      0xd8e219, 0xfde725});
        maps.emplace_back(QStringLiteral("cividis"),
                          QList<QRgb>{0x002051, 0x002b64, 0x0f356c, 0x23406e, 0x374a6e, 0x4b556d, 0x5c606e, 0x6c6b70,
                                      0x797673, 0x858176, 0x928d78, 0x9f9978, 0xaea575, 0xbfb26f, 0xd2bf66, 0xe4cd5a,
                                      0xf4db4e, 0xfdea45});
        maps.emplace_back(QStringLiteral("grey"), QList<QRgb>{0x000000, 0xffffff});
        maps.emplace_back(QStringLiteral("paper"), QList<QRgb>{0xffffff, 0x000000});
        maps.emplace_back(QStringLiteral("blue-red"),
                          QList<QRgb>{0x053061, 0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7, 0xfddbc7, 0xf4a582,
                                      0xd6604d, 0xb2182b, 0x67001f});
        maps.emplace_back(QStringLiteral("ice-fire"),
                          QList<QRgb>{0xd2f0ff, 0x86cdf2, 0x3f9edb, 0x1f6aa8, 0x17406a, 0x14181f, 0x5a2a14, 0x9c431a,
                                      0xdb6f2b, 0xf5a95c, 0xffe2ba});
        return maps;
    }

    const std::vector<ColourMap> &maps()
    {
        static const std::vector<ColourMap> list = makeMaps();
        return list;
    }

} // namespace

ColourMap::ColourMap(QString name, const QList<QRgb> &stops) : m_name(std::move(name))
{
    for (std::size_t i = 0; i < m_entries.size(); ++i) {
        const double position = double(i) / 255.0 * double(stops.size() - 1);
        const auto lower = std::min<qsizetype>(qsizetype(position), stops.size() - 2);
        const double share = position - double(lower);
        const QRgb a = stops[lower], b = stops[lower + 1];
        const auto mix = [share](int x, int y) { return int(std::lround(x + share * (y - x))); };
        m_entries[i] = qRgb(mix(qRed(a), qRed(b)), mix(qGreen(a), qGreen(b)), mix(qBlue(a), qBlue(b)));
    }
}

const QStringList &ColourMap::names()
{
    static const QStringList list = [] {
        QStringList all;
        for (const ColourMap &map : maps())
            all << map.name();
        return all;
    }();
    return list;
}

const QString &ColourMap::defaultName()
{
    return names().front();
}

const ColourMap &ColourMap::named(const QString &name)
{
    const auto index = names().indexOf(name);
    return maps()[std::size_t(std::max<qsizetype>(index, 0))];
}

QString ColourMap::next(const QString &name)
{
    return names()[(names().indexOf(name) + 1) % names().size()];
}

QRgb ColourMap::at(double position) const
{
    const double index = position > 0.0 ? std::min(position, 1.0) * 255.0 : 0.0; // NaN cannot be rounded
    return m_entries[std::size_t(std::lround(index))];
}

} // namespace faintline
