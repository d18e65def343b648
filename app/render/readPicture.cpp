#include "app/render/readPicture.h"

#include "app/base/filePath.h"
#include "base/Error.h"

#include <QBuffer>
#include <QImageReader>

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

} // namespace

QImage readPicture(const QString &path)
{
    QByteArray bytes = readBeginning(path, std::numeric_limits<int>::max());
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
