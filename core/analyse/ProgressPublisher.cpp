#include "analyse/ProgressPublisher.h"

#include "analyse/quickLook.h"
#include "calibrate/calibrate.h"

namespace faintline {

ProgressPublisher::ProgressPublisher(const PictureSink &sink, const Axis &time, const Axis &frequency,
                                     const AnalysisSettings &settings)
    : m_sink(sink)
{
    constexpr double manyCells = 3e7;
    const bool isLong = double(time.count) * double(frequency.count) > manyCells;
    m_isWanted = sink && (isLong || !knownCalibration(settings));
    m_pictures.time = time;
    m_pictures.frequency = frequency;
}

void ProgressPublisher::publishQuickLook(std::shared_ptr<const Spectrogram> spectrogram,
                                         const NormaliserSettings &settings, const RunContext &context)
{
    if (!m_isWanted)
        return;
    m_pictures.quickLook = quickLook(std::move(spectrogram), settings, context);
    m_sink(m_pictures);
}

void ProgressPublisher::publish(const std::shared_ptr<PeakPyramid> &input, const PeakPyramid &statistic)
{
    constexpr std::chrono::milliseconds interval{400};
    const auto now = std::chrono::steady_clock::now();
    if (!m_isWanted || now - m_last < interval)
        return;
    m_last = now;
    m_pictures.input = input ? std::make_shared<const PeakPyramid>(input->soFar()) : nullptr;
    m_pictures.statistic = std::make_shared<const PeakPyramid>(statistic.soFar());
    m_sink(m_pictures);
}

} // namespace faintline
