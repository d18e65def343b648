#include "signal/formats/AudioRecording.h"

#include "base/Error.h"
#include "signal/formats/AudioDecoder.h"
#include "signal/formats/SampleType.h"

#include <algorithm>
#include <limits>

namespace faintline {

namespace {

    constexpr Index floatsPerBlock = 1 << 18;
    constexpr Index lossyRunUp = 1 << 14; ///< samples; longer than the relevant memory of any codec
    constexpr std::size_t mostIdle = 16;

    bool isLossy(int format)
    {
        const int container = format & SF_FORMAT_TYPEMASK;
        return container == SF_FORMAT_OGG || container == SF_FORMAT_MPEG;
    }

    bool isUncompressed(int format)
    {
        const int container = format & SF_FORMAT_TYPEMASK;
        switch (format & SF_FORMAT_SUBMASK) {
        case SF_FORMAT_PCM_S8:
        case SF_FORMAT_PCM_U8:
        case SF_FORMAT_PCM_16:
        case SF_FORMAT_PCM_24:
        case SF_FORMAT_PCM_32:
        case SF_FORMAT_FLOAT:
        case SF_FORMAT_DOUBLE:
        case SF_FORMAT_ULAW:
        case SF_FORMAT_ALAW:
            return container != SF_FORMAT_FLAC && container != SF_FORMAT_OGG;
        default:
            return false;
        }
    }

    /// Whether libsndfile's message denotes an unknown format.
    bool isOfUnknownFormat(const std::string &said)
    {
        return said.find("not recognised") != std::string::npos || said.find("unknown format") != std::string::npos;
    }

    std::string refusal(const std::string &said)
    {
        if (isOfUnknownFormat(said))
            return "has an unknown format; ";
        if (said.find("SF_INFO struct incomplete") != std::string::npos)
            return "the sample rate or channel count in its header is 0; ";
        return "is damaged or truncated in its header (" + said + "); ";
    }

} // namespace

AudioRecording::AudioRecording(const std::string &path, bool iq) : m_file(std::make_shared<FileBytes>(path))
{
    if (m_file->size() == 0)
        throw Error(path, std::string("is empty; ") + acceptedFormats);
    m_info.path = path;
    std::unique_ptr<AudioDecoder> decoder = openDecoder();
    const SF_INFO format = decoder->format();
    if ((format.format & SF_FORMAT_TYPEMASK) == SF_FORMAT_AIFF && !hasAiffRate(*m_file))
        throw Error(path, "the sample rate in its header is not a number from 1 Hz to 1e9 Hz");
    m_streams = format.channels;
    if (iq && m_streams % 2 != 0)
        throw Error(path, "has " + std::to_string(m_streams) + " channel(s); I/Q needs an even number");
    m_info.container = containerName(format.format);
    m_info.sampleType = sampleTypeName(format.format);
    m_info.sampleRateHz = format.samplerate;
    m_info.isComplex = iq;
    m_info.channelCount = int(iq ? m_streams / 2 : m_streams);

    const int encoding = format.format & SF_FORMAT_SUBMASK;
    m_isIqBytes = iq && encoding == SF_FORMAT_PCM_U8;
    m_isFloat = encoding == SF_FORMAT_FLOAT || encoding == SF_FORMAT_DOUBLE;
    m_access = !format.seekable ? Access::Forward : isUncompressed(format.format) ? Access::Direct : Access::Blocks;
    m_runUp = isLossy(format.format) ? lossyRunUp : 0;
    m_blockSamples = std::max<Index>(1, floatsPerBlock / m_streams);
    m_info.sampleCount = format.frames;
    m_info.notes = decoder->notes();
    if (const long long missing = missingBytes(decoder->log()); missing > 0)
        m_info.notes.push_back(
            "The header claims " + std::to_string(missing)
            + " bytes more than the file holds (it was truncated or never closed); the existing part is read.");
    if (m_access == Access::Blocks) {
        m_info.sampleCount = readableCount(decoder);
        if (m_info.sampleCount != format.frames)
            m_info.notes.push_back("The header gives no length or more than the file holds; the "
                                   + std::to_string(m_info.sampleCount) + " samples that can be decoded are read.");
    }
    if (m_info.sampleCount <= 0)
        throw Error(path, "is a " + m_info.container + " file without samples");
    if (m_isIqBytes)
        m_info.notes.push_back("The zero of these bytes is taken to lie between 127 and 128, as in receivers.");
    m_stored = m_info.sampleCount;
    if (const Stretches places = readAudioMetadata(*decoder, m_info); places.hasGaps()) {
        m_info.sampleCount = places.end();
        m_info.places = places;
    }

    auto handle = std::make_unique<Handle>();
    handle->decoder = std::move(decoder);
    giveBack(std::move(handle));
}

AudioRecording::~AudioRecording() = default;

bool AudioRecording::recognises(const std::string &path)
{
    std::string why;
    return AudioDecoder::open(std::make_shared<FileBytes>(path), why) || !isOfUnknownFormat(why);
}

std::unique_ptr<AudioDecoder> AudioRecording::openDecoder() const
{
    std::string why;
    std::unique_ptr<AudioDecoder> decoder = AudioDecoder::open(m_file, why);
    if (!decoder)
        throw Error(m_info.path, refusal(why) + acceptedFormats);
    return decoder;
}

void AudioRecording::failAt(Index sample) const
{
    throw Error(m_info.path,
                "cannot be decoded near sample " + std::to_string(sample)
                    + ": it is damaged or was truncated while open",
                Error::Kind::Failure);
}

// ---- handles -----------------------------------------------------------------------------------------------------

/// The idle handle with the least work for this block or position, or a new one.
std::unique_ptr<AudioRecording::Handle> AudioRecording::borrow(Index block, Index position) const
{
    {
        const std::lock_guard lock(m_mutex);
        const auto cost = [&](const Handle &handle) {
            const Index at = handle.decoder->position();
            if (block >= 0 && handle.block == block)
                return 0;
            if (at == position)
                return 1;
            return m_access != Access::Forward ? 2 : at < position ? 3 : 4;
        };
        const auto best = std::min_element(m_idle.begin(), m_idle.end(),
                                           [&](const auto &a, const auto &b) { return cost(*a) < cost(*b); });
        if (best != m_idle.end() && cost(**best) < 4) {
            std::unique_ptr<Handle> handle = std::move(*best);
            m_idle.erase(best);
            return handle;
        }
    }
    auto handle = std::make_unique<Handle>();
    handle->decoder = openDecoder();
    return handle;
}

void AudioRecording::giveBack(std::unique_ptr<Handle> handle) const
{
    const std::lock_guard lock(m_mutex);
    if (m_idle.size() >= mostIdle)
        m_idle.erase(m_idle.begin());
    m_idle.push_back(std::move(handle));
}

// ---- reading -----------------------------------------------------------------------------------------------------

void AudioRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    fillStored(first, count, out, [&](Index stored, std::span<float> part) { readStored(channel, stored, part); });
}

void AudioRecording::readStored(int channel, Index first, std::span<float> out) const
{
    const Index offset = channel * m_info.floatsPerSample();
    if (m_access == Access::Direct)
        readDirectly(offset, first, out);
    else
        readBlocks(offset, first, out);
    for (float &value : out.first(m_isIqBytes ? out.size() : 0))
        value += iqByteShift;
}

/// Copies one channel from interleaved floats.
void AudioRecording::copyChannel(std::span<const float> frames, Index offset, std::span<float> out) const
{
    const Index floats = m_info.floatsPerSample();
    const Index count = std::ssize(out) / floats;
    const float *from = frames.data() + offset;
    float *to = out.data();
    for (Index i = 0; i < count; ++i, from += m_streams)
        for (Index c = 0; c < floats; ++c)
            *to++ = from[c];
}

void AudioRecording::readDirectly(Index offset, Index first, std::span<float> out) const
{
    std::unique_ptr<Handle> handle = borrow(-1, first);
    if (!handle->decoder->seek(first))
        failAt(first);
    const Index floats = m_info.floatsPerSample();
    const Index samples = std::ssize(out) / floats;
    if (m_streams == floats) {
        if (const Index got = handle->decoder->read(samples, out); got < samples)
            failAt(first + got);
    } else {
        const Index perRead = std::min(samples, std::max<Index>(1, floatsPerBlock / 8 / m_streams));
        handle->samples.resize(std::size_t(perRead * m_streams));
        for (Index done = 0; done < samples;) {
            const Index run = std::min(perRead, samples - done);
            if (handle->decoder->read(run, handle->samples) < run)
                failAt(first + done);
            copyChannel(handle->samples, offset, out.subspan(std::size_t(done * floats), std::size_t(run * floats)));
            done += run;
        }
    }
    giveBack(std::move(handle));
}

void AudioRecording::readBlocks(Index offset, Index first, std::span<float> out) const
{
    const Index floats = m_info.floatsPerSample();
    const Index samples = std::ssize(out) / floats;
    for (Index done = 0; done < samples;) {
        const Index block = (first + done) / m_blockSamples;
        const Index within = (first + done) % m_blockSamples;
        std::unique_ptr<Handle> handle = borrow(block, std::max<Index>(0, block * m_blockSamples - m_runUp));
        if (handle->block != block)
            decodeBlock(*handle, block);
        const Index run = std::min(samples - done, m_blockSamples - within);
        copyChannel(std::span(handle->samples).subspan(std::size_t(within * m_streams)), offset,
                    out.subspan(std::size_t(done * floats), std::size_t(run * floats)));
        done += run;
        giveBack(std::move(handle));
    }
}

void AudioRecording::decodeBlock(Handle &handle, Index block) const
{
    handle.block = -1;
    if (m_runUp > 0)
        handle.decoder = openDecoder(); // a used decoder's output depends on earlier blocks in the last bits
    AudioDecoder &decoder = *handle.decoder;
    const Index start = block * m_blockSamples;
    const Index count = std::min(m_blockSamples, m_stored - start);
    handle.samples.resize(std::size_t(m_blockSamples * m_streams));
    if (m_access == Access::Blocks && !decoder.seek(std::max<Index>(0, start - m_runUp)))
        failAt(start);
    while (decoder.position() < start) {
        const Index skip = std::min(m_blockSamples, start - decoder.position());
        if (decoder.read(skip, handle.samples) < skip)
            failAt(decoder.position());
    }
    if (decoder.position() != start || decoder.read(count, handle.samples) < count)
        failAt(decoder.position());
    handle.block = block;
}

// ---- decodable length --------------------------------------------------------------------------------------------

bool AudioRecording::isReadable(std::unique_ptr<AudioDecoder> &decoder, Index sample) const
{
    std::vector<float> one(static_cast<std::size_t>(m_streams));
    if (decoder->seek(sample) && decoder->read(1, one) == 1)
        return true;
    decoder = openDecoder(); // a decoder that reached the end of a truncated stream is unreliable
    return false;
}

/// The header's sample count if its last sample is readable; else the largest readable count, by bisection.
Index AudioRecording::readableCount(std::unique_ptr<AudioDecoder> &decoder) const
{
    const Index claimed = decoder->format().frames;
    const bool isKnown = claimed > 0 && claimed < std::numeric_limits<sf_count_t>::max();
    if (isKnown && isReadable(decoder, claimed - 1))
        return claimed;
    Index readable = 0;
    Index beyond = isKnown ? claimed : m_blockSamples;
    while (!isKnown && beyond < (Index(1) << 48) && isReadable(decoder, beyond - 1)) {
        readable = beyond;
        beyond *= 2;
    }
    while (beyond - readable > 1) {
        const Index middle = readable + (beyond - readable) / 2;
        if (isReadable(decoder, middle - 1))
            readable = middle;
        else
            beyond = middle;
    }
    return readable;
}

} // namespace faintline
