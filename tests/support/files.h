#pragma once

#include <QByteArray>
#include <QFile>

#include <cstdint>
#include <string>

namespace faintline::test {

inline void writeBytes(const std::string &path, const QByteArray &bytes)
{
    QFile file(QString::fromStdString(path));
    file.remove(); // some file systems write at once what replaces a file, which takes milliseconds
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size())
        qFatal("cannot write a test file");
}

inline QByteArray readBytes(const QString &path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

inline QByteArray readBytes(const std::string &path)
{
    return readBytes(QString::fromStdString(path));
}

/// The lowest bytes of a whole number, the lowest first.
inline QByteArray littleEndian(std::uint64_t value, int bytes)
{
    QByteArray text;
    for (int i = 0; i < bytes; ++i)
        text.append(static_cast<char>(value >> (8 * i)));
    return text;
}

} // namespace faintline::test
