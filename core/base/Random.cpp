#include "base/Random.h"

#include "base/fastmath.h"
#include "base/multiversion.h"

#include <Random123/philox.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace faintline {

namespace {

    /// Identifies a block of four words by key and counter of Philox.
    struct BlockNumber {
        std::uint64_t seed;
        std::uint64_t stream;
        std::uint64_t block;

        BlockNumber operator+(std::uint64_t further) const { return {seed, stream, block + further}; }
    };

    inline r123::Philox4x32::ctr_type philoxBlock(const BlockNumber &number)
    {
        const auto [seed, stream, block] = number;
        const r123::Philox4x32::ctr_type counter{
            {std::uint32_t(block), std::uint32_t(block >> 32), std::uint32_t(stream), std::uint32_t(stream >> 32)}};
        const r123::Philox4x32::key_type key{{std::uint32_t(seed), std::uint32_t(seed >> 32)}};
        return r123::Philox4x32()(counter, key);
    }

    /// Two normals from two words: radius from 31 bits, angle from a quadrant and 30 bits.
    inline void boxMuller(std::uint32_t radiusWord, std::uint32_t angleWord, float deviation, float &first,
                          float &second)
    {
        const float uniform = float(std::int32_t(radiusWord >> 1)) * 0x1p-31f + 0x1p-32f;
        const float radius = deviation * std::sqrt(-2.0f * fastLn(uniform));
        // The low 30 bits turn within -45° … 45°; the high two mirror and reverse, which covers the circle evenly.
        const float angle = float(std::int32_t(angleWord << 2)) * (6.28318530718f * 0x1p-34f);
        auto [sine, cosine] = fastSineCosineOctant(angle);
        swapIf((angleWord >> 30) & 1u, sine, cosine);
        const float signedRadius =
            std::bit_cast<float>(std::bit_cast<std::uint32_t>(radius) ^ (angleWord & 0x80000000u));
        first = signedRadius * cosine;
        second = signedRadius * sine;
    }

    constexpr std::size_t lanes = 64; ///< Philox blocks made at a time: a kilobyte of words, enough for any vector unit

    FAINTLINE_MULTIVERSION
    void philoxWords(BlockNumber first, std::uint32_t *words)
    {
        for (std::size_t i = 0; i < lanes; ++i) {
            const auto block = philoxBlock(first + i);
            words[i] = block[0];
            words[lanes + i] = block[1];
            words[2 * lanes + i] = block[2];
            words[3 * lanes + i] = block[3];
        }
    }

    FAINTLINE_MULTIVERSION
    void normalsFromWords(const std::uint32_t *words, std::size_t blocks, float deviation, float *out)
    {
        for (std::size_t i = 0; i < blocks; ++i) {
            boxMuller(words[i], words[lanes + i], deviation, out[4 * i], out[4 * i + 1]);
            boxMuller(words[2 * lanes + i], words[3 * lanes + i], deviation, out[4 * i + 2], out[4 * i + 3]);
        }
    }

    FAINTLINE_MULTIVERSION
    void exponentialsFromWords(const std::uint32_t *words, std::size_t blocks, float *out)
    {
        // The words of a block stay adjacent, so that a request may be cut anywhere between blocks.
        for (std::size_t i = 0; i < blocks; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
                const auto half = std::int32_t(words[j * lanes + i] >> 1);
                out[4 * i + j] = -fastLn(float(half) * 0x1p-31f + 0x1p-32f);
            }
    }

    void exponentialBlocks(BlockNumber first, std::size_t blocks, float *out)
    {
        std::array<std::uint32_t, 4 * lanes> words;
        for (std::size_t done = 0; done < blocks; done += lanes) {
            philoxWords(first + done, words.data());
            exponentialsFromWords(words.data(), std::min(lanes, blocks - done), out + 4 * done);
        }
    }

    void normalBlocks(BlockNumber first, std::size_t blocks, float deviation, float *out)
    {
        std::array<std::uint32_t, 4 * lanes> words;
        for (std::size_t done = 0; done < blocks; done += lanes) {
            philoxWords(first + done, words.data());
            normalsFromWords(words.data(), std::min(lanes, blocks - done), deviation, out + 4 * done);
        }
    }

} // namespace

void Random::refill()
{
    const auto words = philoxBlock({m_seed, m_stream, m_block});
    for (std::size_t i = 0; i < 4; ++i)
        m_words[i] = words[i];
    ++m_block;
    m_used = 0;
}

std::uint32_t Random::bits()
{
    if (m_used == 4)
        refill();
    return m_words[std::size_t(m_used++)];
}

double Random::uniform()
{
    return (double(bits()) + 0.5) * 0x1p-32;
}

double Random::normal()
{
    if (m_hasSpare) {
        m_hasSpare = false;
        return m_spareNormal;
    }
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    const double angle = 2.0 * std::numbers::pi * uniform();
    m_spareNormal = radius * std::sin(angle);
    m_hasSpare = true;
    return radius * std::cos(angle);
}

double Random::exponential()
{
    return -std::log(uniform());
}

void Random::normals(std::span<float> out, float deviation)
{
    const std::size_t wholeBlocks = out.size() / 4;
    normalBlocks({m_seed, m_stream, m_block}, wholeBlocks, deviation, out.data());
    m_block += wholeBlocks;
    if (const std::span<float> rest = out.subspan(4 * wholeBlocks); !rest.empty()) {
        std::array<float, 4> last;
        normalBlocks({m_seed, m_stream, m_block}, 1, deviation, last.data());
        std::copy_n(last.begin(), rest.size(), rest.begin());
        ++m_block;
    }
    m_used = 4;
    m_hasSpare = false;
}

void Random::exponentials(std::span<float> out)
{
    const std::size_t wholeBlocks = out.size() / 4;
    exponentialBlocks({m_seed, m_stream, m_block}, wholeBlocks, out.data());
    m_block += wholeBlocks;
    if (const std::span<float> rest = out.subspan(4 * wholeBlocks); !rest.empty()) {
        std::array<float, 4> last;
        exponentialBlocks({m_seed, m_stream, m_block}, 1, last.data());
        std::copy_n(last.begin(), rest.size(), rest.begin());
        ++m_block;
    }
    m_used = 4;
    m_hasSpare = false;
}

} // namespace faintline
