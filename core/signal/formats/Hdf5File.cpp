#include "signal/formats/Hdf5File.h"

#include "base/Error.h"
#include "base/oneLine.h"
#include "signal/FileBytes.h"
#include "signal/formats/Hdf5Driver.h"
#include "signal/formats/bitshuffle.h"

#include <H5PLpublic.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <mutex>
#include <utility>

namespace faintline {

namespace {

    constexpr std::size_t largestChunk = std::size_t(64) << 20;
    constexpr std::size_t cacheBytes = std::size_t(128) << 20; // a chunk that does not fit is unpacked at each read
    constexpr std::size_t cacheSlots = 1009;
    constexpr H5Z_filter_t bitshuffle = 32008;
    constexpr unsigned bitshuffleLz4 = 2;

    /// A handle that is closed by its destructor.
    class Handle
    {
    public:
        Handle(hid_t id, herr_t (*close)(hid_t)) : m_id(id), m_close(close) {}
        ~Handle()
        {
            if (m_id >= 0)
                m_close(m_id);
        }
        Handle(const Handle &) = delete;
        Handle &operator=(const Handle &) = delete;
        operator hid_t() const { return m_id; }
        hid_t release() { return std::exchange(m_id, -1); }

    private:
        hid_t m_id;
        herr_t (*m_close)(hid_t);
    };

    /// Bitshuffle as a filter of the library, for reading.
    std::size_t decodeBitshuffle(unsigned flags, std::size_t count, const unsigned values[], std::size_t bytes,
                                 std::size_t *room, void **buffer)
    {
        constexpr std::size_t elementAt = 2;
        if (!(flags & H5Z_FLAG_REVERSE) || count <= elementAt)
            return 0;
        const BitshuffleLayout layout{values[elementAt], count > 3 ? values[3] : 0,
                                      count > 4 && values[4] == bitshuffleLz4};
        if (count > 4 && values[4] != 0 && values[4] != bitshuffleLz4)
            return 0;
        const std::vector<std::byte> decoded =
            undoBitshuffle({static_cast<const std::byte *>(*buffer), bytes}, layout, largestChunk);
        if (decoded.empty())
            return 0;
        void *own = H5allocate_memory(decoded.size(), false);
        if (!own)
            return 0;
        std::memcpy(own, decoded.data(), decoded.size());
        H5free_memory(*buffer);
        *buffer = own;
        *room = decoded.size();
        return decoded.size();
    }

    /// Scope of library use: one thread, no plug-ins, and no printed messages, because Error reports failures once.
    /// Restores the state for other users in the process, such as h5py.
    class LibraryUse
    {
    public:
        LibraryUse() : m_lock(guard())
        {
            static const bool isPrepared = isShared() || H5dont_atexit() >= 0;
            (void)isPrepared;
            H5open();
            H5PLget_loading_state(&m_plugins);
            H5PLset_loading_state(0);
            H5Eget_auto2(H5E_DEFAULT, &m_report, &m_reportData);
            H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
            if (H5Zfilter_avail(bitshuffle) <= 0) {
                const H5Z_class2_t filter{H5Z_CLASS_T_VERS, bitshuffle, 0,       1,
                                          "bitshuffle",     nullptr,    nullptr, &decodeBitshuffle};
                H5Zregister(&filter);
            }
        }
        ~LibraryUse()
        {
            H5Eclear2(H5E_DEFAULT);
            H5Eset_auto2(H5E_DEFAULT, m_report, m_reportData);
            H5PLset_loading_state(m_plugins);
        }
        LibraryUse(const LibraryUse &) = delete;
        LibraryUse &operator=(const LibraryUse &) = delete;

        static bool &isShared()
        {
            static bool shared = false;
            return shared;
        }

    private:
        static std::mutex &guard()
        {
            static std::mutex lock;
            return lock;
        }

        std::lock_guard<std::mutex> m_lock;
        unsigned m_plugins = 0;
        H5E_auto2_t m_report = nullptr;
        void *m_reportData = nullptr;
    };

    void checkFilters(hid_t plan, const std::string &where)
    {
        for (int i = 0; i < H5Pget_nfilters(plan); ++i) {
            std::array<char, 64> name{};
            unsigned flags = 0;
            std::size_t none = 0;
            const H5Z_filter_t filter =
                H5Pget_filter2(plan, unsigned(i), &flags, &none, nullptr, name.size() - 1, name.data(), nullptr);
            if (filter < 0 || H5Zfilter_avail(filter) <= 0)
                throw Error(where,
                            "is compressed by filter " + std::to_string(filter) + " (" + oneLine(name.data())
                                + "); only deflate, szip, shuffle, bitshuffle and bitshuffle with LZ4 are supported");
        }
    }

    /// Chunk sizes of a dataset; empty if it is not chunked.
    std::vector<Index> checkStorage(hid_t dataset, std::size_t elementBytes, const std::string &where)
    {
        std::vector<Index> chunk;
        const Handle plan(H5Dget_create_plist(dataset), H5Pclose);
        if (H5Pget_external_count(plan) != 0)
            throw Error(where, "stores its values in other files, which are not read");
        switch (H5Pget_layout(plan)) {
        case H5D_CHUNKED: {
            std::array<hsize_t, H5S_MAX_RANK> sizes{};
            const int axes = H5Pget_chunk(plan, H5S_MAX_RANK, sizes.data());
            double bytes = double(elementBytes);
            for (int axis = 0; axis < axes; ++axis)
                bytes *= double(sizes[std::size_t(axis)]);
            if (axes < 1 || bytes > double(largestChunk))
                throw Error(where, "has chunks of more than 64 MiB, which would have to be held in memory; repack it "
                                   "(h5repack)");
            chunk.assign(sizes.begin(), sizes.begin() + axes);
            break;
        }
        case H5D_COMPACT:
        case H5D_CONTIGUOUS:
            break;
        default:
            throw Error(where, "is a virtual dataset of other datasets or files, which are not read");
        }
        checkFilters(plan, where);
        return chunk;
    }

    /// Lengths may be false: unwritten parts are not in the file, and no filter compresses numbers better than this.
    void checkLength(hid_t dataset, std::span<const hsize_t> sizes, std::size_t elementBytes, const std::string &where)
    {
        constexpr double bestPacking = 4096.0;
        constexpr double fewBytes = 1 << 20;
        double claimed = double(elementBytes);
        for (const hsize_t size : sizes)
            claimed *= double(size);
        if (claimed > bestPacking * std::max(fewBytes, double(H5Dget_storage_size(dataset))))
            throw Error(where, "claims " + std::to_string(std::llround(claimed / fewBytes))
                                   + " MiB of values, but the file holds almost none of them");
    }

    bool isNumber(hid_t type)
    {
        const H5T_class_t kind = H5Tget_class(type);
        return (kind == H5T_FLOAT || kind == H5T_INTEGER) && H5Tget_size(type) <= sizeof(double);
    }

    /// The type of a dataset's numbers: its own, or that of both parts of pairs "r" and "i". Throws Error for others.
    hid_t numberType(hid_t type, const std::string &where)
    {
        if (isNumber(type))
            return H5Tcopy(type);
        if (H5Tget_class(type) == H5T_COMPOUND && H5Tget_nmembers(type) == 2 && H5Tget_member_index(type, "r") == 0
            && H5Tget_member_index(type, "i") == 1) {
            Handle real(H5Tget_member_type(type, 0), H5Tclose);
            const Handle imaginary(H5Tget_member_type(type, 1), H5Tclose);
            const auto end = std::max(H5Tget_member_offset(type, 0), H5Tget_member_offset(type, 1)) + H5Tget_size(real);
            if (isNumber(real) && H5Tequal(real, imaginary) > 0 && end <= H5Tget_size(type)) // else it is read beyond
                return real.release();
        }
        throw Error(where, "does not hold numbers of at most 64 bits");
    }

    /// The memory type of a value: a float, or two of them.
    hid_t floatType(bool isComplex)
    {
        if (!isComplex)
            return H5Tcopy(H5T_NATIVE_FLOAT);
        const hid_t pair = H5Tcreate(H5T_COMPOUND, 2 * sizeof(float));
        H5Tinsert(pair, "r", 0, H5T_NATIVE_FLOAT);
        H5Tinsert(pair, "i", sizeof(float), H5T_NATIVE_FLOAT);
        return pair;
    }

    /// Whether a name leads to an object within the file.
    bool follows(hid_t file, const std::string &name, const std::string &path)
    {
        H5L_info_t info;
        if (H5Lexists(file, name.c_str(), H5P_DEFAULT) <= 0 || H5Lget_info(file, name.c_str(), &info, H5P_DEFAULT) < 0)
            return false;
        if (info.type != H5L_TYPE_HARD)
            throw Error(path + ": " + name, "is a soft or external link, which is not followed");
        return true;
    }

    /// An attribute with a single value; null handles if it is missing. Call with the lock held.
    struct Attribute {
        Handle handle;
        Handle type;

        Attribute(hid_t object, const std::string &name)
            : handle(H5Aexists(object, name.c_str()) > 0 ? H5Aopen(object, name.c_str(), H5P_DEFAULT) : -1, H5Aclose),
              type(handle >= 0 ? H5Aget_type(handle) : -1, H5Tclose)
        {
        }

        bool isOne() const
        {
            if (handle < 0 || type < 0)
                return false;
            const Handle space(H5Aget_space(handle), H5Sclose);
            return H5Sget_simple_extent_npoints(space) == 1;
        }
    };

} // namespace

void Hdf5File::shareLibrary()
{
    LibraryUse::isShared() = true;
}

bool Hdf5File::recognises(const std::string &path)
{
    return FileBytes(path).hasAt(0, "\x89HDF\r\n\x1a\n");
}

Hdf5File::Hdf5File(const std::string &path) : m_path(path)
{
    const FileBytes check(path); // reports an invalid name
    const LibraryUse use;
    const Handle driver(registerHdf5Driver(), H5FDunregister);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    if (H5Pset_driver(access, driver, nullptr) < 0)
        throw Error(path, "cannot be opened: the HDF5 library rejects the driver", Error::Kind::Failure);
    m_handle = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
    if (m_handle < 0)
        throw Error(path, "is not an HDF5 file, or is damaged or truncated");
}

Hdf5File::~Hdf5File()
{
    const LibraryUse use;
    H5Fclose(m_handle);
}

std::unique_ptr<Hdf5Dataset> Hdf5File::dataset(const std::string &name) const
{
    const LibraryUse use;
    for (std::size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1))
        if (!follows(m_handle, name.substr(0, slash), m_path))
            return nullptr;
    if (!follows(m_handle, name, m_path))
        return nullptr;
    const std::string where = m_path + ": " + name;
    const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    H5Pset_chunk_cache(access, cacheSlots, cacheBytes, 1.0);
    Handle handle(H5Dopen2(m_handle, name.c_str(), access), H5Dclose);
    if (handle < 0)
        throw Error(where, "is not a dataset, or is damaged");
    const Handle type(H5Dget_type(handle), H5Tclose);
    const Handle number(numberType(type, where), H5Tclose);
    const H5T_class_t kind = H5Tget_class(number);
    const Handle space(H5Dget_space(handle), H5Sclose);
    std::array<hsize_t, H5S_MAX_RANK> sizes{};
    const int axes = H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
    constexpr hsize_t mostValues = hsize_t(1) << 50;
    if (axes < 1
        || std::any_of(sizes.begin(), sizes.begin() + axes, [](hsize_t size) { return size < 1 || size > mostValues; }))
        throw Error(where, "holds no values, or claims too many");
    std::vector<Index> chunk = checkStorage(handle, H5Tget_size(type), where);
    if (!chunk.empty() && (std::ssize(chunk) != axes || std::find(chunk.begin(), chunk.end(), 0) != chunk.end()))
        throw Error(where, "is damaged: its chunks have an invalid shape");
    checkLength(handle, std::span(sizes).first(std::size_t(axes)), H5Tget_size(type), where);

    std::unique_ptr<Hdf5Dataset> dataset(new Hdf5Dataset(m_path, handle.release()));
    dataset->m_shape.assign(sizes.begin(), sizes.begin() + axes);
    dataset->m_chunk = std::move(chunk);
    dataset->m_isComplex = H5Tget_class(type) == H5T_COMPOUND;
    dataset->m_isFloat = kind == H5T_FLOAT;
    dataset->m_isSigned = kind == H5T_FLOAT || H5Tget_sign(number) == H5T_SGN_2;
    dataset->m_bits = 8 * int(H5Tget_size(number));
    return dataset;
}

Hdf5Dataset::Hdf5Dataset(std::string path, std::int64_t handle) : m_path(std::move(path)), m_handle(handle) {}

Hdf5Dataset::~Hdf5Dataset()
{
    const LibraryUse use;
    H5Dclose(m_handle);
}

std::optional<double> Hdf5Dataset::number(const std::string &name) const
{
    const LibraryUse use;
    const Attribute attribute(m_handle, name);
    double value = 0.0;
    if (!attribute.isOne() || (H5Tget_class(attribute.type) != H5T_FLOAT && H5Tget_class(attribute.type) != H5T_INTEGER)
        || H5Aread(attribute.handle, H5T_NATIVE_DOUBLE, &value) < 0)
        return std::nullopt;
    return value;
}

std::optional<std::string> Hdf5Dataset::text(const std::string &name) const
{
    const LibraryUse use;
    const Attribute attribute(m_handle, name);
    constexpr std::size_t textLimitBytes = 4096;
    if (!attribute.isOne() || H5Tget_class(attribute.type) != H5T_STRING || H5Tis_variable_str(attribute.type) != 0
        || H5Tget_size(attribute.type) > textLimitBytes)
        return std::nullopt;
    std::string value(H5Tget_size(attribute.type), '\0');
    if (H5Aread(attribute.handle, attribute.type, value.data()) < 0)
        return std::nullopt;
    return std::string(value.c_str());
}

/// If a small part lies in more chunks than the cache holds, every read would unpack all of them again.
void Hdf5Dataset::checkChunks(const std::vector<Index> &first, const std::vector<Index> &count) const
{
    constexpr double mostUnpacked = 16.0; // relative to the part that is read
    double wanted = (m_isComplex ? 0.25 : 0.125) * m_bits;
    double unpacked = wanted;
    for (std::size_t axis = 0; axis < m_chunk.size(); ++axis) {
        const Index chunks = (first[axis] + count[axis] - 1) / m_chunk[axis] - first[axis] / m_chunk[axis] + 1;
        wanted *= double(count[axis]);
        unpacked *= double(chunks) * double(m_chunk[axis]);
    }
    if (unpacked > double(cacheBytes) && unpacked > mostUnpacked * wanted)
        throw Error(m_path, "has chunks of which " + std::to_string(std::llround(unpacked / 0x1p20))
                                + " MiB must be unpacked for every " + std::to_string(std::llround(wanted))
                                + " bytes; choose a narrower band, or repack it (h5repack)");
}

void Hdf5Dataset::read(const std::vector<Index> &first, const std::vector<Index> &count, std::span<float> out) const
{
    checkChunks(first, count);
    const LibraryUse use;
    const std::vector<hsize_t> from(first.begin(), first.end());
    const std::vector<hsize_t> size(count.begin(), count.end());
    const Handle file(H5Dget_space(m_handle), H5Sclose);
    const Handle memory(H5Screate_simple(int(size.size()), size.data(), nullptr), H5Sclose);
    const Handle type(floatType(m_isComplex), H5Tclose);
    if (H5Sselect_hyperslab(file, H5S_SELECT_SET, from.data(), nullptr, size.data(), nullptr) < 0
        || H5Dread(m_handle, type, memory, file, H5P_DEFAULT, out.data()) < 0)
        throw Error(m_path, "is damaged in the part read, or was truncated while open", Error::Kind::Failure);
}

std::vector<std::int64_t> Hdf5Dataset::readIntegers() const
{
    constexpr double tableLimitRows = 1 << 20;
    double count = 1.0;
    for (const Index size : m_shape)
        count *= double(size);
    if (m_isFloat || m_isComplex || count > tableLimitRows)
        throw Error(m_path, "must hold a table of at most a million whole numbers");
    const LibraryUse use;
    std::vector<std::int64_t> values(static_cast<std::size_t>(count));
    if (H5Dread(m_handle, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        throw Error(m_path, "is damaged in the part read, or was truncated while open", Error::Kind::Failure);
    return values;
}

} // namespace faintline
