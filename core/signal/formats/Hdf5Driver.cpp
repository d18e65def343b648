#include "signal/formats/Hdf5Driver.h"

#include "base/Error.h"
#include "signal/FileBytes.h"

#include <H5FDpublic.h>
#include <hdf5.h>
#if __has_include(<H5FDdevelop.h>)
#include <H5FDdevelop.h>
#endif

#include <memory>
#include <span>

namespace faintline {

namespace {

    constexpr haddr_t addressLimitBytes = ~haddr_t(0) >> 1;

    /// The library's part must come first.
    struct OpenFile {
        H5FD_t library{};
        std::unique_ptr<const FileBytes> bytes;
        haddr_t end = 0; ///< size that the file claims

        static OpenFile &of(H5FD_t *file) { return *reinterpret_cast<OpenFile *>(file); }
        static const OpenFile &of(const H5FD_t *file) { return *reinterpret_cast<const OpenFile *>(file); }
        haddr_t size() const { return static_cast<haddr_t>(bytes->size()); }
    };

    // No exception may pass through C.
    H5FD_t *open(const char *path, unsigned flags, hid_t, haddr_t)
    {
        if (flags & H5F_ACC_RDWR)
            return nullptr;
        try {
            auto file = std::make_unique<OpenFile>();
            file->bytes = std::make_unique<const FileBytes>(path);
            return &file.release()->library;
        } catch (const std::exception &) {
            return nullptr;
        }
    }

    herr_t close(H5FD_t *file)
    {
        delete &OpenFile::of(file);
        return 0;
    }

    herr_t query(const H5FD_t *, unsigned long *flags)
    {
        *flags = H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_IGNORE_DRVRINFO;
        return 0;
    }

    haddr_t endOf(const H5FD_t *file, H5FD_mem_t)
    {
        return OpenFile::of(file).end;
    }

    herr_t setEnd(H5FD_t *file, H5FD_mem_t, haddr_t end)
    {
        OpenFile::of(file).end = end;
        return 0;
    }

    haddr_t sizeOf(const H5FD_t *file, H5FD_mem_t)
    {
        return OpenFile::of(file).size();
    }

    herr_t read(H5FD_t *file, H5FD_mem_t, hid_t, haddr_t address, std::size_t count, void *out)
    {
        const OpenFile &open = OpenFile::of(file);
        if (!out || address > open.size() || count > open.size() - address)
            return -1;
        try {
            const std::span<std::byte> bytes(static_cast<std::byte *>(out), count);
            return open.bytes->readAt(Index(address), bytes) == count ? 0 : -1;
        } catch (const Error &) {
            return -1;
        }
    }

    H5FD_class_t makeDriver()
    {
        H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION
        driver.version = H5FD_CLASS_VERSION;
        driver.value = static_cast<H5FD_class_value_t>(600); // from the range for unregistered drivers
#endif
        driver.name = "faintline";
        driver.maxaddr = addressLimitBytes;
        driver.fc_degree = H5F_CLOSE_WEAK;
        driver.open = open;
        driver.close = close;
        driver.query = query;
        driver.get_eoa = endOf;
        driver.set_eoa = setEnd;
        driver.get_eof = sizeOf;
        driver.read = read;
        // The library rejects a driver without a write function.
        driver.write = [](H5FD_t *, H5FD_mem_t, hid_t, haddr_t, std::size_t, const void *) -> herr_t { return -1; };
        // As H5FD_FLMAP_SINGLE: one address space for all kinds of content.
        for (H5FD_mem_t &kind : driver.fl_map)
            kind = H5FD_MEM_SUPER;
        return driver;
    }

} // namespace

std::int64_t registerHdf5Driver()
{
    static const H5FD_class_t driver = makeDriver();
    return H5FDregister(&driver);
}

} // namespace faintline
