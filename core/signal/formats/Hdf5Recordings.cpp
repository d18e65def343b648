#include "signal/formats/Hdf5Recordings.h"

#include "base/Error.h"
#include "base/Field.h"
#include "signal/timeInName.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr const char *dataName = "rf_data";
    constexpr const char *indexName = "rf_data_index";
    constexpr const char *strainName = "strain/Strain";

    double rateOf(const Hdf5Dataset &data, const std::string &path)
    {
        const double rate =
            data.number("sample_rate_numerator").value_or(data.number("samples_per_second").value_or(0.0))
            / data.number("sample_rate_denominator").value_or(1.0);
        if (!(rate >= 1e-9 && rate <= 1e15))
            throw Error(
                path + ": rf_data: sample rate = " + formatNumber(rate),
                "must be given by sample_rate_numerator and sample_rate_denominator, or samples_per_second, Hz");
        return rate;
    }

} // namespace

bool DigitalRfRecording::recognises(const std::string &path)
{
    if (!Hdf5File::recognises(path))
        return false;
    const Hdf5File file(path);
    return file.dataset(dataName) && file.dataset(indexName);
}

DigitalRfRecording::DigitalRfRecording(const std::string &path)
    : m_file(std::make_unique<Hdf5File>(path)), m_data(m_file->dataset(dataName))
{
    constexpr Index mostSubchannels = 1024;
    if (!m_data || m_data->shape().size() > 2 || (m_data->shape().size() == 2 && m_data->shape()[1] > mostSubchannels))
        throw Error(path, "holds no rf_data with samples of at most 1024 subchannels");
    m_info.path = path;
    m_info.container = "Digital RF";
    m_info.sampleType = m_data->typeName();
    m_info.sampleRateHz = rateOf(*m_data, path);
    m_info.channelCount = m_data->shape().size() == 2 ? int(m_data->shape()[1]) : 1;
    m_info.isComplex = m_data->isComplex();
    readIndex();
}

void DigitalRfRecording::readIndex()
{
    const std::string where = m_info.path + ": " + indexName;
    const auto index = m_file->dataset(indexName);
    if (!index || index->isFloat() || index->shape().size() != 2 || index->shape()[1] != 2)
        throw Error(where, "must hold a first sample and a row for each stretch, as whole numbers");
    const std::vector<std::int64_t> numbers = index->readIntegers();
    const Index rows = m_data->shape().front();
    const double longest = std::min(1e18, Stretches::longestSeconds * m_info.sampleRateHz); // far from an overflow
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
        const bool isLast = i + 2 == numbers.size();
        const Index row = numbers[i + 1];
        const Index end = isLast ? rows : numbers[i + 3];
        const double inTime = double(numbers[i]) - double(numbers[0]);
        if (numbers[i] < 0 || (i == 0 && row != 0) || row < 0 || end <= row || end > rows || inTime > longest
            || Index(inTime) < m_info.places.end())
            throw Error(where, "contradicts itself in line " + std::to_string(i / 2));
        m_info.places.add(numbers[i] - numbers[0], row, end - row);
    }
    m_info.sampleCount = m_info.places.end();
    m_info.startUnixSeconds = double(numbers[0]) / m_info.sampleRateHz;
    if (m_info.places.hasGaps())
        m_info.notes.push_back(std::to_string(m_info.places.gaps()) + " gap(s), in all "
                               + std::to_string(m_info.places.missing()) + " samples, which were not observed.");
}

void DigitalRfRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    const float fullScale = m_data->isFloat() ? 1.0f : std::ldexp(1.0f, m_data->bits() - 1);
    const bool isIqByte = m_info.isComplex && m_data->bits() == 8; // see iqByteShift
    const float zero = m_data->isFloat() || m_data->isSigned() ? 0.0f : fullScale - (isIqByte ? 0.5f : 0.0f);
    fillStored(first, count, out, [&](Index row, std::span<float> part) {
        const Index samples = std::ssize(part) / m_info.floatsPerSample();
        if (m_data->shape().size() == 2)
            m_data->read({row, channel}, {samples, 1}, part);
        else
            m_data->read({row}, {samples}, part);
        for (float &value : part)
            value = (value - zero) / fullScale;
    });
}

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
    m_info.sampleType = m_strain->typeName();
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
