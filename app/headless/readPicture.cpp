#include "app/headless/readPicture.h"

#include "app/base/filePath.h"
#include "app/document/Provenance.h"
#include "base/Error.h"

#include <QBuffer>
#include <QImageReader>
#include <QtEndian>

#include <cstdio>
#include <limits>

#include <fcntl.h>
#include <unistd.h>

namespace faintline {

namespace {

    /// Discards standard error during its lifetime.
    class Silence
    {
    public:
        Silence() : m_before(::dup(STDERR_FILENO))
        {
            std::fflush(stderr);
            const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
            if (m_before >= 0 && nowhere >= 0)
                ::dup2(nowhere, STDERR_FILENO);
            ::close(nowhere);
        }
        ~Silence()
        {
            if (m_before < 0)
                return;
            std::fflush(stderr);
            ::dup2(m_before, STDERR_FILENO);
            ::close(m_before);
        }
        Silence(const Silence &) = delete;
        Silence &operator=(const Silence &) = delete;

    private:
        int m_before;
    };

    /// A chunk of a PNG: length, type, data, checksum.
    constexpr qsizetype signatureBytes = 8, beforeData = 8, afterData = 4;

    bool isText(const QByteArray &type)
    {
        return type == "tEXt" || type == "zTXt" || type == "iTXt";
    }

    /// The picture with what is read of it alone: what is drawn, and the first text under our key. The PNG library
    /// allocates what a chunk's length says, and expands every text, before it looks whether anyone wants them.
    QByteArray wantedChunks(const QByteArray &bytes, const std::string &name)
    {
        QByteArray wanted = bytes.left(signatureBytes);
        const QByteArray key = pictureProvenanceKey().toLatin1() + '\0';
        bool hasProvenance = false;
        for (qsizetype at = signatureBytes; at + beforeData + afterData <= bytes.size();) {
            const qint64 length = qFromBigEndian<quint32>(bytes.constData() + at);
            const qint64 chunkBytes = beforeData + length + afterData;
            const QByteArray type = bytes.mid(at + 4, 4);
            if (chunkBytes > bytes.size() - at)
                throw Error(name, "cannot be read as PNG: a chunk of " + std::to_string(length)
                                      + " bytes reaches beyond the end of the file");
            const bool isProvenance = !hasProvenance && isText(type) && bytes.mid(at + beforeData, key.size()) == key;
            hasProvenance |= isProvenance;
            if (isProvenance || type == "IHDR" || type == "PLTE" || type == "tRNS" || type == "IDAT" || type == "IEND")
                wanted += bytes.mid(at, chunkBytes);
            at += chunkBytes;
        }
        return wanted;
    }

} // namespace

QImage readPicture(const QString &path)
{
    QByteArray bytes = wantedChunks(readBeginning(path, std::numeric_limits<int>::max()), pathBytes(path));
    QBuffer buffer(&bytes);
    QImageReader reader(&buffer, "png");
    QImage image;
    {
        const Silence silence;
        image = reader.read();
    }
    if (image.isNull())
        throw Error(pathBytes(path), "cannot be read as PNG: " + reader.errorString().toStdString());
    return image;
}

} // namespace faintline
