#pragma once

#include "base/Random.h"
#include "signal/ArrayRecording.h"
#include "support/errors.h"
#include "support/files.h"

#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace faintline::test {

/// A file of ../shared/recordings; empty where there is none.
inline std::string sharedRecording(const char *name)
{
    const QString path = QStringLiteral(FAINTLINE_SOURCE_DIR "/../shared/recordings/") + QString::fromUtf8(name);
    return QFile::exists(path) ? path.toStdString() : std::string();
}

/// Normals of deviation 0.2: in ±1 but for one in a million.
inline std::vector<float> someNoise(Index count, std::uint64_t stream = 1)
{
    std::vector<float> values(static_cast<std::size_t>(count));
    Random(20, stream).normals(values, 0.2f);
    for (float &value : values)
        value = std::clamp(value, -1.0f, 1.0f);
    return values;
}

/// Seconds of noise at 1 kHz whose level swells, and what a filter leaves of it above 300 Hz: 35 dB less.
inline RecordingPointer filteredNoise(double seconds)
{
    constexpr int taps = 101;
    std::vector<double> filter;
    for (int tap = -taps / 2; tap <= taps / 2; ++tap) {
        const double x = 0.6 * std::numbers::pi * double(tap);
        const double hann = 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * double(tap) / double(taps));
        filter.push_back(hann * (tap == 0 ? 0.6 : 0.6 * std::sin(x) / x));
    }
    filter[taps / 2] += std::pow(10.0, -35.0 / 20.0);
    std::vector<float> noise(std::size_t(1000.0 * seconds) + taps);
    Random(3, 0).normals(noise, 1.0f);
    for (std::size_t i = 0; i < noise.size(); ++i)
        noise[i] *= float(std::pow(10.0, 3.0 * std::sin(double(i) / 3000.0) / 20.0));
    const auto samples = std::make_shared<std::vector<float>>();
    for (std::size_t i = 0; i + taps < noise.size(); ++i)
        samples->push_back(
            float(std::inner_product(filter.begin(), filter.end(), noise.begin() + std::ptrdiff_t(i), 0.0)));
    const ArrayLayout layout{.sampleRateHz = 1000.0, .sampleCount = std::ssize(*samples)};
    return std::make_shared<ArrayRecording>("filtered", std::shared_ptr<const float>(samples, samples->data()), layout);
}

/// Interleaved samples to a file by libsndfile.
inline void writeAudio(const std::string &path, int format, int channels, int rate, const std::vector<float> &samples)
{
    SF_INFO info = {};
    info.format = format;
    info.channels = channels;
    info.samplerate = rate;
    SNDFILE *file = sf_open(path.c_str(), SFM_WRITE, &info);
    if (!file)
        qFatal("libsndfile cannot write a test file");
    const auto frames = static_cast<sf_count_t>(samples.size()) / channels;
    constexpr sf_count_t piece = 100000; // Vorbis puts what it is given on the stack
    for (sf_count_t done = 0; done < frames; done += piece)
        sf_writef_float(file, samples.data() + done * channels, std::min(piece, frames - done));
    sf_close(file);
}

/// A whole file as libsndfile decodes it from its beginning, interleaved: the oracle for random access.
inline std::vector<float> decodeAudio(const std::string &path)
{
    SF_INFO info = {};
    SNDFILE *file = sf_open(path.c_str(), SFM_READ, &info);
    std::vector<float> all(file ? std::size_t(info.frames * info.channels) : 0);
    const sf_count_t got = file ? sf_readf_float(file, all.data(), info.frames) : 0;
    sf_close(file);
    all.resize(std::size_t(got * info.channels));
    return all;
}

inline std::vector<float> readAll(const Recording &recording, int channel = 0)
{
    std::vector<float> all(std::size_t(recording.info().sampleCount * recording.info().floatsPerSample()));
    recording.read(channel, 0, recording.info().sampleCount, all);
    return all;
}

/// The whole recording read in pieces of odd lengths, in a random order.
inline std::vector<float> readInPieces(const Recording &recording, Index longestPiece, int channel = 0,
                                       std::uint64_t seed = 3)
{
    const Index floats = recording.info().floatsPerSample();
    const Index count = recording.info().sampleCount;
    Random random(seed, 0);
    std::vector<std::pair<Index, Index>> pieces;
    for (Index first = 0; first < count;) {
        const Index length = std::min(count - first, 1 + Index(random.uniform() * double(longestPiece)));
        pieces.emplace_back(first, length);
        first += length;
    }
    for (std::size_t i = pieces.size(); i > 1; --i)
        std::swap(pieces[i - 1], pieces[std::size_t(random.uniform() * double(i))]);
    std::vector<float> all(std::size_t(count * floats));
    for (const auto &[first, length] : pieces)
        recording.read(channel, first, length,
                       std::span(all).subspan(std::size_t(first * floats), std::size_t(length * floats)));
    return all;
}

/// Every `stride`-th value from `offset` on.
inline std::vector<float> every(const std::vector<float> &values, std::size_t stride, std::size_t offset)
{
    std::vector<float> result;
    for (std::size_t i = offset; i < values.size(); i += stride)
        result.push_back(values[i]);
    return result;
}

inline double largestDifference(const std::vector<float> &a, const std::vector<float> &b)
{
    if (a.size() != b.size())
        return INFINITY;
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(double(a[i]) - double(b[i])));
    return largest;
}

/// Direct discrete Fourier transform of n samples at one frequency in cycles per sample.
inline std::complex<double> fourier(const float *samples, Index n, bool isComplex, double turnsPerSample)
{
    const std::complex<double> step = std::polar(1.0, -2.0 * std::numbers::pi * turnsPerSample);
    std::complex<double> phasor = 1.0;
    std::complex<double> sum = 0.0;
    for (Index i = 0; i < n; ++i, phasor *= step)
        sum += phasor * (isComplex ? std::complex<double>(samples[2 * i], samples[2 * i + 1]) : samples[i]);
    return sum;
}

/// Amplitude of a frequency in samples first … first+length-1 of channel 0.
inline double amplitudeAt(const Recording &recording, double hz, Index first, Index length)
{
    const RecordingInfo &info = recording.info();
    std::vector<float> samples(std::size_t(length * info.floatsPerSample()));
    recording.read(0, first, length, samples);
    const double sum = std::abs(fourier(samples.data(), length, info.isComplex, hz / info.sampleRateHz));
    return sum / double(length) * (info.isComplex ? 1.0 : 2.0);
}

/// Samples held in memory, one channel.
class MemoryRecording final : public Recording
{
public:
    MemoryRecording(std::vector<float> samples, double rateHz, bool isComplex = false, double centreHz = 0.0)
        : m_samples(std::move(samples))
    {
        m_info.path = "memory";
        m_info.container = "memory";
        m_info.sampleType = isComplex ? "cf32" : "rf32";
        m_info.sampleRateHz = rateHz;
        m_info.isComplex = isComplex;
        m_info.centreHz = centreHz;
        m_info.channelCount = 1;
        m_info.sampleCount = std::ssize(m_samples) / m_info.floatsPerSample();
    }

    RecordingInfo &mutableInfo() { return m_info; }
    /// These samples were not heard: they read as 0, and tell so unless they are hidden.
    void leaveOut(Index first, Index count, bool isHidden = false)
    {
        std::fill_n(m_samples.begin() + first, count, 0.0f);
        m_gap = isHidden ? std::pair<Index, Index>() : std::pair(first, first + count);
    }

    bool isWhole(Index first, Index count) const override
    {
        return m_gap.first == m_gap.second || first >= m_gap.second || first + count <= m_gap.first;
    }
    void read(int, Index first, Index count, std::span<float> out) const override
    {
        fill(first, count, out, [&](Index from, std::span<float> inside) {
            std::copy_n(m_samples.begin() + from * m_info.floatsPerSample(), inside.size(), inside.begin());
        });
    }

private:
    std::vector<float> m_samples;
    std::pair<Index, Index> m_gap{}; ///< begin and end
};

} // namespace faintline::test
