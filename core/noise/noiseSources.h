#pragma once

#include "base/Axis.h"

#include <span>
#include <vector>

namespace faintline {

/// Noise as a sum of independent sources of constant colour and variable level, such as a receiver's own noise and
/// intermittent wind:
///
///   B(t, f) = Σ_k P_k(t)·a_k(f),  y(t, f)/B(t, f) exponential of mean 1
///
/// Fitted by maximum likelihood, which minimises the Itakura-Saito divergence, with multiplicative updates
///
///   P_k ← P_k·Σ_f a_k min(y, cB)/B² / Σ_f a_k/B,  and for a_k likewise over t.
///
/// A running median over ±half cells is applied to colours in each iteration, so that no line becomes part of a colour,
/// except near their steep edges, which it would move. Sources are initialised with the frames that differ most from
/// one another. Source: Févotte, Bertin and Durrieu 2009, Nonnegative matrix factorization with the Itakura-Saito
/// divergence, section 3.
struct NoiseSources {
    Index cells = 0;
    std::vector<float> colours; ///< sources × cells

    Index count() const { return cells > 0 ? std::ssize(colours) / cells : 0; }

    /// The sources' levels in a frame that is near 1 somewhere; all 0 in digital silence.
    std::vector<float> levelsIn(std::span<const float> frame) const;

    /// B of a frame from its source levels.
    void addUp(std::span<const float> levels, std::span<float> out) const;
};

/// Fits `count` sources to frames (frames × cells) whose cells are of similar magnitude where nothing changes.
NoiseSources fitSources(std::span<const float> frames, Index cells, Index count, Index half);

} // namespace faintline
