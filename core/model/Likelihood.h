#pragma once

#include <array>
#include <span>
#include <string_view>

namespace faintline {

/// The signal laws p1(y) against p0(y) = e^(-y), y = power over mean noise power.
enum class LikelihoodKind {
    Rice,
    Exponential,
    Linear,
    Swerling4,
    Given ///< evidence computed elsewhere; not a setting, so it has no name here
};

inline constexpr std::array<std::string_view, 4> likelihoodNames{"rice", "exponential", "linear", "swerling4"};

/// The log-likelihood ratio λ(y) = ln p1(y)/p0(y), natural logarithm.
///
///   rice         constant amplitude, SNR r0:     λ = -r0 + ln I0(2√(r0·y))   Billon 2005, section 4
///   exponential  Swerling 2, mean SNR ρ:         λ = yρ/(1+ρ) - ln(1+ρ)      Parsons 2008 eq. 9, Grossi and Lops 2006
///                                                                            eq. 10
///   swerling4    power χ² with 4 degrees of      λ = sy + ln(1+sy) - 2 ln(1+ρ/2),  s = (ρ/2)/(1+ρ/2)
///                freedom, mean SNR ρ:                                        Swerling 1954, case 4
///   linear       the exponential one rescaled:   λ = y                       Parsons 2008 eq. 10
///   given        frames hold λ itself, any finite number, instead of power
///
/// A fluctuating target's power is independent in each frame (cases 2 and 4). With one power for all frames (cases 1
/// and 3) the joint density is a mean over that power and has no factor for each frame; given the power the frames are
/// those of rice, which is therefore the likelihood for them, designed for the lowest power worth detecting.
///
/// `apply` works in single precision: |error| ≤ 1e-6 · max(1, |λ|) for 0 ≤ y ≤ 1e4 and beyond; rice is one branch-free
/// polynomial after a square root and a logarithm. Oracles: Boost.Math's Bessel function; the mean of rice over the
/// power. Thread-safe.
class Likelihood
{
public:
    /// snr: r0 or ρ as a power ratio > 0; ignored for Linear and Given. Throws Error.
    explicit Likelihood(LikelihoodKind kind = LikelihoodKind::Linear, double snr = 1.0);

    LikelihoodKind kind() const { return m_kind; }
    double snr() const { return m_snr; }

    /// λ of each value; negative or infinite power counts as 0 (no energy). NaN was not observed: λ = 0, no evidence
    /// either way.
    void apply(std::span<const float> y, std::span<float> out) const;

    /// λ of one value in double precision, from the formula; NaN as above.
    double at(double y) const;

    bool operator==(const Likelihood &other) const { return m_kind == other.m_kind && m_snr == other.m_snr; }

private:
    LikelihoodKind m_kind;
    double m_snr;
};

} // namespace faintline
