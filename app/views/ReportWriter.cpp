#include "app/views/ReportWriter.h"

#include "app/base/filePath.h"
#include "app/document/Document.h"
#include "app/document/Provenance.h"
#include "app/document/thresholdWords.h"
#include "app/views/WindowViews.h"
#include "base/files/AtomicFile.h"
#include "widgets/base/Theme.h"

#include <QApplication>
#include <QBuffer>
#include <QPixmap>
#include <QWidget>

#include <algorithm>
#include <utility>

namespace faintline {

namespace {

    /// The cell with the largest statistic in the frame of detection, near the position that the tracker then
    /// estimated.
    std::vector<double> strongestNear(const Analysis &analysis, const Event &event)
    {
        constexpr Index reach = 3;
        const PeakPyramid *statistic = analysis.statistic.get();
        if (!statistic || event.detectedPosition.size() != 1 || statistic->rowCount(0) == 0
            || statistic->framesPerRow(0) != 1)
            return event.detectedPosition;
        const Axis &frequency = analysis.grid().axes.back();
        const auto row = statistic->row(
            0, std::clamp<Index>(analysis.time().nearest(event.detectSeconds), 0, statistic->rowCount(0) - 1));
        const Index centre = frequency.nearest(event.detectedPosition.back());
        Index best = centre;
        for (Index cell = std::max<Index>(0, centre - reach); cell <= std::min(frequency.count - 1, centre + reach);
             ++cell)
            if (row[std::size_t(cell)] > row[std::size_t(best)])
                best = cell;
        return {frequency.value(double(best))};
    }

    /// The page is light, and so are its pictures, whatever the window looks like.
    class LightWhile
    {
    public:
        LightWhile() : m_before(Theme::kind(QApplication::palette())) { change(Theme::Kind::Light); }
        ~LightWhile() { change(m_before); }
        Q_DISABLE_COPY_MOVE(LightWhile)

    private:
        void change(Theme::Kind kind) const
        {
            if (m_before == Theme::Kind::Light)
                return;
            Theme::apply(kind);
            QCoreApplication::sendPostedEvents(); // they bring the palette to the widgets
        }

        Theme::Kind m_before;
    };

} // namespace

std::vector<ReportMaterial::Picture> reportPictures(const WindowViews &views)
{
    const LightWhile light;
    std::vector<ReportMaterial::Picture> pictures;
    const std::pair<const char *, QString> shown[] = {
        {"input", ReportWriter::tr("Input, dB over the noise")},
        {"output", ReportWriter::tr("Statistic of the detector, with events and tracks")},
        {"threshold", ReportWriter::tr("False alarms against the threshold, and this recording's own cells")}};
    for (const auto &[name, title] : shown) {
        QByteArray bytes;
        QBuffer buffer(&bytes);
        buffer.open(QIODevice::WriteOnly);
        const QImage image = views.grab(QString::fromLatin1(name)).toImage().convertToFormat(QImage::Format_RGB32);
        image.save(&buffer, "PNG");
        pictures.push_back({title.toStdString(), bytes.toStdString(), image.width(), image.height()});
    }
    return pictures;
}

void writeReport(const Analysis &analysis, ReportMaterial material, const std::string &path, const RunContext &context)
{
    const std::vector<Event> chosen = eventsToExplain(analysis, material.events, material.annotations);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const auto share = [&](std::size_t n) { return double(n) / double(chosen.size()); };
        material.ladders.push_back(
            {chosen[i].id, explain(analysis, chosen[i].detectSeconds, strongestNear(analysis, chosen[i]),
                                   context.part(share(i), share(i + 1)))});
    }
    writeTextFile(path, reportHtml(analysis, material));
}

ReportWriter::ReportWriter(const Document &document, const WindowViews &views, QObject *parent)
    : QObject(parent), m_document(document), m_views(views)
{
    connect(&m_runner, &JobRunner::failed, this, &ReportWriter::failed);
}

void ReportWriter::write(const QString &path)
{
    if (!m_document.analysis())
        return;
    if (m_document.analysis()->calibration->isFirstEstimate)
        return emit failed(firstEstimateError());
    ReportMaterial material;
    material.title = m_document.sourceName().toStdString();
    material.version = FAINTLINE_VERSION;
    material.events = m_document.shownEvents();
    material.annotations = m_document.annotations();
    material.pictures = reportPictures(m_views);
    m_runner.start([this, path, material = std::move(material), analysis = m_document.analysis(),
                    session = shownSession(m_document)](const RunContext &context) mutable -> JobRunner::Delivery {
        context.checkpoint(0.0, "report");
        material.provenance = provenanceOf(std::move(session));
        writeReport(*analysis, std::move(material), pathBytes(path), context);
        return [this, path] { emit written(path); };
    });
}

} // namespace faintline
