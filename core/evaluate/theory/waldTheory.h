#pragma once

#include "detect/Sprt.h"

#include <string>

namespace faintline {

/// Divergences between a cell with a target, Exp(mean 1+ρ), and one without, Exp(1), in nats per stage.
struct Divergences {
    double h1 = 0.0; ///< D(f1‖f0) = E1 λ: growth of ln Λ with a signal
    double h0 = 0.0; ///< D(f0‖f1) = -E0 λ: its decrease on noise
};

/// For a known target cell: h1 = ρ - ln(1+ρ), h0 = ln(1+ρ) - ρ/(1+ρ).
Divergences divergences(double snr);

/// For a target in one of M cells, independently at each stage: the mixture 1/M Σ_j f1(cell j) against noise.
///
/// With W = 1/M Σ e^{λ_j}: h1 = E1 ln W, h0 = -E0 ln W, each as ∫₀^∞ (e^{-t} - E e^{-tW}) dt/t (Frullani), where E
/// e^{-tW} is a product over the cells. Uses quadrature of Boost.Math for the inner and trapezoids in ln t for the
/// outer integral; relative error below 1e-9. Oracle: simulation; M = 1.
Divergences mixtureDivergences(double snr, int cells);

/// Expected numbers of stages (ASN) in two extreme cases.
struct WaldBounds {
    double h0Low = 0.0;  ///< known trajectory
    double h0High = 0.0; ///< unknown trajectory
    double h1Low = 0.0;
    double h1High = 0.0;
};

/// (8a) [β ln γ0 + (1-β) ln γ1]/D1 and (8b) [(1-α) ln γ0 + α ln γ1]/(-D0) of Grossi and Lops 2006, without overshoot:
/// Wald's approximations for the two extreme laws of M cells. They neglect by how far ln Λ overshoots its boundary, so
/// the true ASN for an unknown trajectory exceeds the upper one by some per cent.
WaldBounds waldBounds(const SprtSettings &settings, double snr, int cells);

/// Exact properties of a sequential test for a target of known trajectory.
struct DeterministicSprt {
    struct Law {
        double meanStages = 0.0;
        double deviationStages = 0.0;
        double acceptH1 = 0.0; ///< α on noise, 1 - β with a signal
        double acceptH0 = 0.0; ///< from an independent equation
    };
    Law h0;
    Law h1;
};

/// Mean and standard deviation of the stopping stage, and error probabilities, without a cut-off.
///
/// ln Λ is a random walk of steps λ ≥ -c, c = ln(1+ρ). Each quantity N(x) of a walk at x solves a Fredholm equation
/// N(x) = g(x) + ∫ N(z) f(z - x) dz over ln γ0 … ln γ1, with f the density of λ. f jumps at -c, so N has kinks at ln γ0
/// + c, + 2c, …; it is solved on panels of that width by collocation at 16 Gauss points per panel. Error below 1e-8
/// stages. designSnr determines λ, actualSnr the data. Source: Wald; Grossi and Lops 2006 section 3.3 has only the
/// bounds. Oracle: simulation, α against a change of measure. Throws Error for a design SNR that needs more than 256
/// panels (below -10 dB at α = β = 1e-3).
DeterministicSprt deterministicSprt(const SprtSettings &settings, double designSnr, double actualSnr);

/// Size of a test of fixed size with the same errors for a known trajectory: the smallest number of stages n for which
/// a threshold on Σ y exists with P(Γ(n) > T) ≤ α and P((1+ρ) Γ(n) ≤ T) ≤ β.
Index fixedSampleSize(const SprtSettings &settings, double snr);

} // namespace faintline
