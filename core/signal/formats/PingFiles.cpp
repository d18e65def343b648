#include "signal/formats/PingFiles.h"

#include "base/Error.h"
#include "signal/formats/bytes.h"
#include "signal/formats/gridFile.h"

#include <array>
#include <cstdint>
#include <vector>

namespace faintline {

namespace {

    constexpr const char *pingsName = "pings";

    template <class T>
    void toDoubles(std::span<const std::byte> bytes, std::span<double> out)
    {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = double(numberAt<T>(bytes, i * sizeof(T)));
    }

    struct NumberType {
        std::string_view descriptor; ///< NumPy's
        std::string_view name;
        Index bytes; ///< of a real number
        void (*convert)(std::span<const std::byte>, std::span<double>);
        bool isInteger = false;
        bool isComplex = false;
    };

    constexpr std::array<NumberType, 10> types{{{"|i1", "int8", 1, &toDoubles<std::int8_t>, true},
                                                {"|u1", "uint8", 1, &toDoubles<std::uint8_t>, true},
                                                {"<i2", "int16", 2, &toDoubles<std::int16_t>, true},
                                                {"<u2", "uint16", 2, &toDoubles<std::uint16_t>, true},
                                                {"<i4", "int32", 4, &toDoubles<std::int32_t>, true},
                                                {"<u4", "uint32", 4, &toDoubles<std::uint32_t>, true},
                                                {"<f4", "float32", 4, &toDoubles<float>},
                                                {"<f8", "float64", 8, &toDoubles<double>},
                                                {"<c8", "complex64", 4, &toDoubles<float>, false, true},
                                                {"<c16", "complex128", 8, &toDoubles<double>, false, true}}};

    const NumberType &typeOf(const NumPyHeader &header, const std::string &path)
    {
        for (const NumberType &type : types)
            if (type.descriptor == header.descriptor)
                return type;
        throw Error(path, "holds '" + header.descriptor
                              + "'; expected integers of 8, 16 or 32 bits, float32, float64, complex64 or complex128, "
                                "little-endian");
    }

} // namespace

void PingFile::describe(const std::string &path, const std::string &gridPath, const std::vector<Index> &shape,
                        bool isComplex, bool isInteger)
{
    if (valueCount(shape) < 1)
        throw Error(path, "holds no values");
    const GridFile grid = gridPath.empty() ? plainGrid(shape) : readGridFile(gridPath, shape);
    if (grid.isIq && isComplex)
        throw Error(gridPath + ": values", "\"iq\" is for pairs of real numbers; these are complex already");
    m_info.path = path;
    m_info.time = grid.time;
    m_info.grid = grid.grid;
    m_info.isComplex = isComplex || grid.isIq;
    m_info.quantum = isInteger ? grid.scale : 0.0;
    m_info.stated = grid.values;
    m_scale = grid.scale;
    m_offset = grid.offset;
}

NumPyPings::NumPyPings(const std::string &path, const std::string &gridPath)
    : m_file(path), m_header(readNumPyHeader(path))
{
    const NumberType &type = typeOf(m_header, path);
    if (m_header.shape.size() < 2)
        throw Error(path, "must have the shape (pings, cells…)");
    describe(path, gridPath, m_header.shape, type.isComplex, type.isInteger);
    const Index values = valueCount(m_header.shape);
    if (m_file.size() - m_header.offset < values * type.bytes * (type.isComplex ? 2 : 1))
        throw Error(path, "is truncated: its shape requires " + std::to_string(values) + " values");
    m_info.container = "NumPy pings";
    m_info.sampleType = type.name;
}

void NumPyPings::read(Index first, Index count, std::span<double> out) const
{
    const NumberType &type = typeOf(m_header, m_info.path);
    const Index perPing = cells() * (m_info.isComplex ? 2 : 1);
    std::vector<std::byte> bytes(std::size_t(count * perPing * type.bytes));
    if (m_file.readAt(m_header.offset + first * perPing * type.bytes, bytes) < bytes.size())
        throw Error(m_info.path, "was truncated while open", Error::Kind::Failure);
    type.convert(bytes, out);
    if (m_scale != 1.0 || m_offset != 0.0)
        for (double &value : out)
            value = m_scale * value + m_offset;
}

bool Hdf5Pings::recognises(const std::string &path)
{
    return Hdf5File::recognises(path) && Hdf5File(path).dataset(pingsName);
}

Hdf5Pings::Hdf5Pings(const std::string &path, const std::string &gridPath)
    : m_file(std::make_unique<Hdf5File>(path)), m_data(m_file->dataset(pingsName))
{
    if (!m_data || m_data->shape().size() < 3)
        throw Error(path, "holds no dataset \"pings\" of shape (pings, range cells, beams…)");
    describe(path, gridPath, m_data->shape(), m_data->isComplex(), !m_data->isFloat());
    m_info.container = "HDF5 pings";
    m_info.sampleType = m_data->isComplex() ? "complex" + std::to_string(2 * m_data->bits()) : m_data->typeName();
}

void Hdf5Pings::read(Index first, Index count, std::span<double> out) const
{
    std::vector<Index> from(m_data->shape().size(), 0);
    std::vector<Index> size = m_data->shape();
    from.front() = first;
    size.front() = count;
    std::vector<float> values(out.size());
    m_data->read(from, size, values);
    for (std::size_t i = 0; i < values.size(); ++i)
        out[i] = m_scale * double(values[i]) + m_offset;
}

} // namespace faintline
