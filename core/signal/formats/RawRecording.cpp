#include "signal/formats/RawRecording.h"

#include "base/Error.h"
#include "base/Field.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <utility>

namespace faintline {

namespace {

    constexpr Index readBytes = 256 * 1024; ///< at a time

    void check(const std::string &path, const RawLayout &layout)
    {
        if (!(layout.sampleRateHz > 0.0) || !std::isfinite(layout.sampleRateHz))
            throw Error(path, "its sample rate, " + formatNumber(layout.sampleRateHz) + " Hz, must be above 0");
        if (layout.channelCount < 1 || layout.channelCount > 1024)
            throw Error(path, "its channel count, " + std::to_string(layout.channelCount) + ", must lie in 1 … 1024");
        if (layout.headerBytes < 0 || layout.trailingBytes < 0)
            throw Error(path, "the lengths of its header and trailer must not be negative");
    }

} // namespace

RawLayout withIqPairs(const std::string &path, RawLayout layout)
{
    if (layout.type.isComplex)
        return layout;
    if (layout.channelCount % 2 != 0)
        throw Error(path, "has " + std::to_string(layout.channelCount) + " channel(s); I/Q needs an even number");
    layout.type.isComplex = true;
    layout.channelCount /= 2;
    return layout;
}

RawRecording::RawRecording(const std::string &path, const RawLayout &layout) : m_file(path), m_layout(layout)
{
    check(path, layout);
    m_frameBytes = layout.type.sampleBytes() * layout.channelCount;
    const Index dataBytes =
        m_file.size() - std::min(layout.headerBytes, m_file.size()) - std::min(layout.trailingBytes, m_file.size());
    m_info.path = path;
    m_info.container = "raw";
    m_info.sampleType = layout.type.name();
    m_info.sampleRateHz = layout.sampleRateHz;
    m_info.sampleCount = std::max<Index>(dataBytes, 0) / m_frameBytes;
    m_info.channelCount = layout.channelCount;
    m_info.isComplex = layout.type.isComplex;
    if (m_info.sampleCount == 0)
        throw Error(path,
                    "contains no complete sample: " + std::to_string(m_file.size()) + " bytes, but one sample takes "
                        + std::to_string(m_frameBytes)
                        + (layout.headerBytes > 0 ? " after a header of " + std::to_string(layout.headerBytes) : ""));
    if (m_info.isComplex && layout.type.number == SampleType::Number::Unsigned && layout.type.bytes == 1)
        m_info.notes.push_back("The zero of these bytes is taken to lie between 127 and 128, as in receivers.");
    if (const Index rest = dataBytes % m_frameBytes)
        m_info.notes.push_back("The file's last " + std::to_string(rest)
                               + " bytes are an incomplete sample and are ignored; the file may have been truncated.");
}

void RawRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) { readFile(channel, from, inside); });
}

void RawRecording::readFile(int channel, Index first, std::span<float> out) const
{
    const Index floats = m_info.floatsPerSample();
    const Index samples = std::ssize(out) / floats;
    const Index perRead = std::max<Index>(1, readBytes / m_frameBytes);
    std::vector<std::byte> bytes(std::size_t(std::min(samples, perRead) * m_frameBytes));
    for (Index done = 0; done < samples;) {
        const Index run = std::min(perRead, samples - done);
        const std::span<std::byte> wanted = std::span(bytes).first(std::size_t(run * m_frameBytes));
        if (m_file.readAt(m_layout.headerBytes + (first + done) * m_frameBytes, wanted) < wanted.size())
            throw Error(m_info.path, "was truncated while open", Error::Kind::Failure);
        convertSamples(m_layout.type, wanted.subspan(std::size_t(channel * m_layout.type.sampleBytes())), m_frameBytes,
                       out.subspan(std::size_t(done * floats), std::size_t(run * floats)));
        done += run;
    }
}

std::optional<std::string> rawTypeOfExtension(const std::string &path)
{
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 30> known{{
        {".cf32", "cf32_le"}, {".fc32", "cf32_le"}, {".cfile", "cf32_le"}, {".complex", "cf32_le"},
        {".cf64", "cf64_le"}, {".fc64", "cf64_le"}, {".ci8", "ci8"},       {".cs8", "ci8"},
        {".sc8", "ci8"},      {".ci16", "ci16_le"}, {".cs16", "ci16_le"},  {".sc16", "ci16_le"},
        {".ci32", "ci32_le"}, {".cs32", "ci32_le"}, {".cu8", "cu8"},       {".cu16", "cu16_le"},
        {".cu32", "cu32_le"}, {".rf32", "rf32_le"}, {".f32", "rf32_le"},   {".f64", "rf64_le"},
        {".s8", "ri8"},       {".s16", "ri16_le"},  {".s32", "ri32_le"},   {".u8", "ru8"},
        {".u16", "ru16_le"},  {".iq", ""},          {".raw", ""},          {".bin", ""},
        {".dat", ""},         {".pcm", ""},
    }};
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const auto &[name, type] : known)
        if (extension == name)
            return std::string(type);
    return std::nullopt;
}

} // namespace faintline
