#pragma once

#include "detect/Smd.h"

#include <vector>

namespace faintline {

/// Several motion models in parallel, with one sequential Markov detector each.
///
///   D(t, cell) = max_i [ D_i(t, cell) - o_i ],   o_i = T_i - T
///
/// T_i is the threshold at which model i alone has the wanted false-alarm probability, and T that of the bank: the bank
/// crosses T when model i crosses T_i. With m models the bank's false-alarm probability lies between one model's and m
/// times it. Decision: D > T. Ties go to the first model. Source: Parsons 2008, section 5 ("the use of multiple target
/// manoeuvre models in parallel"). Oracle: its members run alone. Cost and memory: the sum of the members'.
class ModelBank final : public PathDetector
{
public:
    struct Member {
        MarkovModel model;
        ResetRule reset;
        double offset = 0.0; ///< o_i, nat
    };

    /// Needs at least one member; all on the same cells. Throws Error.
    explicit ModelBank(const std::vector<Member> &members);

    void update(std::span<const float> y, std::span<float> statistic) override;
    void forget(const Grid &grid, const CellBox &box) override;
    void inhibit(std::span<const Index> cells) override;
    void useThreads(int threads) override;

    std::size_t modelCount() const override { return m_detectors.size(); }
    std::span<const float> scores(std::size_t model = 0) const override { return m_detectors[model].scores(); }
    double offset(std::size_t model = 0) const override { return m_detectors[model].offset(); }
    Regulation regulation(std::size_t model = 0) const override { return m_detectors[model].regulation(); }

    std::shared_ptr<const DetectorState> state() const override;
    void setState(const DetectorState &state) override;

    std::size_t winnerAt(Index cell) const override { return m_winners[std::size_t(cell)]; }

private:
    struct BankState;

    std::vector<Smd> m_detectors;
    std::vector<float> m_offsets;
    std::vector<unsigned char> m_winners; ///< for each cell, in the last frame
    std::vector<float> m_own;             ///< statistic of a member
};

} // namespace faintline
