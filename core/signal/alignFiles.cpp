#include "signal/Timeline.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/utc.h"
#include "signal/Stretches.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace faintline {

namespace {

    constexpr double clockError = 200e-6; ///< of a crystal, relative
    constexpr double leastResolution = 0.01;
    constexpr double exactness = 1e-4;    ///< of stamps that count samples, s
    constexpr double leastScatter = 1e-3; ///< of stamps set by a program

    /// Files that follow one another without a gap.
    struct FileRun {
        std::vector<std::size_t> files;
        std::vector<double> before; ///< samples of the run before each
        double startUnixSeconds = 0.0;
    };

    /// Files of which each begins about where the previous one ends.
    struct Chain {
        std::vector<std::size_t> files;
        std::vector<double> seconds; ///< of all files before each, by the nominal rate
        std::vector<double> late;    ///< of each stamp behind the end of the files before it
    };

    /// Deviations from a straight line through the origin.
    struct Deviations {
        double slope = 0.0;
        double least = 0.0;
        double most = 0.0;

        double range() const { return most - least; }
    };

    Deviations deviationsFrom(double slope, std::span<const double> x, std::span<const double> y)
    {
        Deviations deviations{slope, y[0] - slope * x[0], y[0] - slope * x[0]};
        for (std::size_t i = 1; i < x.size(); ++i) {
            deviations.least = std::min(deviations.least, y[i] - slope * x[i]);
            deviations.most = std::max(deviations.most, y[i] - slope * x[i]);
        }
        return deviations;
    }

    /// Of the slope between `low` and `high` from which they have the least range.
    Deviations leastDeviations(std::span<const double> x, std::span<const double> y, double low, double high)
    {
        constexpr int divisions = 60; // the range is a convex function of the slope
        for (int i = 0; i < divisions; ++i) {
            const double third = (high - low) / 3.0;
            if (deviationsFrom(low + third, x, y).range() <= deviationsFrom(high - third, x, y).range())
                high -= third;
            else
                low += third;
        }
        return deviationsFrom(0.5 * (low + high), x, y);
    }

    /// Probability that the range of `count` numbers, uniform between 0 and 1, exceeds `range`.
    double exceedance(double range, std::size_t count)
    {
        if (range >= 1.0)
            return 0.0;
        const double n = double(count);
        return 1.0 - n * std::pow(range, n - 1.0) + (n - 1.0) * std::pow(range, n);
    }

    std::string milliseconds(double seconds)
    {
        return formatNumber(std::round(1e3 * seconds) / 1e3) + " s";
    }

    class Aligner
    {
    public:
        explicit Aligner(const std::vector<TimedFile> &files) : m_files(files), m_order(files.size())
        {
            std::iota(m_order.begin(), m_order.end(), std::size_t(0));
            std::stable_sort(m_order.begin(), m_order.end(), [&](std::size_t a, std::size_t b) {
                return files[a].startUnixSeconds < files[b].startUnixSeconds;
            });
        }

        Alignment align()
        {
            checkRates();
            m_areExact =
                std::all_of(m_files.begin(), m_files.end(), [](const TimedFile &file) { return file.isExact; });
            m_areWhole = !m_areExact && m_files.size() > 1
                         && std::all_of(m_files.begin(), m_files.end(), [](const TimedFile &file) {
                                return !file.hasFraction && file.startUnixSeconds == std::floor(file.startUnixSeconds);
                            });
            m_resolution = m_areWhole ? 1.0 : leastResolution;
            findRuns();
            fitClock();
            m_result.startUnixSeconds = m_runs.front().startUnixSeconds;
            for (const FileRun &run : m_runs)
                place(run);
            tell();
            return std::move(m_result);
        }

    private:
        const TimedFile &file(std::size_t number) const { return m_files[number]; }

        void checkRates()
        {
            const TimedFile &first = file(m_order.front());
            for (const TimedFile &other : m_files)
                if (!(std::abs(other.rateHz / first.rateHz - 1.0) <= clockError))
                    throw Error(other.path, "has " + formatNumber(other.rateHz) + " samples per second, but "
                                                + first.path + " has " + formatNumber(first.rateHz)
                                                + "; files of one timeline must have the same rate");
            std::vector<double> rates;
            for (const TimedFile &each : m_files)
                rates.push_back(each.rateHz);
            std::nth_element(rates.begin(), rates.begin() + std::ssize(rates) / 2, rates.end());
            m_nominalHz = rates[rates.size() / 2];
        }

        void findRuns()
        {
            m_epoch = file(m_order.front()).startUnixSeconds; // doubles resolve seconds since 1970 to a microsecond
            for (const TimedFile &each : m_files)
                m_stamps.push_back(each.startUnixSeconds - m_epoch);
            Chain chain;
            for (const std::size_t next : m_order) {
                if (!chain.files.empty() && !isNear(chain, next)) {
                    divide(chain);
                    chain = {};
                }
                const double before = chain.files.empty() ? 0.0 : chain.seconds.back() + secondsOf(chain.files.back());
                const double first = m_stamps[chain.files.empty() ? next : chain.files.front()];
                chain.files.push_back(next);
                chain.seconds.push_back(before);
                chain.late.push_back(m_stamps[next] - first - before);
            }
            divide(chain);
        }

        double secondsOf(std::size_t number) const { return double(file(number).samples) / m_nominalHz; }

        double tolerance() const { return m_areExact ? exactness : m_resolution; }

        /// By how much two stamps of files without a pause may err by a program's delays, s.
        double jitter(double lasts) const { return m_areExact ? 0.0 : std::min(0.1, 2e-3 * lasts); }

        /// Whether a file begins about where a chain ends, so that the other files must tell if it follows on.
        bool isNear(const Chain &chain, std::size_t next) const
        {
            const std::size_t last = chain.files.back();
            const double lasts = secondsOf(last);
            const double late = m_stamps[next] - m_stamps[last] - lasts;
            if (late > Stretches::longestSeconds)
                throw Error(file(next).path, "begins " + formatNumber(std::round(late / 86400.0)) + " days after "
                                                 + file(last).path
                                                 + " ends, more than the 400 days that a timeline can bridge; check "
                                                   "the recorder's clock");
            if (m_areExact)
                return std::abs(late) <= exactness;
            return std::abs(late) <= 2.0 * (m_resolution + jitter(lasts)) + clockError * lasts;
        }

        /// Whether some files of a chain follow on: their stamps differ from a straight line as stamps do.
        bool isContinuous(const Chain &chain, std::size_t first, std::size_t count) const
        {
            if (count < 2)
                return true;
            // The fewer whole seconds there are, the less they tell of a clock.
            const double slope = clockError * (m_areWhole ? 1.0 - 2.0 / double(count) : 1.0);
            const double range = leastDeviations(std::span(chain.seconds).subspan(first, count),
                                                 std::span(chain.late).subspan(first, count), -slope, slope)
                                     .range();
            if (range <= tolerance() && !m_areWhole)
                return true;
            if (range > tolerance() + jitter(secondsOf(chain.files[first])))
                return false;
            constexpr double rare = 0.01;
            return isToAndFro(chain, first, count) || (m_areWhole && exceedance(range, count) > rare);
        }

        /// Whether files are late as well as early: delays of a program, since no recorder hears a second twice.
        bool isToAndFro(const Chain &chain, std::size_t first, std::size_t count) const
        {
            bool isLate = false;
            bool isEarly = false;
            for (std::size_t i = first + 1; i < first + count; ++i) {
                const double late = chain.late[i] - chain.late[i - 1];
                isLate = isLate || late > 0.9 * tolerance();
                isEarly = isEarly || late < -0.9 * tolerance();
            }
            return isLate && isEarly;
        }

        /// Adds a chain as runs: one if its files follow on, else as few as possible, or its files if they begin
        /// regularly.
        void divide(const Chain &chain)
        {
            const std::size_t size = chain.files.size();
            std::vector<FileRun> runs;
            for (std::size_t first = 0; first < size;) {
                const std::size_t count = longestRun(chain, first);
                runs.push_back(runOf(chain, first, count));
                first += count;
            }
            m_isPaused = m_isPaused || runs.size() > 1;
            if (runs.size() > 2 && setRegularStarts(chain)) {
                runs.clear();
                for (std::size_t i = 0; i < size; ++i)
                    runs.push_back(runOf(chain, i, 1));
            }
            m_runs.insert(m_runs.end(), runs.begin(), runs.end());
        }

        std::size_t longestRun(const Chain &chain, std::size_t first) const
        {
            const std::size_t all = chain.files.size() - first;
            if (isContinuous(chain, first, all))
                return all;
            std::size_t whole = 1;
            while (isContinuous(chain, first, std::min(2 * whole, all)))
                whole *= 2;
            std::size_t broken = std::min(2 * whole, all);
            while (broken - whole > 1) {
                const std::size_t middle = whole + (broken - whole) / 2;
                (isContinuous(chain, first, middle) ? whole : broken) = middle;
            }
            return whole;
        }

        FileRun runOf(const Chain &chain, std::size_t first, std::size_t count) const
        {
            FileRun run;
            double samples = 0.0;
            for (std::size_t i = first; i < first + count; ++i) {
                run.files.push_back(chain.files[i]);
                run.before.push_back(samples);
                samples += double(file(chain.files[i]).samples);
            }
            return run;
        }

        /// Moves the stamps of a chain's files to a straight line over their numbers, if they lie about it as stamps
        /// do: a recorder that begins a file of the same length at equal intervals. Whole seconds are truncated ones.
        bool setRegularStarts(const Chain &chain)
        {
            const std::size_t size = chain.files.size();
            const Index samples = file(chain.files.front()).samples;
            if (!std::all_of(chain.files.begin(), chain.files.end() - 1,
                             [&](std::size_t number) { return file(number).samples == samples; }))
                return false;
            std::vector<double> numbers(size);
            std::iota(numbers.begin(), numbers.end(), 0.0);
            std::vector<double> stamps;
            for (const std::size_t each : chain.files)
                stamps.push_back(m_stamps[each]);
            const double most = tolerance() + jitter(secondsOf(chain.files.front()));
            const double interval = (stamps.back() - stamps.front()) / double(size - 1);
            const double aside = most / double(size - 1);
            const Deviations late = leastDeviations(numbers, stamps, interval - aside, interval + aside);
            if (late.range() > most)
                return false;
            const double start = m_areWhole ? late.most : 0.5 * (late.least + late.most);
            for (std::size_t i = 0; i < size; ++i)
                m_stamps[chain.files[i]] = start + late.slope * double(i);
            return true;
        }

        /// Stamp of a run's file minus the duration of the samples before it.
        double startBy(const FileRun &run, std::size_t i, double rateHz) const
        {
            return m_stamps[run.files[i]] - run.before[i] / rateHz;
        }

        double meanStart(const FileRun &run, double rateHz) const
        {
            double sum = 0.0;
            for (std::size_t i = 0; i < run.files.size(); ++i)
                sum += startBy(run, i, rateHz);
            return sum / double(run.files.size());
        }

        /// Fits the deviation of the sample interval from its nominal value, s, and its standard error.
        void fitClock()
        {
            double squares = 0.0;
            double products = 0.0;
            for (const FileRun &run : m_runs) {
                const double mean = meanStart(run, m_nominalHz);
                const double meanBefore =
                    std::accumulate(run.before.begin(), run.before.end(), 0.0) / double(run.before.size());
                for (std::size_t i = 0; i < run.files.size(); ++i) {
                    squares += (run.before[i] - meanBefore) * (run.before[i] - meanBefore);
                    products += (run.before[i] - meanBefore) * (startBy(run, i, m_nominalHz) - mean);
                }
            }
            const double longer = squares > 0.0 ? products / squares : 0.0;
            const double corrected = 1.0 / (1.0 / m_nominalHz + longer);
            const double error = squares > 0.0 ? scatter(corrected) / std::sqrt(squares) : 0.0;
            constexpr double certain = 5.0;
            const bool isClock = !m_isPaused && std::abs(longer) * m_nominalHz <= clockError;
            m_result.rateHz = isClock && std::abs(longer) > certain * error ? corrected : m_nominalHz;
            for (FileRun &run : m_runs)
                run.startUnixSeconds = m_epoch + meanStart(run, m_result.rateHz);
        }

        double scatter(double rateHz) const
        {
            double squares = 0.0;
            for (const FileRun &run : m_runs) {
                const double mean = meanStart(run, rateHz);
                for (std::size_t i = 0; i < run.files.size(); ++i)
                    squares += std::pow(startBy(run, i, rateHz) - mean, 2.0);
            }
            const double freedom = double(m_files.size()) - double(m_runs.size()) - 1.0;
            const double measured = freedom > 0.0 ? std::sqrt(squares / freedom) : 0.0;
            constexpr double scatterMinimumFreedom = 3.0; // stamps that show their scatter
            const double byResolution = m_areExact                        ? leastScatter
                                        : freedom < scatterMinimumFreedom ? m_resolution / std::sqrt(12.0)
                                        : m_areWhole                      ? 1.0 / std::sqrt(12.0)
                                                                          : leastScatter;
            return std::max(byResolution, measured);
        }

        Index end() const
        {
            return m_result.places.empty() ? 0 : m_result.places.back().inTime + m_result.places.back().count;
        }

        void place(const FileRun &run)
        {
            const Index start = std::llround((run.startUnixSeconds - m_result.startUnixSeconds) * m_result.rateHz);
            const bool isFirst = m_result.places.empty();
            if (!isFirst && start > end()) {
                ++m_gaps;
                m_missing += start - end();
            }
            Index inTime = start;
            for (const std::size_t number : run.files) {
                const Index skipped = isFirst ? 0 : std::max<Index>(0, end() - inTime);
                if (skipped >= file(number).samples && !m_result.places.empty())
                    throw Error(file(number).path, "lies within the time of " + file(m_result.places.back().file).path
                                                       + "; a timeline has one recording at a time");
                if (skipped > 0) {
                    ++m_overlaps;
                    m_twice += skipped;
                }
                m_result.places.push_back({number, inTime + skipped, skipped, file(number).samples - skipped});
                inTime += file(number).samples;
            }
        }

        double farthest() const
        {
            double farthest = 0.0;
            for (const FileRun &run : m_runs) {
                const double mean = meanStart(run, m_result.rateHz);
                for (std::size_t i = 0; i < run.files.size(); ++i)
                    farthest = std::max(farthest, std::abs(startBy(run, i, m_result.rateHz) - mean));
            }
            return farthest;
        }

        void tell()
        {
            const double rate = m_result.rateHz;
            std::vector<std::string> &notes = m_result.notes;
            notes.push_back(std::to_string(m_files.size()) + " file(s) as one recording, from "
                            + formatUtc(m_result.startUnixSeconds) + " to "
                            + formatUtc(std::round(m_result.startUnixSeconds + double(end()) / rate)) + ".");
            if (m_gaps > 0)
                notes.push_back(std::to_string(m_gaps) + " gap(s) between files, "
                                + milliseconds(double(m_missing) / rate) + " altogether, are not observed.");
            if (m_overlaps > 0)
                notes.push_back(std::to_string(m_overlaps) + " file(s) begin before the previous one ends; "
                                + milliseconds(double(m_twice) / rate)
                                + " of duplicate samples are taken from the earlier one.");
            if (m_areWhole && m_gaps + m_overlaps > 0)
                notes.push_back("The time stamps are whole seconds: where these lie is uncertain by up to 1 s.");
            if (rate != m_nominalHz)
                notes.push_back("The sample rate is that of the time stamps, " + formatNumber(rate)
                                + " Hz: the clock of the files, " + formatNumber(m_nominalHz) + " Hz, is off by "
                                + formatNumber(std::round(1e7 * (rate / m_nominalHz - 1.0)) / 10.0) + " ppm.");
            if (const double worst = farthest(); worst > leastResolution)
                notes.push_back("Consecutive files lie within " + milliseconds(worst) + " of their time stamps.");
        }

        const std::vector<TimedFile> &m_files;
        std::vector<std::size_t> m_order;
        std::vector<FileRun> m_runs;
        std::vector<double> m_stamps; ///< of each file, s after m_epoch
        double m_epoch = 0.0;
        double m_nominalHz = 0.0;
        double m_resolution = 0.0;
        bool m_areExact = false;
        bool m_areWhole = false;
        bool m_isPaused = false; ///< files that nearly follow on do not
        Index m_gaps = 0, m_missing = 0;
        Index m_overlaps = 0, m_twice = 0;
        Alignment m_result;
    };

} // namespace

Alignment alignFiles(const std::vector<TimedFile> &files)
{
    return Aligner(files).align();
}

} // namespace faintline
