#include "signal/formats/NumPy.h"

#include "base/Error.h"
#include "base/Field.h"
#include "signal/formats/gridFile.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numeric>

namespace faintline {

namespace {

    constexpr std::string_view numPyMagic("\x93NUMPY", 6);
    constexpr int arrayExponent = 31; ///< of arrays read as a whole
    constexpr int fileExponent = 50;

    std::string shapeText(const std::vector<Index> &shape)
    {
        std::string text = "(";
        for (Index n : shape)
            text += std::to_string(n) + ",";
        return text + ")";
    }

    std::string headerText(const std::vector<Index> &shape)
    {
        std::string dictionary = "{'descr': '<f4', 'fortran_order': False, 'shape': " + shapeText(shape) + ", }";
        while ((numPyMagic.size() + 4 + dictionary.size() + 1) % 64 != 0)
            dictionary += ' ';
        dictionary += '\n';
        std::string text(numPyMagic);
        text += '\x01';
        text += '\x00';
        text += static_cast<char>(dictionary.size() & 0xff);
        text += static_cast<char>(dictionary.size() >> 8);
        return text + dictionary;
    }

    /// The text after "'key':" in the header's dictionary.
    std::string_view entry(std::string_view dictionary, std::string_view key, const std::string &path)
    {
        const std::size_t at = dictionary.find('\'' + std::string(key) + '\'');
        const std::size_t colon = at == std::string_view::npos ? at : dictionary.find(':', at);
        if (colon == std::string_view::npos)
            throw Error(path, "its NumPy header has no '" + std::string(key) + "'");
        std::string_view rest = dictionary.substr(colon + 1);
        while (rest.starts_with(' '))
            rest.remove_prefix(1);
        return rest;
    }

    /// Parses a shape whose partial products are at most 2^mostExponent.
    std::vector<Index> parseShape(std::string_view text, int mostExponent, const std::string &path)
    {
        if (!text.starts_with('('))
            throw Error(path, "its NumPy header has no shape");
        text = text.substr(1, text.find(')') - 1);
        std::vector<Index> shape;
        double values = 1.0;
        while (!text.empty()) {
            const std::size_t comma = text.find(',');
            std::string_view word = text.substr(0, comma);
            while (word.starts_with(' '))
                word.remove_prefix(1);
            while (word.ends_with(' '))
                word.remove_suffix(1);
            if (!word.empty()) {
                const auto number = parseNumber(word);
                if (!number || *number < 0.0 || *number != std::floor(*number) || *number > 0x1p40)
                    throw Error(path, "its NumPy shape holds '" + std::string(word) + "'");
                shape.push_back(Index(*number));
                values *= *number;
                if (values > std::ldexp(1.0, mostExponent))
                    throw Error(path, "holds more than " + std::string(mostExponent == arrayExponent ? "2³¹" : "2⁵⁰")
                                          + " values");
            }
            text = comma == std::string_view::npos ? std::string_view() : text.substr(comma + 1);
        }
        return shape;
    }

    Error cutShort(const NumPyHeader &header, const std::string &path)
    {
        return Error(path, "is truncated: its shape " + shapeText(header.shape) + " requires "
                               + std::to_string(valueCount(header.shape)) + " values");
    }

    /// The header's dictionary; the values follow it in the file.
    std::string readDictionary(std::ifstream &file, const std::string &path)
    {
        if (!file)
            throw Error(path, "cannot be opened; expected a NumPy file (.npy)");
        char start[10] = {};
        if (!file.read(start, 10) || std::string_view(start, 6) != numPyMagic)
            throw Error(path, "is not a NumPy file (.npy)");
        std::size_t length = static_cast<unsigned char>(start[8]) + 256u * static_cast<unsigned char>(start[9]);
        if (start[6] >= 2) {
            unsigned char more[2] = {};
            file.read(reinterpret_cast<char *>(more), 2);
            length += (std::size_t(more[0]) << 16) + (std::size_t(more[1]) << 24);
        }
        if (length > (1u << 20))
            throw Error(path, "its NumPy header is too long");
        std::string dictionary(length, ' ');
        if (!file.read(dictionary.data(), static_cast<std::streamsize>(length)))
            throw Error(path, "is truncated within its NumPy header");
        if (entry(dictionary, "fortran_order", path).starts_with("True"))
            throw Error(path, "is in Fortran order; save it in C order (numpy.ascontiguousarray)");
        return dictionary;
    }

    NumPyHeader readHeader(std::ifstream &file, int mostExponent, const std::string &path)
    {
        const std::string dictionary = readDictionary(file, path);
        const std::string_view type = entry(dictionary, "descr", path);
        const std::size_t end = type.starts_with('\'') ? type.find('\'', 1) : std::string_view::npos;
        if (end == std::string_view::npos)
            throw Error(path, "holds records; expected numbers");
        return {parseShape(entry(dictionary, "shape", path), mostExponent, path), Index(file.tellg()),
                std::string(type.substr(1, end - 1))};
    }

    /// Of an array of floats that is as long as its shape requires; it may be larger than memory.
    NumPyHeader readFloatHeader(std::ifstream &file, int mostExponent, const std::string &path)
    {
        const NumPyHeader header = readHeader(file, mostExponent, path);
        if (header.descriptor != "<f4" && !header.isDouble())
            throw Error(path, "holds '" + header.descriptor + "'; expected float32 or float64, little-endian");
        std::error_code code;
        const std::uintmax_t size = std::filesystem::file_size(path, code);
        const auto wanted = static_cast<std::uintmax_t>(valueCount(header.shape))
                            * (header.isDouble() ? sizeof(double) : sizeof(float));
        if (!code && size - std::uintmax_t(header.offset) < wanted) // before memory is allocated for missing values
            throw cutShort(header, path);
        return header;
    }

    NumPyHeader readFloatHeader(const std::string &path)
    {
        std::ifstream file(path, std::ios::binary);
        return readFloatHeader(file, fileExponent, path);
    }

    template <class Stored, class T>
    void readValues(std::ifstream &file, std::vector<T> &values, const NumPyHeader &header, const std::string &path)
    {
        std::vector<Stored> chunk(1 << 16);
        for (std::size_t done = 0; done < values.size();) {
            const std::size_t count = std::min(chunk.size(), values.size() - done);
            const auto bytes = static_cast<std::streamsize>(count * sizeof(Stored));
            if (!file.read(reinterpret_cast<char *>(chunk.data()), bytes))
                throw cutShort(header, path);
            for (std::size_t i = 0; i < count; ++i)
                values[done + i] = static_cast<T>(chunk[i]);
            done += count;
        }
    }

    template <class T>
    NumPyValues<T> readArray(const std::string &path)
    {
        std::ifstream file(path, std::ios::binary);
        const NumPyHeader header = readFloatHeader(file, arrayExponent, path);
        NumPyValues<T> array{header.shape, std::vector<T>(std::size_t(valueCount(header.shape)))};
        if (header.isDouble())
            readValues<double>(file, array.values, header, path);
        else
            readValues<float>(file, array.values, header, path);
        return array;
    }

} // namespace

Index valueCount(const std::vector<Index> &shape)
{
    return std::accumulate(shape.begin(), shape.end(), Index(1), std::multiplies<>());
}

NumPyHeader readNumPyHeader(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    return readHeader(file, fileExponent, path);
}

NumPyArray readNumPy(const std::string &path)
{
    return readArray<float>(path);
}

NumPyDoubles readNumPyDoubles(const std::string &path)
{
    return readArray<double>(path);
}

NumPyWriter::NumPyWriter(const std::string &path, const std::vector<Index> &shape) : m_file(path), m_path(path)
{
    static_assert(std::endian::native == std::endian::little);
    for (Index n : shape)
        m_expected *= n;
    m_file.write(headerText(shape));
}

void NumPyWriter::write(std::span<const float> values)
{
    m_file.write(std::as_bytes(values));
    m_written += std::ssize(values);
}

void NumPyWriter::finish()
{
    if (m_written != m_expected)
        throw Error(m_path, std::to_string(m_written) + " of " + std::to_string(m_expected) + " values were written",
                    Error::Kind::Failure);
    m_file.commit();
}

bool NumPyPower::recognises(const std::string &path, const std::string &gridPath)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(gridPath, ignored))
        return false;
    try {
        const GridFile file = readGridFile(gridPath, readFloatHeader(path).shape);
        return file.isPower && file.grid.isSpectrum();
    } catch (const Error &) {
        return false;
    }
}

NumPyPower::NumPyPower(const std::string &path, const std::string &gridPath)
    : m_file(path), m_header(readFloatHeader(path))
{
    const GridFile grid = readGridFile(gridPath, m_header.shape);
    if (!grid.grid.isSpectrum())
        throw Error(path,
                    "holds power on " + grid.grid.axisCountWords() + "; only (frames, frequencies) can be normalised");
    m_info.path = path;
    m_info.container = "NumPy spectrogram";
    m_info.sampleType = m_header.isDouble() ? "float64" : "float32";
    m_info.time = grid.time;
    m_info.frequency = grid.grid.axes.front();
    if (m_info.time.count < 1 || m_info.frequency.count < 1)
        throw Error(path, "holds no values");
}

void NumPyPower::read(const PowerPart &part, std::span<float> out) const
{
    const Index valueBytes = m_header.isDouble() ? sizeof(double) : sizeof(float);
    std::vector<double> doubles(m_header.isDouble() ? std::size_t(part.cells) : 0);
    for (Index i = 0; i < part.frames; ++i) {
        const std::span<float> row = out.subspan(std::size_t(i * part.cells), std::size_t(part.cells));
        const std::span<std::byte> bytes =
            m_header.isDouble() ? std::as_writable_bytes(std::span(doubles)) : std::as_writable_bytes(row);
        const Index at =
            m_header.offset + ((part.firstFrame + i) * m_info.frequency.count + part.firstCell) * valueBytes;
        if (m_file.readAt(at, bytes) < bytes.size())
            throw Error(m_info.path, "was truncated while open", Error::Kind::Failure);
        for (std::size_t cell = 0; cell < doubles.size(); ++cell)
            row[cell] = float(doubles[cell]);
    }
}

} // namespace faintline
