#include "signal/formats/Hdf5Pings.h"

#include "base/Error.h"
#include "signal/formats/gridFile.h"

#include <functional>
#include <numeric>
#include <vector>

namespace faintline {

namespace {

    constexpr const char *pingsName = "pings";

    std::string typeName(const Hdf5Dataset &data)
    {
        if (data.isComplex())
            return "complex" + std::to_string(2 * data.bits());
        return (data.isFloat() ? "float" : data.isSigned() ? "int" : "uint") + std::to_string(data.bits());
    }

} // namespace

bool Hdf5Pings::recognises(const std::string &path)
{
    return Hdf5File::recognises(path) && Hdf5File(path).dataset(pingsName);
}

Hdf5Pings::Hdf5Pings(const std::string &path, const std::string &gridPath)
    : m_file(std::make_unique<Hdf5File>(path)), m_data(m_file->dataset(pingsName))
{
    if (!m_data || m_data->shape().size() < 3)
        throw Error(path, "holds no dataset \"pings\" of shape (pings, range cells, beams…)");
    const std::vector<Index> &shape = m_data->shape();
    if (std::accumulate(shape.begin(), shape.end(), Index(1), std::multiplies<>()) < 1)
        throw Error(path, "holds no values");
    const GridFile grid = gridPath.empty() ? plainGrid(shape) : readGridFile(gridPath, shape);
    if (grid.isIq && m_data->isComplex())
        throw Error(gridPath + ": values", "\"iq\" is for pairs of real numbers; these are complex already");
    m_info.path = path;
    m_info.container = "HDF5 pings";
    m_info.sampleType = typeName(*m_data);
    m_info.time = grid.time;
    m_info.grid = grid.grid;
    m_info.isComplex = m_data->isComplex() || grid.isIq;
    m_info.quantum = m_data->isFloat() ? 0.0 : grid.scale;
    m_info.stated = grid.values;
    m_scale = grid.scale;
    m_offset = grid.offset;
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
