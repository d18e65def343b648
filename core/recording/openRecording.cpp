#include "recording/openRecording.h"

#include "base/Error.h"
#include "recording/AudioRecording.h"
#include "recording/RawRecording.h"
#include "recording/SigmfRecording.h"

#include <nettle/sha2.h>

#include <algorithm>
#include <array>

namespace faintline {

namespace {

    RecordingPointer openRaw(const std::string &path, const std::string &typeName, const OpenOptions &options)
    {
        if (!(options.rawRateHz > 0.0))
            throw Error(path, "raw samples do not tell their rate; give it in Hz (such as --raw-rate 48000)");
        const RawLayout layout{parseSampleType(typeName, path), options.rawRateHz, options.rawChannels,
                               options.rawHeaderBytes, 0};
        return std::make_shared<RawRecording>(path, options.iq ? withIqPairs(path, layout) : layout);
    }

    /// A file whose name says raw samples and whose content does not contradict.
    RecordingPointer openByRawExtension(const std::string &path, const std::string &typeName,
                                        const OpenOptions &options)
    {
        if (typeName.empty())
            throw Error(path, "holds raw samples by its name; give their type and their rate in Hz (such as --raw-type "
                              "ci16_le --raw-rate 48000); types are "
                                  + sampleTypeList());
        if (!(options.rawRateHz > 0.0))
            throw Error(path, "holds raw samples (" + typeName
                                  + " by its name); give their rate in Hz (such as --raw-rate "
                                    "48000), and --raw-type if they are of another type");
        return openRaw(path, typeName, options);
    }

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
        std::vector<std::byte> buffer(static_cast<std::size_t>(std::min<Index>(count, 1 << 20)));
        for (Index done = 0; done < count;) {
            const auto wanted =
                std::span(buffer).first(static_cast<std::size_t>(std::min(count - done, std::ssize(buffer))));
            if (file.readAt(first + done, wanted) < wanted.size())
                throw Error(file.path(), "became shorter while it was read", Error::Kind::Failure);
            hash.add(wanted);
            done += std::ssize(wanted);
        }
    }

} // namespace

RecordingPointer openRecording(const std::string &path, const OpenOptions &options)
{
    if (!options.rawType.empty())
        return openRaw(path, options.rawType, options);
    if (SigmfRecording::isNamedSo(path))
        return std::make_shared<SigmfRecording>(path, options.iq);
    if (path.ends_with(".sigmf"))
        throw Error(path, "is a SigMF archive; unpack it (tar -xf) and open the .sigmf-meta file");
    if (const auto rawType = rawTypeOfExtension(path); rawType && !AudioRecording::recognises(path))
        return openByRawExtension(path, *rawType, options);
    return std::make_shared<AudioRecording>(path, options.iq);
}

std::string recordingHash(const std::string &path)
{
    constexpr Index mebibyte = 1 << 20;
    const FileBytes file(path.ends_with(".sigmf-meta") ? SigmfRecording::dataPath(path) : path);
    Sha256 hash;
    if (file.size() <= 64 * mebibyte) {
        addBytes(hash, file, 0, file.size());
        return hash.hexadecimal();
    }
    addBytes(hash, file, 0, mebibyte);
    addBytes(hash, file, file.size() - mebibyte, mebibyte);
    std::array<std::byte, 8> length; // little-endian
    for (std::size_t i = 0; i < length.size(); ++i)
        length[i] = static_cast<std::byte>(static_cast<std::uint64_t>(file.size()) >> (8 * i));
    hash.add(length);
    return "part:" + hash.hexadecimal();
}

} // namespace faintline
