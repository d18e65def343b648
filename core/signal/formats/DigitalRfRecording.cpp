#include "signal/formats/DigitalRfRecording.h"

#include "base/Error.h"
#include "base/Field.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr const char *dataName = "rf_data";
    constexpr const char *indexName = "rf_data_index";

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
    m_info.sampleType = (m_data->isFloat()    ? "float"
                         : m_data->isSigned() ? "int"
                                              : "uint")
                        + std::to_string(m_data->bits());
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
            || Index(inTime) < m_stretches.end())
            throw Error(where, "contradicts itself in line " + std::to_string(i / 2));
        m_stretches.add(numbers[i] - numbers[0], row, end - row);
    }
    m_info.sampleCount = m_stretches.end();
    m_info.places = m_stretches;
    m_info.startUnixSeconds = double(numbers[0]) / m_info.sampleRateHz;
    if (m_stretches.hasGaps())
        m_info.notes.push_back(std::to_string(m_stretches.gaps()) + " gap(s), in all "
                               + std::to_string(m_stretches.missing()) + " samples, which were not observed.");
}

void DigitalRfRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    const float fullScale = m_data->isFloat() ? 1.0f : std::ldexp(1.0f, m_data->bits() - 1);
    const bool isIqByte = m_info.isComplex && m_data->bits() == 8; // see iqByteShift
    const float zero = m_data->isFloat() || m_data->isSigned() ? 0.0f : fullScale - (isIqByte ? 0.5f : 0.0f);
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        const Index floats = m_info.floatsPerSample();
        m_stretches.read(from, floats, inside, [&](Index row, std::span<float> part) {
            const Index samples = std::ssize(part) / floats;
            if (m_data->shape().size() == 2)
                m_data->read({row, channel}, {samples, 1}, part);
            else
                m_data->read({row}, {samples}, part);
            for (float &value : part)
                value = (value - zero) / fullScale;
        });
    });
}

} // namespace faintline
