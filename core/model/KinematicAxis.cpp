#include "model/KinematicAxis.h"

#include "base/Error.h"
#include "base/Field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

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

    /// Displacement of a rate of k/q cells per step in step number t: ⌊k(t + 1)/q + ½⌋ - ⌊k·t/q + ½⌋.
    int displacementInStep(int k, int q, Index t)
    {
        const auto reached = [&](Index steps) { return floorOfQuotient(2 * k * steps + q, 2 * q); };
        const Index phase = t % q;
        return int(reached(phase + 1) - reached(phase));
    }

    void checkProbability(double probability, const std::string &where)
    {
        if (!(probability >= 0.0 && probability <= 1.0))
            throw Error(where, "holds " + formatNumber(probability) + "; a probability must lie in 0 … 1");
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
            throw Error(where, "must have as many rows and columns as the axis has cells, " + std::to_string(cells));
        for (Index from = 0; from < cells; ++from) {
            double sum = 0.0;
            for (Index to = 0; to < cells; ++to) {
                const double probability = matrix[std::size_t(from * cells + to)];
                checkProbability(probability, where);
                sum += probability;
            }
            if (!(sum < 1.0 + 1e-6)) // less is allowed: probability that leaves the axis
                throw Error(where, "row " + std::to_string(from) + " adds up to " + formatNumber(sum)
                                       + "; it must be at most 1");
        }
    }

    /// A renormalised axis must have a move from each cell, with some rate.
    void checkWaysOn(const KinematicAxis &axis, const std::string &where)
    {
        const Index edge = axis.edgeCells();
        for (Index cell = 0; cell < axis.cells; ++cell) {
            if (cell > edge && cell < axis.cells - edge) { // same as the previous one
                cell = axis.cells - edge - 1;
                continue;
            }
            for (Index number = 0; number < axis.phaseCount(); ++number)
                if (!(axis.remaining(cell, axis.rateGoingOn(cell, 0, number), number) > 0.0))
                    throw Error(where, "let no target in this cell stay on the axis: " + std::to_string(cell)
                                           + "; a lossless law needs a transition from every cell");
        }
    }

} // namespace

std::vector<KinematicAxis::Move> KinematicAxis::moves(Index number) const
{
    std::vector<Move> result;
    if (!step.empty()) {
        const int reach = int(step.size()) - 1;
        for (int delta = reach; delta >= -reach; --delta)
            if (const double p = step[std::size_t(std::abs(delta))]; p > 0.0)
                result.push_back({0, 0, delta, std::log(p)});
        return result;
    }
    const int reach = int(rateChange.size()) - 1;
    for (int to = 0; to < rateCount; ++to)
        for (int from = std::max(0, to - reach); from <= std::min(rateCount - 1, to + reach); ++from)
            if (const double p = rateChange[std::size_t(std::abs(to - from))]; p > 0.0)
                result.push_back({from, to, displacement(from, to, number), std::log(p)});
    return result;
}

int KinematicAxis::displacement(int fromRate, int toRate, Index number) const
{
    return ratesPerCell == 1 ? meanRate(2 * firstRate + fromRate + toRate, rounding)
                             : displacementInStep(firstRate + toRate, ratesPerCell, number);
}

double KinematicAxis::remaining(Index fromCell, int fromRate, Index number) const
{
    const auto exists = [&](Index cell) { return cyclic || (cell >= 0 && cell < cells); };
    double sum = 0.0;
    if (!transition.empty()) {
        const auto row = transition.begin() + fromCell * cells;
        return std::accumulate(row, row + cells, 0.0);
    }
    if (!step.empty()) {
        for (Index delta = 1 - std::ssize(step); delta < std::ssize(step); ++delta)
            if (exists(fromCell + delta))
                sum += step[std::size_t(std::abs(delta))];
        return sum;
    }
    const int reach = int(rateChange.size()) - 1;
    for (int to = std::max(0, fromRate - reach); to <= std::min(rateCount - 1, fromRate + reach); ++to)
        if (exists(fromCell + displacement(fromRate, to, number)))
            sum += rateChange[std::size_t(std::abs(to - fromRate))];
    return sum;
}

int KinematicAxis::rateGoingOn(Index cell, int rate, Index number) const
{
    if (!renormalised || rateCount == 1)
        return rate;
    for (int apart = 0; apart < rateCount; ++apart)
        for (const int other : {rate - apart, rate + apart})
            if (other >= 0 && other < rateCount && remaining(cell, other, number) > 0.0)
                return other;
    return rate; // of an axis that check() rejects
}

double KinematicAxis::lnDeparture(Index fromCell, int fromRate, Index number) const
{
    return renormalised ? -std::log(remaining(fromCell, fromRate, number)) : 0.0;
}

Index KinematicAxis::edgeCells() const
{
    return cyclic ? 0 : std::min<Index>(largestDisplacement(), cells);
}

double KinematicAxis::largestLoss() const
{
    double largest = 0.0;
    if (renormalised)
        return largest;
    const bool isLaw = transition.empty();
    const Index edge = isLaw ? edgeCells() : cells;
    for (Index cell = 0; cell < cells; ++cell) {
        if (isLaw && cell > edge && cell < cells - edge) { // same as the previous one
            cell = cells - edge - 1;
            continue;
        }
        for (Index number = 0; number < phaseCount(); ++number)
            for (int from = 0; from < rateCount; ++from)
                largest = std::max(largest, std::abs(1.0 - remaining(cell, from, number)));
    }
    return largest;
}

KinematicAxis KinematicAxis::stochastic(const std::string &where) const
{
    constexpr double roundingError = 1e-14;
    KinematicAxis result = *this;
    if (largestLoss() <= roundingError)
        return result;
    if (!transition.empty()) {
        for (Index from = 0; from < cells; ++from) {
            const double sum = remaining(from);
            if (!(sum > 0.0))
                throw Error(where + ".transition", "row " + std::to_string(from)
                                                       + " contains only zeros, so a target "
                                                         "there cannot continue");
            for (Index to = 0; to < cells; ++to)
                result.transition[std::size_t(from * cells + to)] /= sum;
        }
        return result;
    }
    if (cyclic && !step.empty()) { // each way round counts separately
        const double sum = remaining(0);
        for (double &q : result.step)
            q /= sum;
        return result;
    }
    result.renormalised = true;
    result.check(where);
    return result;
}

int KinematicAxis::largestDisplacement() const
{
    if (!transition.empty())
        return int(cells - 1);
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
        throw Error(where, "has both rates and a step law; use rates or, for a random walk, a step law");
    if (!transition.empty()) {
        if (!step.empty() || rateCount > 1 || cyclic)
            throw Error(where, "has a transition matrix, so rates, a step law or cyclic cannot be given");
        checkMatrix(transition, cells, where + ".transition");
    }
    if (renormalised && !transition.empty())
        throw Error(where, "has a transition matrix, whose rows already define the losses at the edges");
    if (renormalised && step.empty()) {
        checkLaw(rateChange, where + ".rateChange");
        checkWaysOn(*this, where + ".rates");
    } else if (renormalised) {
        for (const double probability : step)
            checkProbability(probability, where + ".step");
        if (!(step.front() > 0.0))
            checkWaysOn(*this, where + ".step");
        if (cyclic && 2 * std::ssize(step) - 1 > cells)
            throw Error(where + ".step",
                        "reaches the same cell in both directions on a cyclic axis of " + std::to_string(cells));
    } else if (step.empty()) {
        checkLaw(rateChange, where + ".rateChange");
    } else {
        checkLaw(step, where + ".step");
    }
    if (cyclic && largestDisplacement() >= cells)
        throw Error(where, "a step of " + std::to_string(largestDisplacement())
                               + " cells wraps around a cyclic axis "
                                 "of "
                               + std::to_string(cells));
}

std::vector<double> gaussianStep(double deviation, Index cells)
{
    std::vector<double> step{1.0};
    if (!(deviation > 0.0))
        return step;
    if (std::isinf(deviation))
        return std::vector<double>(std::size_t(cells), 1.0);
    const double scale = 1.0 / (deviation * std::numbers::sqrt2);
    step.front() = std::erf(0.5 * scale);
    for (Index d = 1; d < cells; ++d) {
        const auto distance = double(d);
        const double q = 0.5 * (std::erfc((distance - 0.5) * scale) - std::erfc((distance + 0.5) * scale));
        if (q < 1e-17 * step.front())
            break;
        step.push_back(q);
    }
    return step;
}

} // namespace faintline
