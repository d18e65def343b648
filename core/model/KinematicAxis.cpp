#include "model/KinematicAxis.h"

#include "base/Error.h"
#include "base/Field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace faintline {

namespace {

    int meanRate(int sum, Rounding rounding)
    {
        if (rounding == Rounding::Trunc)
            return sum / 2;
        return sum >= 0 ? sum / 2 : -((1 - sum) / 2);
    }

    Index floorOfQuotient(Index numerator, Index denominator)
    {
        const Index quotient = numerator / denominator;
        return numerator % denominator < 0 ? quotient - 1 : quotient;
    }

    /// Cells that k/q cells a step make in step number t: ⌊k(t + 1)/q + ½⌋ - ⌊k·t/q + ½⌋.
    int displacementInStep(int k, int q, Index t)
    {
        const auto reached = [&](Index steps) { return floorOfQuotient(2 * k * steps + q, 2 * q); };
        const Index phase = t % q;
        return static_cast<int>(reached(phase + 1) - reached(phase));
    }

    void checkProbability(double probability, const std::string &where)
    {
        if (!(probability >= 0.0 && probability <= 1.0))
            throw Error(where, "holds " + formatNumber(probability) + "; a probability lies in 0 … 1");
    }

    void checkLaw(const std::vector<double> &law, const std::string &where)
    {
        if (law.empty())
            throw Error(where, "must hold at least one probability");
        double sum = -law.front();
        for (double probability : law) {
            checkProbability(probability, where);
            sum += 2.0 * probability;
        }
        if (std::abs(sum - 1.0) > 1e-6)
            throw Error(where, "h(0) + 2·(h(1) + h(2) + …) is " + formatNumber(sum) + "; it must be 1");
    }

    void checkMatrix(const std::vector<double> &matrix, Index cells, const std::string &where)
    {
        if (std::ssize(matrix) != cells * cells)
            throw Error(where, "must hold as many rows and columns as the axis has cells, " + std::to_string(cells));
        for (Index from = 0; from < cells; ++from) {
            double sum = 0.0;
            for (Index to = 0; to < cells; ++to) {
                const double probability = matrix[static_cast<std::size_t>(from * cells + to)];
                checkProbability(probability, where);
                sum += probability;
            }
            if (!(sum < 1.0 + 1e-6)) // less is allowed: what leaves the axis
                throw Error(where, "row " + std::to_string(from) + " adds up to " + formatNumber(sum) + "; it must be at most 1");
        }
    }

} // namespace

std::vector<KinematicAxis::Move> KinematicAxis::moves(Index number) const
{
    std::vector<Move> result;
    if (!step.empty()) {
        const int reach = static_cast<int>(step.size()) - 1;
        for (int delta = reach; delta >= -reach; --delta)
            if (const double p = step[static_cast<std::size_t>(std::abs(delta))]; p > 0.0)
                result.push_back({0, 0, delta, std::log(p)});
        return result;
    }
    const int reach = static_cast<int>(rateChange.size()) - 1;
    for (int to = 0; to < rateCount; ++to)
        for (int from = std::max(0, to - reach); from <= std::min(rateCount - 1, to + reach); ++from)
            if (const double p = rateChange[static_cast<std::size_t>(std::abs(to - from))]; p > 0.0)
                result.push_back({from, to,
                                  ratesPerCell == 1 ? meanRate(2 * firstRate + from + to, rounding)
                                                    : displacementInStep(firstRate + to, ratesPerCell, number),
                                  std::log(p)});
    return result;
}

double KinematicAxis::lnDeparture(Index fromCell) const
{
    if (!renormalised)
        return 0.0;
    double sum = 0.0;
    for (Index delta = 1 - std::ssize(step); delta < std::ssize(step); ++delta)
        if (cyclic || (fromCell + delta >= 0 && fromCell + delta < cells))
            sum += step[static_cast<std::size_t>(std::abs(delta))];
    return -std::log(sum);
}

int KinematicAxis::largestDisplacement() const
{
    if (!transition.empty())
        return static_cast<int>(cells - 1);
    int largest = 0;
    for (Index number = 0; number < phaseCount(); ++number)
        for (const Move &move : moves(number))
            largest = std::max(largest, std::abs(move.cells));
    return largest;
}

void KinematicAxis::check(const std::string &where) const
{
    if (cells < 1)
        throw Error(where + ".cells", "must be at least 1");
    if (rateCount < 1 || rateCount > 1001)
        throw Error(where + ".rates", "must hold 1 … 1001 consecutive integers");
    if (ratesPerCell < 1 || ratesPerCell > 64)
        throw Error(where + ".ratesPerCell", "must lie in 1 … 64");
    if (!step.empty() && rateCount > 1)
        throw Error(where, "has both rates and a step law; a random walk has no rates");
    if (!transition.empty()) {
        if (!step.empty() || rateCount > 1 || cyclic)
            throw Error(where, "has a transition matrix, which says all of its moves: no rates, no step law, not cyclic");
        checkMatrix(transition, cells, where + ".transition");
    }
    if (renormalised) {
        if (step.empty() || !(step.front() > 0.0))
            throw Error(where + ".step", "must let a target stay, q(0) > 0, where the ends of the axis share out what would leave it");
        for (const double probability : step)
            checkProbability(probability, where + ".step");
        if (cyclic && 2 * std::ssize(step) - 1 > cells)
            throw Error(where + ".step", "reaches the same cell both ways round a cyclic axis of " + std::to_string(cells));
    } else if (step.empty()) {
        checkLaw(rateChange, where + ".rateChange");
    } else {
        checkLaw(step, where + ".step");
    }
    if (cyclic && largestDisplacement() >= cells)
        throw Error(where, "a step of " + std::to_string(largestDisplacement()) + " cells goes round a cyclic axis of "
                               + std::to_string(cells));
}

std::vector<double> gaussianStep(double deviation, Index cells)
{
    std::vector<double> step{1.0};
    if (!(deviation > 0.0))
        return step;
    if (std::isinf(deviation))
        return std::vector<double>(static_cast<std::size_t>(cells), 1.0);
    const double scale = 1.0 / (deviation * std::numbers::sqrt2);
    step.front() = std::erf(0.5 * scale);
    for (Index d = 1; d < cells; ++d) {
        const auto distance = static_cast<double>(d);
        const double q = 0.5 * (std::erfc((distance - 0.5) * scale) - std::erfc((distance + 0.5) * scale));
        if (q < 1e-17 * step.front())
            break;
        step.push_back(q);
    }
    return step;
}

} // namespace faintline
