#include "app/headless/comparePictures.h"

#include "app/headless/readPicture.h"
#include "base/Error.h"
#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"
#include "widgets/plot/ColourMap.h"

#include <QBuffer>
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QMap>
#include <QPainter>
#include <QUrl>

#include <algorithm>
#include <set>
#include <utility>

namespace faintline {

namespace {

    constexpr qint64 pixelsPerTolerated = 100000;
    constexpr int block = 16; ///< changed pixels in touching blocks of this size lie together

    QRgb opaque(QRgb colour)
    {
        return colour | 0xff000000u;
    }

    /// Pairs of neighbouring colours of a colour map, the smaller one first.
    const std::set<std::pair<QRgb, QRgb>> &neighbours()
    {
        static const std::set<std::pair<QRgb, QRgb>> all = [] {
            std::set<std::pair<QRgb, QRgb>> pairs;
            for (const QString &name : ColourMap::names()) {
                const auto &entries = ColourMap::named(name).entries();
                for (std::size_t i = 1; i < entries.size(); ++i)
                    pairs.insert(std::minmax(opaque(entries[i - 1]), opaque(entries[i])));
            }
            return pairs;
        }();
        return all;
    }

    bool areNeighbours(QRgb a, QRgb b)
    {
        const std::pair<QRgb, QRgb> pair = std::minmax(a, b);
        return neighbours().contains(pair);
    }

    QRgb pixel(const QImage &image, QPoint at)
    {
        return reinterpret_cast<const QRgb *>(image.constScanLine(at.y()))[at.x()];
    }

    struct Changes {
        std::vector<QPoint> plain;
        std::vector<QPoint> slight; ///< one colour of a colour map away
    };

    Changes changesBetween(const QImage &a, const QImage &b)
    {
        Changes changes;
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x)
                if (const QRgb p = pixel(a, {x, y}), q = pixel(b, {x, y}); p != q)
                    (areNeighbours(p, q) ? changes.slight : changes.plain).emplace_back(x, y);
        return changes;
    }

    /// Boxes around groups of changed pixels: blocks that contain changed pixels are joined with touching blocks.
    std::vector<QRect> placesOf(const std::vector<QPoint> &pixels)
    {
        QMap<std::pair<int, int>, QRect> blocks;
        for (const QPoint &p : pixels)
            blocks[{p.y() / block, p.x() / block}] |= QRect(p, QSize(1, 1));
        std::vector<QRect> places;
        while (!blocks.isEmpty()) {
            QRect place;
            std::vector<std::pair<int, int>> open{blocks.firstKey()};
            while (!open.empty()) {
                const auto [row, column] = open.back();
                open.pop_back();
                const auto found = blocks.find({row, column});
                if (found == blocks.end())
                    continue;
                place |= *found;
                blocks.erase(found);
                for (int y = row - 1; y <= row + 1; ++y)
                    for (int x = column - 1; x <= column + 1; ++x)
                        open.emplace_back(y, x);
            }
            places.push_back(place);
        }
        return places;
    }

    QImage drawn(const QImage &actual, const std::vector<QPoint> &pixels, const std::vector<QRect> &places)
    {
        QImage picture(actual.size(), QImage::Format_RGB32);
        for (int y = 0; y < actual.height(); ++y)
            for (int x = 0; x < actual.width(); ++x) {
                const int pale = 200 + qGray(pixel(actual, {x, y})) * 50 / 255;
                picture.setPixel(x, y, qRgb(pale, pale, pale));
            }
        for (const QPoint &p : pixels)
            picture.setPixel(p, qRgb(214, 0, 28));
        QPainter painter(&picture);
        painter.setPen(QPen(QColor(214, 0, 28), 2.0));
        for (const QRect &place : places)
            painter.drawRect(place.adjusted(-6, -6, 6, 6));
        return picture;
    }

    // ---- files ------------------------------------------------------------------------------------------------------

    void writePicture(const QImage &image, const QString &path)
    {
        QByteArray bytes;
        QBuffer buffer(&bytes);
        buffer.open(QIODevice::WriteOnly);
        image.save(&buffer, "PNG");
        QDir().mkpath(QFileInfo(path).path());
        writeTextFile(path.toStdString(), bytes.toStdString());
    }

    void copyFile(const QString &from, const QString &to)
    {
        QFile file(from);
        if (!file.open(QIODevice::ReadOnly))
            throw Error(from.toStdString(), file.errorString().toStdString());
        QDir().mkpath(QFileInfo(to).path());
        writeTextFile(to.toStdString(), file.readAll().toStdString());
    }

    /// Name → path of the pictures in a folder, or of the one picture.
    QMap<QString, QString> picturesIn(const QString &where, bool isFolder)
    {
        if (!isFolder)
            return {{QStringLiteral("picture.png"), where}};
        QMap<QString, QString> found;
        const QDir folder(QFileInfo(where).absoluteFilePath()); // a name relative to another folder would be its own
        QDirIterator all(folder.path(), {QStringLiteral("*.png")}, QDir::Files, QDirIterator::Subdirectories);
        while (all.hasNext()) {
            const QString path = all.next();
            found.insert(folder.relativeFilePath(path), path);
        }
        return found;
    }

    bool isInside(const QString &path, const QString &folder)
    {
        const QString inner = QDir::cleanPath(QFileInfo(path).absoluteFilePath()) + QLatin1Char('/');
        return inner.startsWith(QDir::cleanPath(QFileInfo(folder).absoluteFilePath()) + QLatin1Char('/'));
    }

    // ---- the report -------------------------------------------------------------------------------------------------

    QString sizeText(QSize size)
    {
        return size.isValid() ? QStringLiteral("%1 × %2").arg(size.width()).arg(size.height()) : QStringLiteral("–");
    }

    QString href(const char *folder, const QString &name)
    {
        return QString::fromLatin1(QUrl::toPercentEncoding(QLatin1String(folder) + QLatin1Char('/') + name, "/"));
    }

    QString figure(const char *folder, const QString &name, const char *caption)
    {
        return QStringLiteral(
                   "<figure><a href=\"%1\"><img src=\"%1\" alt=\"%2 %3\"></a><figcaption>%2</figcaption></figure>\n")
            .arg(href(folder, name), QLatin1String(caption), name.toHtmlEscaped());
    }

    QString section(const CheckedPicture &one)
    {
        using State = CheckedPicture::State;
        QString text =
            QStringLiteral("<section>\n<h2>%1</h2>\n<p>%2</p>\n").arg(one.name.toHtmlEscaped(), verdictOf(one));
        if (!one.difference.places.empty()) {
            QStringList places;
            for (const QRect &place : one.difference.places)
                places << QStringLiteral("%1 × %2 at (%3, %4)")
                              .arg(place.width())
                              .arg(place.height())
                              .arg(place.x())
                              .arg(place.y());
            constexpr qsizetype most = 12;
            const bool isLong = places.size() > most;
            text +=
                QStringLiteral("<p class=\"places\">%1%2</p>\n")
                    .arg(places.mid(0, most).join(QStringLiteral("; ")), isLong ? QStringLiteral("; …") : QString());
        }
        text += QStringLiteral("<div>\n");
        if (one.state != State::New)
            text += figure("expected", one.name, "expected");
        if (one.state != State::Missing)
            text += figure("actual", one.name, "actual");
        if (one.state == State::Different && one.difference.isSameSize)
            text += figure("difference", one.name, "difference");
        return text + QStringLiteral("</div>\n</section>\n");
    }

    QString row(const CheckedPicture &one)
    {
        return QStringLiteral("<tr class=\"%1\"><td>%2</td><td>%3</td><td>%4</td><td>%5</td></tr>\n")
            .arg(one.differs() ? QStringLiteral("other") : QStringLiteral("same"), one.name.toHtmlEscaped(),
                 verdictOf(one), sizeText(one.expectedSize), sizeText(one.actualSize));
    }

    QString pageOf(const std::vector<CheckedPicture> &pictures)
    {
        const auto differing = std::ranges::count_if(pictures, &CheckedPicture::differs);
        QString text = QStringLiteral(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Pictures "
            "compared</title>\n<style>\n"
            "body{font:15px/1.45 sans-serif;margin:2em;color:#1c2127;background:#fff}\n"
            "table{border-collapse:collapse}td,th{text-align:left;padding:.25em 1em .25em 0;border-bottom:1px solid "
            "#dde1e6}\n"
            "tr.other td{color:#b00018}\nsection{margin-top:2.5em}\ndiv{display:flex;flex-wrap:wrap;gap:1em}\n"
            "figure{margin:0;flex:1 1 22em;max-width:100%}img{max-width:100%;border:1px solid #c4cad1}\n"
            "figcaption,.places{color:#59636e}\n</style>\n</head>\n<body>\n");
        text += QStringLiteral("<h1>%1 of %2 picture(s) differ</h1>\n").arg(differing).arg(pictures.size());
        text += QStringLiteral("<table>\n<tr><th>Picture</th><th>Verdict</th><th>Expected</th><th>Actual</th></tr>\n");
        for (const CheckedPicture &one : pictures)
            text += row(one);
        text += QStringLiteral("</table>\n");
        for (const CheckedPicture &one : pictures)
            if (one.differs())
                text += section(one);
        return text + QStringLiteral("</body>\n</html>\n");
    }

    CheckedPicture check(const QString &name, const QString &expectedPath, const QString &actualPath,
                         bool toleratesRasters)
    {
        CheckedPicture one;
        one.name = name;
        const QImage expected = expectedPath.isEmpty() ? QImage() : readPicture(expectedPath);
        const QImage actual = actualPath.isEmpty() ? QImage() : readPicture(actualPath);
        one.expectedSize = expected.isNull() ? QSize() : expected.size();
        one.actualSize = actual.isNull() ? QSize() : actual.size();
        if (expected.isNull() || actual.isNull()) {
            one.state = expected.isNull() ? CheckedPicture::State::New : CheckedPicture::State::Missing;
            return one;
        }
        one.difference = comparePictures(expected, actual, toleratesRasters);
        one.state = one.difference.isEqual() ? CheckedPicture::State::Same : CheckedPicture::State::Different;
        return one;
    }

    void keep(const CheckedPicture &one, const QString &expectedPath, const QString &actualPath, const QDir &out)
    {
        if (!expectedPath.isEmpty())
            copyFile(expectedPath, out.filePath(QStringLiteral("expected/") + one.name));
        if (!actualPath.isEmpty())
            copyFile(actualPath, out.filePath(QStringLiteral("actual/") + one.name));
        if (!one.difference.picture.isNull())
            writePicture(one.difference.picture, out.filePath(QStringLiteral("difference/") + one.name));
    }

} // namespace

QString verdictOf(const CheckedPicture &one)
{
    switch (one.state) {
    case CheckedPicture::State::Same:
        return one.difference.toleratedPixels > 0
                   ? QStringLiteral("same, except for %1 tolerated raster pixel(s)").arg(one.difference.toleratedPixels)
                   : QStringLiteral("same");
    case CheckedPicture::State::Missing:
        return QStringLiteral("missing: expected but not found");
    case CheckedPicture::State::New:
        return QStringLiteral("new: found but not expected");
    case CheckedPicture::State::Different:
        break;
    }
    if (!one.difference.isSameSize)
        return QStringLiteral("different size: %1 instead of %2")
            .arg(sizeText(one.actualSize), sizeText(one.expectedSize));
    return QStringLiteral("%1 pixel(s) changed in %2 place(s)")
        .arg(one.difference.changedPixels)
        .arg(one.difference.places.size());
}

PictureDifference comparePictures(const QImage &expected, const QImage &actual, bool toleratesRasters)
{
    PictureDifference result;
    result.isSameSize = expected.size() == actual.size();
    if (!result.isSameSize)
        return result;
    const QImage a = expected.convertToFormat(QImage::Format_ARGB32);
    const QImage b = actual.convertToFormat(QImage::Format_ARGB32);
    Changes changes = changesBetween(a, b);
    const auto slight = qint64(changes.slight.size());
    if (toleratesRasters && slight * pixelsPerTolerated <= qint64(a.width()) * a.height())
        result.toleratedPixels = slight;
    else
        changes.plain.insert(changes.plain.end(), changes.slight.begin(), changes.slight.end());
    result.changedPixels = qint64(changes.plain.size());
    result.places = placesOf(changes.plain);
    if (!result.isEqual())
        result.picture = drawn(b, changes.plain, result.places);
    return result;
}

std::vector<CheckedPicture> checkPictures(const CheckOptions &options)
{
    const QString expected = QString::fromStdString(options.expected);
    const QString actual = QString::fromStdString(options.actual);
    for (const QString &path : {expected, actual})
        if (!QFileInfo::exists(path))
            throw Error(path.toStdString(), "does not exist; give two PNGs or two folders of PNGs");
    const bool areFolders = QFileInfo(expected).isDir();
    if (areFolders != QFileInfo(actual).isDir())
        throw Error("check-pictures", "requires two PNGs or two folders of PNGs, not one of each");
    const QString out = QString::fromStdString(options.out);
    if (areFolders && !out.isEmpty() && (isInside(out, expected) || isInside(out, actual)))
        throw Error("--out " + options.out, "must lie outside the folders compared, or the next run would compare its "
                                            "own report");

    const QMap<QString, QString> wanted = picturesIn(expected, areFolders);
    const QMap<QString, QString> made = picturesIn(actual, areFolders);
    QMap<QString, QString> names = wanted;
    names.insert(made);
    if (wanted.isEmpty())
        throw Error(options.expected, "contains no PNG to check");
    std::vector<CheckedPicture> pictures;
    if (!out.isEmpty() && !QDir().mkpath(out))
        throw Error(options.out, "cannot be created", Error::Kind::Failure);
    for (const QString &name : names.keys()) {
        CheckedPicture one = check(name, wanted.value(name), made.value(name), options.toleratesRasters);
        if (!out.isEmpty() && one.differs())
            keep(one, wanted.value(name), made.value(name), QDir(out));
        one.difference.picture = {}; // limits memory to one picture
        pictures.push_back(std::move(one));
    }
    if (!out.isEmpty())
        writeTextFile(QDir(out).filePath(QStringLiteral("index.html")).toStdString(), pageOf(pictures).toStdString());
    return pictures;
}

} // namespace faintline
