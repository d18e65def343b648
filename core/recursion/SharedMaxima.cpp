#include "recursion/SharedMaxima.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace faintline {

namespace {

    constexpr std::size_t sharedFromRates = 4; ///< number of rates from which sharing pays off

    template <class Real>
    using Shifts = std::vector<Shift<Real>>;

    template <class Real>
    bool isWorthSharing(const Shifts<Real> &shifts)
    {
        return shifts.size() >= sharedFromRates && std::all_of(shifts.begin(), shifts.end(), [&](const Shift<Real> &s) {
                   return s.weight == shifts.front().weight;
               });
    }

    /// Removes and returns the shifts that follow the first unused one, each two rates and one cell further.
    template <class Real>
    Shifts<Real> takeRun(const Shifts<Real> &all, std::size_t start, std::vector<bool> &used)
    {
        Shifts<Real> run{all[start]};
        for (std::size_t next = start + 1; next < all.size(); ++next)
            if (!used[next] && all[next].from == run.back().from + 2 && all[next].cells == run.back().cells + 1) {
                run.push_back(all[next]);
                used[next] = true;
            }
        return run;
    }

    /// The required maxima and their shifts.
    class Wanted
    {
    public:
        explicit Wanted(Index rates)
            : m_rates(rates), m_maxima(std::size_t(2 * rates), {-1, 0, 0, 0, 0, 0}), m_isMade(m_maxima.size(), false)
        {
        }

        Index ofTwo(Index rate, Index shift)
        {
            want({m_rates + rate, rate, rate + 2, 1, shift, shift});
            return m_rates + rate;
        }

        Index ofFour(Index rate, Index shift)
        {
            ofTwo(rate, shift);
            ofTwo(rate + 4, shift + 2);
            want({2 * m_rates + rate, m_rates + rate, m_rates + rate + 4, 2, shift, shift});
            return 2 * m_rates + rate;
        }

        /// Lists a maximum, preceded by its operands, unless it is already listed.
        void make(Index number, std::vector<SharedMaximum> &list)
        {
            if (number < m_rates || m_isMade[std::size_t(number - m_rates)])
                return;
            const SharedMaximum &maximum = m_maxima[std::size_t(number - m_rates)];
            make(maximum.of, list);
            make(maximum.other, list);
            m_isMade[std::size_t(number - m_rates)] = true;
            list.push_back(maximum);
        }

        std::vector<Index> largestShifts() const
        {
            std::vector<Index> largest;
            for (const SharedMaximum &maximum : m_maxima)
                largest.push_back(maximum.largest);
            return largest;
        }

    private:
        void want(const SharedMaximum &at)
        {
            SharedMaximum &maximum = m_maxima[std::size_t(at.number - m_rates)];
            const bool isNew = maximum.number < 0;
            const Index smallest = isNew ? at.smallest : std::min(maximum.smallest, at.smallest);
            const Index largest = isNew ? at.largest : std::max(maximum.largest, at.largest);
            maximum = {at.number, at.of, at.other, at.back, smallest, largest};
        }

        Index m_rates;
        std::vector<SharedMaximum> m_maxima;
        std::vector<bool> m_isMade;
    };

    template <class Real>
    Shifts<Real> replaced(const Shifts<Real> &all, Wanted &wanted)
    {
        Shifts<Real> result;
        std::vector<bool> used(all.size(), false);
        for (std::size_t start = 0; start < all.size(); ++start) {
            if (used[start])
                continue;
            const Shifts<Real> run = takeRun(all, start, used);
            const std::size_t length = run.size() >= 4 ? 4 : run.size() >= 2 ? 2 : 1;
            for (std::size_t at = 0; at < run.size(); at += length) {
                const Shift<Real> &begin = run[std::min(at, run.size() - length)];
                Index from = begin.from;
                if (length > 1)
                    from = length == 4 ? wanted.ofFour(begin.from, begin.cells) : wanted.ofTwo(begin.from, begin.cells);
                result.push_back({from, begin.cells, begin.weight});
            }
        }
        return result;
    }

} // namespace

Index SharedMaxima::longestSpan() const
{
    Index longest = 0;
    for (const std::vector<SharedMaximum> &maxima : before)
        for (const SharedMaximum &maximum : maxima)
            longest = std::max(longest, maximum.largest - maximum.smallest);
    return longest;
}

template <class Real>
SharedMaxima shareMaxima(AxisStep<Real> &step, bool keepsAll)
{
    const Index rates = std::ssize(step.shifts);
    Wanted wanted(rates);
    std::vector<Shifts<Real>> all = step.shifts;
    for (Shifts<Real> &shifts : all)
        if (isWorthSharing(shifts))
            shifts = replaced(shifts, wanted);
    SharedMaxima result;
    result.before.resize(std::size_t(rates));
    bool isAny = false;
    for (std::size_t rate = 0; rate < all.size(); ++rate) { // just before the first target that uses it
        for (const Shift<Real> &shift : all[rate])
            wanted.make(shift.from, result.before[rate]);
        isAny = isAny || !result.before[rate].empty();
    }
    if (!isAny)
        return result;
    result.largest = wanted.largestShifts();
    for (std::size_t rate = 0; rate < all.size(); ++rate)
        for (const Shift<Real> &shift : step.shifts[rate])
            result.ring = std::max(result.ring, 2 * std::abs(shift.from - Index(rate)) + 1);
    if (keepsAll)
        result.ring = rates;
    step.shifts = std::move(all);
    return result;
}

template SharedMaxima shareMaxima(AxisStep<float> &, bool);
template SharedMaxima shareMaxima(AxisStep<double> &, bool);

} // namespace faintline
