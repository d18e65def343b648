#pragma once

#include <bit>
#include <cstdint>

namespace faintline {

/// Branch-free float functions that the compiler can vectorise in inner loops.
///
/// Only +, -, ·, comparisons and integer operations, so every instruction set gives the same bits. Relative error below
/// 2e-7. Polynomials: Moshier, Cephes (logf, expf, sinf, cosf).

/// ln x for a normal x > 0.
inline float fastLn(float x)
{
    const auto bits = std::bit_cast<std::int32_t>(x);
    const std::int32_t exponent = (bits - 0x3f3504f3) >> 23; // mantissa in √½ … √2
    const float m = std::bit_cast<float>(bits - (exponent << 23)) - 1.0f;
    const float e = float(exponent);
    float p = 7.0376836292e-2f;
    p = p * m - 1.1514610310e-1f;
    p = p * m + 1.1676998740e-1f;
    p = p * m - 1.2420140846e-1f;
    p = p * m + 1.4249322787e-1f;
    p = p * m - 1.6668057665e-1f;
    p = p * m + 2.0000714765e-1f;
    p = p * m - 2.4999993993e-1f;
    p = p * m + 3.3333331174e-1f;
    const float z = m * m;
    const float tail = p * m * z - 2.12194440e-4f * e - 0.5f * z;
    return (m + tail) + 0.693359375f * e; // ln 2 in two parts
}

/// eˣ with x clamped to -87 … 88, so that the result is a normal number; NaN gives NaN.
inline float fastExp(float x)
{
    x = x < -87.0f ? -87.0f : x;
    x = x > 88.0f ? 88.0f : x;
    constexpr float roundingShift = 12582912.0f; // adding 1.5·2²³ rounds to a whole number
    const float n = (x * 1.44269504088896341f + roundingShift) - roundingShift;
    const float r = (x - n * 0.693359375f) - n * -2.12194440e-4f; // ln 2 in two parts
    float p = 1.9875691500e-4f;
    p = p * r + 1.3981999507e-3f;
    p = p * r + 8.3334519073e-3f;
    p = p * r + 4.1665795894e-2f;
    p = p * r + 1.6666665459e-1f;
    p = p * r + 5.0000001201e-1f;
    const float mantissa = (p * (r * r) + r) + 1.0f;
    const float power = n == n ? n : 0.0f; // NaN has no integer value
    return mantissa * std::bit_cast<float>((std::int32_t(power) + 127) << 23);
}

struct SineCosine {
    float sine;
    float cosine;
};

/// sin and cos of an angle in -π/4 … π/4.
inline SineCosine fastSineCosineOctant(float angle)
{
    const float z = angle * angle;
    const float sine = angle * (1.0f + z * (-1.6666654611e-1f + z * (8.3321608736e-3f + z * -1.9515295891e-4f)));
    const float cosine =
        1.0f + z * (-0.5f + z * (4.166664568298827e-2f + z * (-1.388731625493765e-3f + z * 2.443315711809948e-5f)));
    return {sine, cosine};
}

/// Swaps two numbers if `one` is 1. It uses integers because compilers tend to branch otherwise.
inline void swapIf(std::uint32_t one, float &a, float &b)
{
    const std::uint32_t difference = (std::bit_cast<std::uint32_t>(a) ^ std::bit_cast<std::uint32_t>(b)) & (0u - one);
    a = std::bit_cast<float>(std::bit_cast<std::uint32_t>(a) ^ difference);
    b = std::bit_cast<float>(std::bit_cast<std::uint32_t>(b) ^ difference);
}

/// sin 2πx and cos 2πx of an angle in turns, |x| ≤ ½.
inline SineCosine fastSineCosineTurns(float turns)
{
    constexpr float roundingShift = 12582912.0f; // adding 1.5·2²³ rounds to a whole number
    const float quarter = (4.0f * turns + roundingShift) - roundingShift;
    auto [sine, cosine] = fastSineCosineOctant(6.28318530718f * (turns - 0.25f * quarter));
    const auto quadrant = std::int32_t(quarter); // -2 … 2
    swapIf(std::uint32_t(quadrant) & 1u, sine, cosine);
    const std::uint32_t flipSine = (std::uint32_t(quadrant) & 2u) << 30;
    const std::uint32_t flipCosine = (std::uint32_t(quadrant + 1) & 2u) << 30;
    return {std::bit_cast<float>(std::bit_cast<std::uint32_t>(sine) ^ flipSine),
            std::bit_cast<float>(std::bit_cast<std::uint32_t>(cosine) ^ flipCosine)};
}

} // namespace faintline
