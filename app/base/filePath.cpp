#include "app/base/filePath.h"

#include "base/Error.h"
#include "base/files/fileName.h"
#include "base/oneLine.h"
#include "widgets/base/labelText.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QUrl>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace faintline {

namespace fs = std::filesystem;

namespace {

    bool isResource(const QString &path)
    {
        return path.startsWith(QLatin1String(":/"));
    }

} // namespace

QString pathText(const std::string &bytes)
{
    return QString::fromStdString(textFromFileName(bytes));
}

std::string pathBytes(const QString &path)
{
    return fileNameFromText(path.toStdString());
}

QString pathOf(const QUrl &url)
{
    // QUrl::toLocalFile() has no letters for bytes that are no text.
    return url.isLocalFile()
               ? pathText(QByteArray::fromPercentEncoding(url.path(QUrl::FullyEncoded).toLatin1()).toStdString())
               : QString();
}

bool fileExists(const QString &path)
{
    std::error_code ignored;
    return fs::exists(pathBytes(path), ignored);
}

bool isRegularFile(const QString &path)
{
    std::error_code ignored;
    return fs::is_regular_file(pathBytes(path), ignored);
}

qint64 fileSize(const QString &path)
{
    std::error_code failure;
    const std::uintmax_t size = fs::file_size(pathBytes(path), failure);
    return failure ? 0 : qint64(size);
}

QString absolutePath(const QString &path)
{
    if (path.isEmpty() || isResource(path))
        return path;
    std::error_code failure;
    const fs::path absolute = fs::absolute(pathBytes(path), failure);
    return failure ? path : pathText(absolute.lexically_normal().string());
}

QByteArray readBeginning(const QString &path, qint64 mostBytes)
{
    QFile file(path);
    const std::string name = pathBytes(path);
    std::FILE *stream = isRegularFile(path) ? std::fopen(name.c_str(), "rb") : nullptr;
    if (!(stream ? file.open(stream, QIODevice::ReadOnly, QFileDevice::AutoCloseHandle)
                 : file.open(QIODevice::ReadOnly)))
        throw Error(name, "cannot be read: " + file.errorString().toStdString());
    return file.read(std::min(mostBytes, file.size()));
}

QString fileLabel(const QString &path)
{
    return labelText(pathBytes(QFileInfo(path).fileName()));
}

QString nameBeside(const QString &path, const QString &ending)
{
    constexpr std::size_t mostBytes = 200; // a file system takes 255, with the ending
    const QFileInfo info(path);
    const QString name = QString::fromStdString(beginning(oneLine(pathBytes(info.completeBaseName())), mostBytes));
    const QString folder = path.startsWith(QLatin1Char(':')) ? QDir::homePath() : info.path();
    return folder + QLatin1Char('/') + QString(name).replace(QLatin1Char('?'), QLatin1Char('_')) + ending;
}

} // namespace faintline
