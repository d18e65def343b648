#include "signal/formats/SigprocFile.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/oneLine.h"
#include "signal/formats/bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string_view>

namespace faintline {

namespace {

    constexpr Index mostHeaderBytes = 1 << 16;
    constexpr Index longestWord = 255;
    constexpr double largestCount = 1 << 26;
    constexpr std::string_view headerStart = "HEADER_START";

    /// Type of the value after a keyword.
    enum class Kind { Whole, Real, Text, Byte, Nothing };

    const std::map<std::string_view, Kind> keywords{
        {"telescope_id", Kind::Whole},  {"machine_id", Kind::Whole}, {"data_type", Kind::Whole},
        {"rawdatafile", Kind::Text},    {"source_name", Kind::Text}, {"barycentric", Kind::Whole},
        {"pulsarcentric", Kind::Whole}, {"az_start", Kind::Real},    {"za_start", Kind::Real},
        {"src_raj", Kind::Real},        {"src_dej", Kind::Real},     {"tstart", Kind::Real},
        {"tsamp", Kind::Real},          {"nbits", Kind::Whole},      {"nsamples", Kind::Whole},
        {"fch1", Kind::Real},           {"foff", Kind::Real},        {"nchans", Kind::Whole},
        {"nifs", Kind::Whole},          {"refdm", Kind::Real},       {"period", Kind::Real},
        {"nbeams", Kind::Whole},        {"ibeam", Kind::Whole},      {"signed", Kind::Byte},
        {"npuls", Kind::Whole},         {"nbins", Kind::Whole},      {"FREQUENCY_START", Kind::Nothing}};

    /// Reads a header from its beginning.
    class HeaderReader
    {
    public:
        HeaderReader(std::span<const std::byte> bytes, const std::string &path) : m_bytes(bytes), m_path(path) {}

        template <class T>
        T number()
        {
            return numberAt<T>(take(sizeof(T)));
        }

        std::string word()
        {
            const auto length = number<std::int32_t>();
            if (length < 1 || length > longestWord)
                throw Error(m_path, "its filterbank header has a keyword of " + std::to_string(length)
                                        + " characters; the length must be 1 … 255");
            return std::string(asText(take(std::size_t(length))));
        }

        Index position() const { return Index(m_at); }

    private:
        std::span<const std::byte> take(std::size_t count)
        {
            if (m_bytes.size() - m_at < count)
                throw Error(m_path, "has a filterbank header that is truncated or longer than 64 KiB");
            m_at += count;
            return m_bytes.subspan(m_at - count, count);
        }

        std::span<const std::byte> m_bytes;
        const std::string &m_path;
        std::size_t m_at = 0;
    };

    using Values = std::map<std::string, double>;

    Values readHeaderValues(HeaderReader &header, const std::string &path)
    {
        if (header.word() != headerStart)
            throw Error(path, "is not a sigproc filterbank");
        Values values;
        for (std::string word = header.word(); word != "HEADER_END"; word = header.word()) {
            const auto known = keywords.find(word);
            if (known == keywords.end())
                throw Error(path, "its filterbank header has the keyword " + oneLine(word)
                                      + ", which is unknown, as is the length of its value");
            switch (known->second) {
            case Kind::Whole:
                values[word] = header.number<std::int32_t>();
                break;
            case Kind::Real:
                values[word] = header.number<double>();
                break;
            case Kind::Byte:
                values[word] = header.number<std::uint8_t>();
                break;
            case Kind::Text:
                header.word();
                break;
            case Kind::Nothing:
                throw Error(
                    path, "lists a frequency for each channel; only evenly spaced channels (fch1, foff) are supported");
            }
        }
        return values;
    }

    double required(const Values &values, const std::string &name, const std::string &path)
    {
        const auto found = values.find(name);
        if (found == values.end())
            throw Error(path, "its filterbank header has no " + name);
        return found->second;
    }

    double within(double value, double least, double most, const std::string &name, const std::string &path)
    {
        if (!(value >= least && value <= most))
            throw Error(path + ": " + name + " = " + formatNumber(value),
                        "must lie in " + formatNumber(least) + " … " + formatNumber(most));
        return value;
    }

    double valueOr(const Values &values, const std::string &name, double otherwise)
    {
        const auto found = values.find(name);
        return found == values.end() ? otherwise : found->second;
    }

    constexpr std::array<std::pair<int, const char *>, 6> bitTypes{
        {{1, "uint1"}, {2, "uint2"}, {4, "uint4"}, {8, "uint8"}, {16, "uint16"}, {32, "float32"}}};

    std::string sampleTypeOf(int bits, const std::string &path)
    {
        for (const auto &[known, name] : bitTypes)
            if (bits == known)
                return name;
        throw Error(path + ": nbits = " + std::to_string(bits), "must be 1, 2, 4, 8, 16 or 32");
    }

    std::vector<std::byte> beginningOf(const FileBytes &file)
    {
        std::vector<std::byte> bytes(std::size_t(std::min(mostHeaderBytes, file.size())));
        bytes.resize(file.readAt(0, bytes));
        return bytes;
    }

    template <class T>
    void widen(std::span<const std::byte> bytes, std::span<float> out, double offset = 0.0)
    {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = float(numberAt<T>(bytes, i * sizeof(T))) + float(offset);
    }

    /// Unpacks values of a few bits, from one in the first byte on, the lowest bits first.
    void unpack(std::span<const std::byte> bytes, int bits, Index firstBit, std::span<float> out)
    {
        const unsigned mask = (1u << bits) - 1u;
        for (std::size_t i = 0; i < out.size(); ++i) {
            const auto bit = std::size_t(firstBit) + i * std::size_t(bits);
            out[i] = float((std::to_integer<unsigned>(bytes[bit / 8]) >> (bit % 8)) & mask);
        }
    }

    constexpr const char *filterbankName = "data";
    constexpr Index coarseChannel = Index(1) << 20; ///< channels

} // namespace

bool SigprocFile::recognises(const std::string &path)
{
    return FileBytes(path).hasAt(4, headerStart);
}

SigprocFile::SigprocFile(const std::string &path) : m_file(path)
{
    static_assert(std::endian::native == std::endian::little);
    const std::vector<std::byte> bytes = beginningOf(m_file);
    HeaderReader header(bytes, m_file.path());
    const Values values = readHeaderValues(header, path);
    m_dataOffset = header.position();

    const auto channels = Index(within(required(values, "nchans", path), 1.0, largestCount, "nchans", path));
    m_bits = int(within(required(values, "nbits", path), 1.0, 32.0, "nbits", path));
    m_isSigned = m_bits == 8 && valueOr(values, "signed", 0.0) != 0.0;
    const double ifs = within(valueOr(values, "nifs", 1.0), 1.0, 64.0, "nifs", path);

    m_info.path = path;
    m_info.container = "sigproc filterbank";
    m_info.sampleType = m_isSigned ? "int8" : sampleTypeOf(m_bits, path);
    m_info.channelCount = int(ifs);
    m_info.quantum = m_bits < 8 ? 1.0 : 0.0;
    const Index bitsOfFrame = channels * m_info.channelCount * m_bits;
    if (bitsOfFrame % 8 != 0)
        throw Error(path + ": nchans = " + std::to_string(channels),
                    "of " + std::to_string(m_bits) + " bits do not fill whole bytes");
    const Index dataBytes = m_file.size() - m_dataOffset;
    const Index frames = dataBytes / (bitsOfFrame / 8);
    if (frames < 1)
        throw Error(path, "holds no complete spectrum of its " + std::to_string(channels) + " channels");
    setAxes({required(values, "fch1", path), required(values, "foff", path), required(values, "tsamp", path),
             valueOr(values, "tstart", 0.0), channels, frames});
    if (const auto claimed = Index(valueOr(values, "nsamples", 0.0)); claimed > frames)
        m_info.notes.emplace_back("The header claims " + std::to_string(claimed) + " spectra; the "
                                  + std::to_string(frames) + " existing ones are read.");
    else if (dataBytes % (bitsOfFrame / 8) != 0)
        m_info.notes.emplace_back("The file ends within a spectrum, which is omitted.");
}

/// Reads channels of one spectrum of one IF in the file's order. Row: frame × IFs + IF.
void SigprocFile::readRow(Index row, Index firstChannel, std::span<float> out) const
{
    const Index firstBit = (row * m_info.frequency.count + firstChannel) * m_bits;
    const Index bits = std::ssize(out) * m_bits;
    std::vector<std::byte> bytes(std::size_t((firstBit % 8 + bits + 7) / 8));
    if (m_file.readAt(m_dataOffset + firstBit / 8, bytes) < bytes.size())
        throw Error(m_info.path, "was truncated while open", Error::Kind::Failure);
    switch (m_bits) {
    case 8:
        m_isSigned ? widen<std::int8_t>(bytes, out, 128.0) : widen<std::uint8_t>(bytes, out);
        break;
    case 16:
        widen<std::uint16_t>(bytes, out);
        break;
    case 32:
        widen<float>(bytes, out);
        break;
    default:
        unpack(bytes, m_bits, firstBit % 8, out);
    }
}

void SigprocFile::readStored(const PowerPart &part, Index first, std::span<float> out) const
{
    for (Index i = 0; i < part.frames; ++i)
        readRow((part.firstFrame + i) * m_info.channelCount + part.channel, first,
                out.subspan(std::size_t(i * part.cells), std::size_t(part.cells)));
}

bool Hdf5Filterbank::recognises(const std::string &path)
{
    if (!Hdf5File::recognises(path))
        return false;
    const Hdf5File file(path);
    const auto data = file.dataset(filterbankName);
    return data && data->number("fch1");
}

Hdf5Filterbank::Hdf5Filterbank(const std::string &path)
    : m_file(std::make_unique<Hdf5File>(path)), m_data(m_file->dataset(filterbankName))
{
    if (!m_data || m_data->isComplex() || m_data->shape().size() != 3)
        throw Error(path, "holds no dataset \"data\" of frames, polarisations and channels");
    const std::vector<Index> &shape = m_data->shape();
    constexpr Index mostChannels = 1 << 26;
    constexpr Index mostPolarisations = 64;
    if (shape[1] > mostPolarisations || shape[2] > mostChannels)
        throw Error(path, "has " + std::to_string(shape[1]) + " polarisations of " + std::to_string(shape[2])
                              + " channels; at most 64 polarisations of 67 million channels are supported");
    Header header;
    for (const auto &[value, name] :
         {std::pair{&header.fch1, "fch1"}, std::pair{&header.foff, "foff"}, std::pair{&header.tsamp, "tsamp"}}) {
        const auto given = m_data->number(name);
        if (!given)
            throw Error(path, "its dataset \"data\" has no numeric attribute " + std::string(name));
        *value = *given;
    }
    header.tstart = m_data->number("tstart").value_or(0.0);
    header.frames = shape[0];
    header.channels = shape[2];
    m_info.path = path;
    setAxes(header);
    m_info.container = "HDF5 filterbank";
    m_info.sampleType = m_data->typeName();
    m_info.channelCount = int(shape[1]);
}

void Hdf5Filterbank::readStored(const PowerPart &part, Index first, std::span<float> out) const
{
    m_data->read({part.firstFrame, part.channel, first}, {part.frames, 1, part.cells}, out);
}

void Filterbank::read(const PowerPart &part, std::span<float> out) const
{
    readStored(part, m_descends ? m_info.frequency.count - part.firstCell - part.cells : part.firstCell, out);
    if (m_descends)
        for (auto row = out.begin(); row != out.end(); row += part.cells)
            std::reverse(row, row + part.cells);
    excludeDc(part, out);
}

void Filterbank::setAxes(const Header &header)
{
    const std::string &path = m_info.path;
    constexpr double frequencyLimitMHz = 1e9; // MHz
    constexpr double megahertz = 1e6;
    constexpr double unixDay = 40587.0; // MJD of 1970-01-01
    constexpr double daySeconds = 86400.0;
    within(header.tsamp, 1e-12, 1e7, "tsamp", path);
    within(header.fch1, -frequencyLimitMHz, frequencyLimitMHz, "fch1", path);
    within(header.foff, -frequencyLimitMHz, frequencyLimitMHz, "foff", path);
    if (!(std::abs(header.foff) > 0.0))
        throw Error(path + ": foff = 0", "must be the channel spacing, MHz");
    m_descends = header.foff < 0.0;
    const double lowest = m_descends ? header.fch1 + double(header.channels - 1) * header.foff : header.fch1;
    m_info.frequency = {"frequency",     "Hz", lowest * megahertz, std::abs(header.foff) * megahertz,
                        header.channels, false};
    m_info.time = {"time", "s", 0.5 * header.tsamp, header.tsamp, header.frames, false};
    if (header.tstart > unixDay && header.tstart < 1e6)
        m_info.startUnixSeconds = (header.tstart - unixDay) * daySeconds;
    if (header.channels > 0 && header.channels % coarseChannel == 0)
        m_info.notes.push_back("The middle channel of each of its " + std::to_string(header.channels / coarseChannel)
                               + " coarse channels holds the receiver's DC offset and is not observed "
                                 "(noise.blankDc=false observes it).");
}

void Filterbank::excludeDc(const PowerPart &part, std::span<float> out) const
{
    const Index all = m_info.frequency.count;
    if (part.hasDc || all % coarseChannel != 0)
        return;
    for (Index middle = coarseChannel / 2; middle < all; middle += coarseChannel) {
        const Index cell = (m_descends ? all - 1 - middle : middle) - part.firstCell;
        for (Index frame = 0; cell >= 0 && cell < part.cells && frame < part.frames; ++frame)
            out[std::size_t(frame * part.cells + cell)] = std::numeric_limits<float>::quiet_NaN();
    }
}

} // namespace faintline
