#include "signal/fileHash.h"

#include "base/Error.h"
#include "signal/FileBytes.h"

#include <nettle/sha2.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace faintline {

namespace {

    class Sha256
    {
    public:
        Sha256() { sha256_init(&m_context); }

        void add(std::span<const std::byte> bytes)
        {
            sha256_update(&m_context, bytes.size(), reinterpret_cast<const std::uint8_t *>(bytes.data()));
        }

        std::string hexadecimal()
        {
            std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
            sha256_digest(&m_context, digest.size(), digest.data());
            std::string text;
            for (const std::uint8_t byte : digest) {
                text += "0123456789abcdef"[byte >> 4];
                text += "0123456789abcdef"[byte & 15];
            }
            return text;
        }

    private:
        sha256_ctx m_context;
    };

    void addBytes(Sha256 &hash, const FileBytes &file, Index first, Index count)
    {
        std::vector<std::byte> buffer(std::size_t(std::min<Index>(count, 1 << 20)));
        for (Index done = 0; done < count;) {
            const auto wanted = std::span(buffer).first(std::size_t(std::min(count - done, std::ssize(buffer))));
            if (file.readAt(first + done, wanted) < wanted.size())
                throw Error(file.path(), "was truncated while being read", Error::Kind::Failure);
            hash.add(wanted);
            done += std::ssize(wanted);
        }
    }

    void addLength(Sha256 &hash, const FileBytes &file)
    {
        std::array<std::byte, 8> length; // little-endian
        for (std::size_t i = 0; i < length.size(); ++i)
            length[i] = static_cast<std::byte>(std::uint64_t(file.size()) >> (8 * i));
        hash.add(length);
    }

} // namespace

std::string fileHash(const std::string &path)
{
    constexpr Index mebibyte = 1 << 20;
    const FileBytes file(path);
    Sha256 hash;
    if (file.size() <= 64 * mebibyte) {
        addBytes(hash, file, 0, file.size());
        return hash.hexadecimal();
    }
    addBytes(hash, file, 0, mebibyte);
    addBytes(hash, file, file.size() - mebibyte, mebibyte);
    addLength(hash, file);
    return "part:" + hash.hexadecimal();
}

std::string filesHash(const std::vector<std::string> &paths)
{
    constexpr Index end = 1 << 16;
    Sha256 hash;
    for (const std::string &path : paths) {
        const FileBytes file(path);
        addBytes(hash, file, 0, std::min(end, file.size()));
        addBytes(hash, file, std::max<Index>(0, file.size() - end), std::min(end, file.size()));
        addLength(hash, file);
    }
    return "files:" + hash.hexadecimal();
}

} // namespace faintline
