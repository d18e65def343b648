#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace faintline {

/// A counter-based random stream (Philox 4×32-10 of Salmon et al. 2011, through Random123).
///
/// (seed, stream) identifies a stream; its n-th number is a pure function of (seed, stream, n). Trials with a stream
/// each are therefore independent of thread count, order and shard, and each can be repeated alone. Not thread-safe:
/// use one object per thread.
class Random
{
public:
    Random(std::uint64_t seed, std::uint64_t stream) : m_seed(seed), m_stream(stream) {}

    std::uint32_t bits();

    /// Uniform on (0, 1): (bits + ½)·2⁻³².
    double uniform();

    /// Standard normal by Box-Muller.
    double normal();

    /// Exponential of mean 1.
    double exponential();

    /// Fills with independent normals of the given standard deviation; the fast way to generate noise.
    ///
    /// Box-Muller in float, four normals from each block of four words. Starts at the next whole block and takes ⌈n/4⌉
    /// of them, so cutting a request at multiples of 4 changes nothing. |value| ≤ 6.7 deviations. The bytes are the
    /// same on every instruction set and thread.
    void normals(std::span<float> out, float deviation);

    /// Fills with independent exponentials of mean 1, one from each word, by the same rules as `normals`; each ≤ 22.2.
    void exponentials(std::span<float> out);

private:
    void refill();

    std::uint64_t m_seed;
    std::uint64_t m_stream;
    std::uint64_t m_block = 0;
    std::array<std::uint32_t, 4> m_words{};
    int m_used = 4;
    double m_spareNormal = 0.0;
    bool m_hasSpare = false;
};

} // namespace faintline
