#include "signal/formats/StrainRecording.h"

#include "base/Error.h"
#include "base/Field.h"
#include "signal/timeInName.h"

#include <cmath>

namespace faintline {

namespace {

    constexpr const char *strainName = "strain/Strain";

} // namespace

bool StrainRecording::recognises(const std::string &path)
{
    return Hdf5File::recognises(path) && Hdf5File(path).dataset(strainName);
}

StrainRecording::StrainRecording(const std::string &path)
    : m_file(std::make_unique<Hdf5File>(path)), m_strain(m_file->dataset(strainName))
{
    if (!m_strain || m_strain->isComplex() || m_strain->shape().size() != 1)
        throw Error(path, "holds no strain/Strain with one number per sample");
    const double spacing = m_strain->number("Xspacing").value_or(0.0);
    constexpr double spacingMinimumSeconds = 1e-9;
    if (!(spacing >= spacingMinimumSeconds && spacing <= 1e6))
        throw Error(path + ": strain/Strain: Xspacing = " + formatNumber(spacing),
                    "must be the sample interval in seconds");
    m_info.path = path;
    m_info.container = "HDF5 strain";
    m_info.sampleType = (m_strain->isFloat() ? "float" : "int") + std::to_string(m_strain->bits());
    m_info.sampleRateHz = 1.0 / spacing;
    if (std::abs(m_info.sampleRateHz - std::round(m_info.sampleRateHz)) < 1e-6 * m_info.sampleRateHz
        && m_info.sampleRateHz >= 1.0)
        m_info.sampleRateHz = std::round(m_info.sampleRateHz); // the interval in the file is rounded
    m_info.sampleCount = m_strain->shape().front();
    m_info.channelCount = 1;
    if (const auto start = m_strain->number("Xstart"); start && *start > 0.0 && *start < 1e10)
        m_info.startUnixSeconds = unixFromGps(*start);
    readMask();
}

void StrainRecording::readMask()
{
    constexpr Index dataBit = 1;
    const auto mask = m_file->dataset("quality/simple/DQmask");
    const auto seconds = Index(std::ceil(m_info.durationSeconds()));
    if (!mask || mask->isFloat() || mask->isComplex() || mask->shape() != std::vector<Index>{seconds}
        || double(seconds) > Stretches::longestSeconds)
        return;
    const std::vector<std::int64_t> bits = mask->readIntegers();
    const auto sampleOf = [&](Index second) {
        return std::min(m_info.sampleCount, Index(std::llround(double(second) * m_info.sampleRateHz)));
    };
    for (Index second = 0; second < seconds; ++second)
        if (const Index first = sampleOf(second); bits[std::size_t(second)] & dataBit)
            m_taken.add(first, first, sampleOf(second + 1) - first);
    m_hasMask = true;
    if (const Index missing = m_info.sampleCount - m_taken.samples(); missing > 0)
        m_info.notes.push_back(formatNumber(double(missing) / m_info.sampleRateHz)
                               + " s were not taken by the detector and are not observed.");
}

bool StrainRecording::isWhole(Index first, Index count) const
{
    return !m_hasMask
           || (std::min(first + count, m_info.sampleCount) <= m_taken.end() && m_taken.isWhole(first, count));
}

void StrainRecording::read(int, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out,
         [&](Index from, std::span<float> inside) { m_strain->read({from}, {std::ssize(inside)}, inside); });
}

} // namespace faintline
