#include "app/features/pictures/PingRegulation.h"

#include "analyse/regulation.h"
#include "app/document/FrameKind.h"
#include "app/features/pictures/RegulationPlot.h"

#include <QLabel>
#include <QVBoxLayout>

namespace faintline {

PingRegulation::PingRegulation(Viewport &time, QWidget *parent)
    : QWidget(parent), m_dragged(new QLabel), m_plot(new RegulationPlot)
{
    m_dragged->setWordWrap(true);
    m_dragged->setTextFormat(Qt::PlainText);
    m_dragged->setContentsMargins(10, 4, 10, 0);
    m_dragged->hide();
    m_plot->setViewport(&time);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_dragged);
    layout->addWidget(m_plot, 1);
}

void PingRegulation::show(const Analysis &analysis)
{
    m_plot->setAnalysis(analysis);
    const NoiseBand &band = analysis.lnKBand;
    m_plot->setBand(band.deviation > 0.0 ? std::optional(Span{band.low(), band.high()}) : std::nullopt);
    const std::vector<Index> dragged = draggedFrames(analysis);
    m_dragged->setVisible(!dragged.empty());
    const FrameKind &kind = frameKindOf(analysis.grid());
    if (!dragged.empty())
        m_dragged->setText(tr("⚠ ln K lies below its noise band in %1 of %2 %4, first in %5 %3. Signals without a "
                              "track lower it, and with it every other statistic.")
                               .arg(dragged.size())
                               .arg(analysis.lnK.size())
                               .arg(dragged.front() + 1)
                               .arg(kind.frames, kind.frame));
}

void PingRegulation::clear(const QString &emptySentence)
{
    m_plot->clear(emptySentence);
}

} // namespace faintline
