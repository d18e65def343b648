#include "signal/formats/Hdf5Filterbank.h"

#include "base/Error.h"
#include "signal/formats/filterbankAxes.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr const char *filterbankName = "data";

} // namespace

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
    FilterbankHeader header;
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
    setFilterbankAxes(m_info, header, path);
    m_descends = header.foff < 0.0;
    m_info.path = path;
    m_info.container = "HDF5 filterbank";
    m_info.sampleType = m_data->typeName();
    m_info.channelCount = int(shape[1]);
}

void Hdf5Filterbank::read(const PowerPart &part, std::span<float> out) const
{
    const Index first = m_descends ? m_info.frequency.count - part.firstCell - part.cells : part.firstCell;
    m_data->read({part.firstFrame, part.channel, first}, {part.frames, 1, part.cells}, out);
    if (m_descends)
        for (auto row = out.begin(); row != out.end(); row += part.cells)
            std::reverse(row, row + part.cells);
    excludeDc(m_info, part, m_descends, out);
}

} // namespace faintline
