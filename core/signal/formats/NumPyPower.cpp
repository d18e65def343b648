#include "signal/formats/NumPyPower.h"

#include "base/Error.h"
#include "signal/formats/gridFile.h"

#include <filesystem>

namespace faintline {

bool NumPyPower::recognises(const std::string &path, const std::string &gridPath)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(gridPath, ignored))
        return false;
    try {
        const GridFile file = readGridFile(gridPath, readNumPyLayout(path).shape);
        return file.isPower && file.grid.isSpectrum();
    } catch (const Error &) {
        return false;
    }
}

NumPyPower::NumPyPower(const std::string &path, const std::string &gridPath)
    : m_file(path), m_layout(readNumPyLayout(path))
{
    const GridFile grid = readGridFile(gridPath, m_layout.shape);
    if (!grid.grid.isSpectrum())
        throw Error(path,
                    "holds power on " + grid.grid.axisCountWords() + "; only (frames, frequencies) can be normalised");
    m_info.path = path;
    m_info.container = "NumPy spectrogram";
    m_info.sampleType = m_layout.isDouble ? "float64" : "float32";
    m_info.time = grid.time;
    m_info.frequency = grid.grid.axes.front();
    if (m_info.time.count < 1 || m_info.frequency.count < 1)
        throw Error(path, "holds no values");
}

void NumPyPower::read(const PowerPart &part, std::span<float> out) const
{
    const Index valueBytes = m_layout.isDouble ? sizeof(double) : sizeof(float);
    std::vector<double> doubles(m_layout.isDouble ? std::size_t(part.cells) : 0);
    for (Index i = 0; i < part.frames; ++i) {
        const std::span<float> row = out.subspan(std::size_t(i * part.cells), std::size_t(part.cells));
        const std::span<std::byte> bytes =
            m_layout.isDouble ? std::as_writable_bytes(std::span(doubles)) : std::as_writable_bytes(row);
        const Index at =
            m_layout.offset + ((part.firstFrame + i) * m_info.frequency.count + part.firstCell) * valueBytes;
        if (m_file.readAt(at, bytes) < bytes.size())
            throw Error(m_info.path, "was truncated while open", Error::Kind::Failure);
        for (std::size_t cell = 0; cell < doubles.size(); ++cell)
            row[cell] = float(doubles[cell]);
    }
}

} // namespace faintline
