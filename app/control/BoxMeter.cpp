#include "app/control/BoxMeter.h"

#include "app/document/Document.h"
#include "inspect/boxLevels.h"
#include "widgets/base/cellsOf.h"
#include "widgets/base/quantities.h"

namespace faintline {

namespace {

    constexpr int pauseMs = 40;

    QString noteOf(const BoxLevels &levels, bool saysMean, bool isRest)
    {
        const QString mean = saysMean ? BoxMeter::tr("mean %1 dB · ").arg(numberText(levels.meanDb, 1)) : QString();
        const QString area = levels.snrDb ? BoxMeter::tr("area SNR %1 dB").arg(numberText(*levels.snrDb, 1))
                                          : BoxMeter::tr("not above the noise beside it");
        return mean + area + (isRest ? BoxMeter::tr(" · strong lines subtracted") : QString());
    }

} // namespace

BoxMeter::BoxMeter(Document &document, QObject *parent) : QObject(parent), m_document(document)
{
    m_pause.setSingleShot(true);
    m_pause.setInterval(pauseMs);
    connect(&m_pause, &QTimer::timeout, this, &BoxMeter::measure);
    connect(&document.viewport(), &Viewport::selectionChanged, this, &BoxMeter::follow);
    connect(&document, &Document::analysisChanged, this, &BoxMeter::follow);
}

void BoxMeter::follow()
{
    m_runner.cancel();
    m_pause.start();
}

void BoxMeter::measure()
{
    const auto &analysis = m_document.analysis();
    const auto selected = m_document.box();
    if (!analysis || !selected)
        return;
    const auto [beginFrame, endFrame] = cellsOf(analysis->time(), selected->time);
    const auto [beginCell, endCell] = cellsOf(analysis->grid().axes.front(), selected->frequency);
    const FrameBox box{beginFrame, endFrame, beginCell, endCell};
    const bool saysMean = analysis->input->framesPerRow(0) > 1; // otherwise the picture shows it
    m_runner.start([this, analysis, box, saysMean](const RunContext &context) -> JobRunner::Delivery {
        const bool isRest = analysis->unsubtracted != nullptr;
        const QString note = noteOf(boxLevels(*analysis, box, context), saysMean, isRest);
        return [this, note] { emit measured(note); };
    });
}

} // namespace faintline
