#include "signal/formats/writeRecording.h"

#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"
#include "base/json.h"
#include "base/utc.h"
#include "signal/formats/SampleType.h"
#include "signal/formats/SigmfRecording.h"

#include <sndfile.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <utility>

namespace faintline {

namespace {

    constexpr std::array<std::pair<std::string_view, int>, 8> audioKinds{{
        {".wav", SF_FORMAT_WAV},
        {".rf64", SF_FORMAT_RF64},
        {".w64", SF_FORMAT_W64},
        {".aiff", SF_FORMAT_AIFF},
        {".aif", SF_FORMAT_AIFF},
        {".caf", SF_FORMAT_CAF},
        {".au", SF_FORMAT_AU},
        {".flac", SF_FORMAT_FLAC},
    }};

    auto kindOf(const std::string &path)
    {
        return std::ranges::find_if(audioKinds, [&](const auto &kind) { return hasEnding(path, kind.first); });
    }

    /// Receives interleaved samples of all channels, in order.
    class Writer
    {
    public:
        virtual ~Writer() = default;
        virtual void write(std::span<const float> samples) = 0;
        virtual void finish() = 0;
        Index clippedCount() const { return m_clippedCount; }

    protected:
        /// round(x·2^(bits-1)), clipped and counted.
        std::int32_t toInteger(float x, int bits)
        {
            const double highest = std::ldexp(1.0, bits - 1);
            const double rounded = std::nearbyint(double(x) * highest);
            const double clipped = std::clamp(rounded, -highest, highest - 1.0);
            m_clippedCount += clipped == rounded ? 0 : 1;
            return std::int32_t(clipped);
        }

    private:
        Index m_clippedCount = 0;
    };

    class AudioWriter final : public Writer
    {
    public:
        AudioWriter(const RecordingInfo &info, const std::string &path, int kind, WrittenType type)
            : m_file(path), m_bits(type == WrittenType::Int16 ? 16
                                   : kind == SF_FORMAT_FLAC   ? 24
                                                              : 0)
        {
            SF_INFO format = {};
            format.channels = int(info.channelCount * info.floatsPerSample());
            if (std::floor(info.sampleRateHz) != info.sampleRateHz || info.sampleRateHz > 2147483647.0)
                throw Error(path, "audio files need a whole-number sample rate up to 2147483647 Hz, not "
                                      + formatNumber(info.sampleRateHz) + " Hz; write a .sigmf-meta pair");
            format.samplerate = int(info.sampleRateHz);
            const double bytes = double(info.sampleCount) * format.channels * (m_bits == 16 ? 2 : 4);
            if (kind == SF_FORMAT_WAV && bytes > 4294967296.0 - 65536.0)
                kind = SF_FORMAT_RF64;
            format.format = kind
                            | (m_bits == 16   ? SF_FORMAT_PCM_16
                               : m_bits == 24 ? SF_FORMAT_PCM_24
                                              : SF_FORMAT_FLOAT);
            m_channels = std::size_t(format.channels);
            if (!sf_format_check(&format))
                throw Error(path, "this file format does not support " + std::to_string(format.channels)
                                      + " channel(s) at " + formatNumber(info.sampleRateHz)
                                      + " Hz; write .wav, .w64 or .sigmf-meta");
            m_handle.reset(sf_open_fd(m_file.descriptor(), SFM_WRITE, &format, SF_FALSE));
            if (!m_handle)
                throw Error(path, std::string("cannot be written: ") + sf_strerror(nullptr), Error::Kind::Failure);
            sf_command(m_handle.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE); // it would store the time of writing
            if (info.startUnixSeconds && (kind == SF_FORMAT_WAV || kind == SF_FORMAT_RF64))
                writeStart(*info.startUnixSeconds, info.sampleRateHz);
        }

        void write(std::span<const float> samples) override
        {
            const auto frames = static_cast<sf_count_t>(samples.size() / m_channels);
            sf_count_t written = 0;
            if (m_bits == 0) {
                written = sf_writef_float(m_handle.get(), samples.data(), frames);
            } else {
                m_integers.resize(samples.size());
                for (std::size_t i = 0; i < samples.size(); ++i) // libsndfile uses the high bits
                    m_integers[i] = toInteger(samples[i], m_bits) * (1 << (32 - m_bits));
                written = sf_writef_int(m_handle.get(), m_integers.data(), frames);
            }
            if (written != frames)
                fail();
        }

        void finish() override
        {
            sf_write_sync(m_handle.get());
            if (sf_close(m_handle.release()) != 0)
                fail();
            m_file.commit();
        }

    private:
        struct Closer {
            void operator()(SNDFILE *handle) const { sf_close(handle); }
        };

        [[noreturn]] void fail() const
        {
            throw Error(m_file.path(), "cannot be written completely; the disk may be full", Error::Kind::Failure);
        }

        void writeStart(double unixSeconds, double rateHz)
        {
            const std::string text = formatUtc(unixSeconds);
            if (text.size() < 19)
                return;
            SF_BROADCAST_INFO bext = {};
            std::copy_n(text.data(), 10, bext.origination_date);
            std::copy_n(text.data() + 11, 8, bext.origination_time);
            const double sinceMidnight = unixSeconds - 86400.0 * std::floor(unixSeconds / 86400.0);
            const auto samples = std::uint64_t(std::llround(sinceMidnight * rateHz));
            bext.time_reference_low = std::uint32_t(samples);
            bext.time_reference_high = std::uint32_t(samples >> 32);
            bext.version = 1;
            sf_command(m_handle.get(), SFC_SET_BROADCAST_INFO, &bext, sizeof bext);
        }

        AtomicFile m_file;
        int m_bits; ///< bits of an integer; 0: float
        std::size_t m_channels = 1;
        std::unique_ptr<SNDFILE, Closer> m_handle;
        std::vector<int> m_integers;
    };

    class SigmfWriter final : public Writer
    {
    public:
        SigmfWriter(const RecordingInfo &info, const std::string &path, WrittenType type)
            : m_metaFile(stem(path) + ".sigmf-meta"), m_dataFile(stem(path) + ".sigmf-data"),
              m_isInteger(type == WrittenType::Int16)
        {
            SampleType sampleType;
            sampleType.isComplex = info.isComplex;
            sampleType.number = m_isInteger ? SampleType::Number::Signed : SampleType::Number::Float;
            sampleType.bytes = m_isInteger ? 2 : 4;
            Json global;
            global["core:datatype"] = sampleType.name();
            global["core:sample_rate"] = info.sampleRateHz;
            global["core:version"] = "1.0.0";
            global["core:num_channels"] = info.channelCount;
            global["core:recorder"] = "Faintline";
            Json capture;
            capture["core:sample_start"] = 0;
            if (info.centreHz != 0.0)
                capture["core:frequency"] = info.centreHz;
            if (info.startUnixSeconds)
                capture["core:datetime"] = formatUtc(*info.startUnixSeconds);
            const Json meta = {
                {"global", global}, {"captures", Json::array({capture})}, {"annotations", Json::array()}};
            m_metaFile.write(meta.dump(4) + "\n");
        }

        void write(std::span<const float> samples) override
        {
            m_bytes.clear();
            for (const float x : samples)
                if (m_isInteger)
                    append(std::uint16_t(toInteger(x, 16)));
                else
                    append(std::bit_cast<std::uint32_t>(x));
            m_dataFile.write(m_bytes);
        }

        void finish() override
        {
            m_dataFile.commit();
            m_metaFile.commit();
        }

    private:
        static std::string stem(const std::string &path) { return path.substr(0, path.rfind('.')); }

        template <class T>
        void append(T bits) // little-endian
        {
            for (std::size_t i = 0; i < sizeof bits; ++i)
                m_bytes.push_back(static_cast<std::byte>(bits >> (8 * i)));
        }

        AtomicFile m_metaFile;
        AtomicFile m_dataFile;
        bool m_isInteger;
        std::vector<std::byte> m_bytes;
    };

    std::unique_ptr<Writer> makeWriter(const RecordingInfo &info, const std::string &path, WrittenType type)
    {
        checkRecordingName(path);
        if (SigmfRecording::isNamedSo(path))
            return std::make_unique<SigmfWriter>(info, path, type);
        return std::make_unique<AudioWriter>(info, path, kindOf(path)->second, type);
    }

} // namespace

void checkRecordingName(const std::string &path)
{
    if (!SigmfRecording::isNamedSo(path) && kindOf(path) == audioKinds.end())
        throw Error(path, "has no known extension; expected .wav, .rf64, .w64, .aiff, .caf, .au, .flac or .sigmf-meta");
}

Index writeRecording(const Recording &recording, const std::string &path, WrittenType type, const RunContext &context)
{
    const RecordingInfo &info = recording.info();
    const std::unique_ptr<Writer> writer = makeWriter(info, path, type);
    const Index floats = info.floatsPerSample();
    const Index streams = floats * info.channelCount;
    const Index block = std::max<Index>(1, (1 << 18) / streams);
    std::vector<float> channel(std::size_t(block * floats));
    std::vector<float> interleaved(std::size_t(block * streams));
    for (Index done = 0; done < info.sampleCount; done += block) {
        context.checkpoint(double(done) / double(info.sampleCount), "writing");
        const Index run = std::min(block, info.sampleCount - done);
        for (int c = 0; c < info.channelCount; ++c) {
            recording.read(c, done, run, channel);
            for (Index i = 0; i < run; ++i)
                for (Index part = 0; part < floats; ++part)
                    interleaved[std::size_t(i * streams + c * floats + part)] = channel[std::size_t(i * floats + part)];
        }
        writer->write(std::span(interleaved).first(std::size_t(run * streams)));
    }
    context.checkpoint(1.0, "writing");
    writer->finish();
    return writer->clippedCount();
}

} // namespace faintline
