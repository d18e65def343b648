#include "model/KinematicAxis.h"

#include "base/Error.h"
#include "base/Field.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    int meanRate(int sum, Rounding rounding)
    {
        if (rounding == Rounding::Trunc)
            return sum / 2;
        return sum >= 0 ? sum / 2 : -((1 - sum) / 2);
    }

    void checkLaw(const std::vector<double> &law, const std::string &where)
    {
        if (law.empty())
            throw Error(where, "must hold at least one probability");
        double sum = -law.front();
        for (double probability : law) {
            if (!(probability >= 0.0 && probability <= 1.0))
                throw Error(where, "holds " + formatNumber(probability) + "; a probability lies in 0 … 1");
            sum += 2.0 * probability;
        }
        if (std::abs(sum - 1.0) > 1e-6)
            throw Error(where, "h(0) + 2·(h(1) + h(2) + …) is " + formatNumber(sum) + "; it must be 1");
    }

} // namespace

std::vector<KinematicAxis::Move> KinematicAxis::moves() const
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
                result.push_back({from, to, meanRate(2 * firstRate + from + to, rounding), std::log(p)});
    return result;
}

int KinematicAxis::largestDisplacement() const
{
    int largest = 0;
    for (const Move &move : moves())
        largest = std::max(largest, std::abs(move.cells));
    return largest;
}

void KinematicAxis::check(const std::string &where) const
{
    if (cells < 1)
        throw Error(where + ".cells", "must be at least 1");
    if (rateCount < 1 || rateCount > 1001)
        throw Error(where + ".rates", "must hold 1 … 1001 consecutive integers");
    if (!step.empty() && rateCount > 1)
        throw Error(where, "has both rates and a step law; a random walk has no rates");
    if (step.empty())
        checkLaw(rateChange, where + ".rateChange");
    else
        checkLaw(step, where + ".step");
    if (cyclic && largestDisplacement() >= cells)
        throw Error(where, "a step of " + std::to_string(largestDisplacement()) + " cells goes round a cyclic axis of "
                               + std::to_string(cells));
}

} // namespace faintline
