#include "recording/alignFiles.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/utc.h"
#include "recording/Stretches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faintline {

namespace {

    constexpr double clockError = 200e-6; ///< of a crystal, relative
    constexpr double leastResolution = 0.01;
    constexpr double exactness = 1e-4;    ///< of stamps that count samples, s
    constexpr double leastScatter = 1e-3; ///< of stamps set by a program

    /// Files that follow one another without a gap.
    struct Run {
        std::vector<std::size_t> files;
        std::vector<double> before; ///< samples of the run before each
        double startUnixSeconds = 0.0;
    };

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
            const bool areWhole = std::all_of(m_files.begin(), m_files.end(), [](const TimedFile &file) {
                return file.startUnixSeconds == std::floor(file.startUnixSeconds);
            });
            m_resolution = areWhole && m_files.size() > 1 ? 1.0 : leastResolution;
            m_areExact =
                std::all_of(m_files.begin(), m_files.end(), [](const TimedFile &file) { return file.isExact; });
            findRuns();
            fitClock();
            m_result.startUnixSeconds = m_runs.front().startUnixSeconds;
            for (const Run &run : m_runs)
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
            for (const std::size_t next : m_order) {
                const TimedFile &now = file(next);
                if (!m_runs.empty()) {
                    Run &run = m_runs.back();
                    const TimedFile &last = file(run.files.back());
                    const double lasts = double(last.samples) / m_nominalHz;
                    const double late = now.startUnixSeconds - last.startUnixSeconds - lasts;
                    if (std::abs(late) <= (m_areExact ? exactness : m_resolution + clockError * lasts)) {
                        run.before.push_back(run.before.back() + double(last.samples));
                        run.files.push_back(next);
                        continue;
                    }
                    if (late > Stretches::longestSeconds)
                        throw Error(now.path, "begins " + formatNumber(std::round(late / 86400.0)) + " days after "
                                                  + last.path
                                                  + " ends, more than the 400 days that a timeline can bridge; check "
                                                    "the recorder's clock");
                }
                m_runs.push_back({{next}, {0.0}, 0.0});
            }
        }

        /// Stamp of a run's file minus the duration of the samples before it.
        double startBy(const Run &run, std::size_t i, double rateHz) const
        {
            return file(run.files[i]).startUnixSeconds - m_epoch - run.before[i] / rateHz;
        }

        double meanStart(const Run &run, double rateHz) const
        {
            double sum = 0.0;
            for (std::size_t i = 0; i < run.files.size(); ++i)
                sum += startBy(run, i, rateHz);
            return sum / double(run.files.size());
        }

        /// Fits the deviation of the sample interval from its nominal value, s, and its standard error.
        void fitClock()
        {
            m_epoch = file(m_order.front()).startUnixSeconds; // doubles resolve seconds since 1970 to a microsecond
            double squares = 0.0;
            double products = 0.0;
            for (const Run &run : m_runs) {
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
            m_result.rateHz = std::abs(longer) > certain * error ? corrected : m_nominalHz;
            for (Run &run : m_runs)
                run.startUnixSeconds = m_epoch + meanStart(run, m_result.rateHz);
        }

        double scatter(double rateHz) const
        {
            double squares = 0.0;
            for (const Run &run : m_runs) {
                const double mean = meanStart(run, rateHz);
                for (std::size_t i = 0; i < run.files.size(); ++i)
                    squares += std::pow(startBy(run, i, rateHz) - mean, 2.0);
            }
            const double freedom = double(m_files.size()) - double(m_runs.size()) - 1.0;
            const double measured = freedom > 0.0 ? std::sqrt(squares / freedom) : 0.0;
            const double byResolution = m_resolution > leastResolution ? m_resolution / std::sqrt(12.0) : leastScatter;
            return std::max(byResolution, measured);
        }

        Index end() const
        {
            return m_result.places.empty() ? 0 : m_result.places.back().inTime + m_result.places.back().count;
        }

        void place(const Run &run)
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
            for (const Run &run : m_runs) {
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
            if (rate != m_nominalHz)
                notes.push_back("The sample rate is that of the time stamps, " + formatNumber(rate)
                                + " Hz: the clock of the files, " + formatNumber(m_nominalHz) + " Hz, is off by "
                                + formatNumber(std::round(1e7 * (rate / m_nominalHz - 1.0)) / 10.0) + " ppm.");
            if (const double worst = farthest(); worst > leastResolution)
                notes.push_back("Consecutive files lie within " + milliseconds(worst) + " of their time stamps.");
        }

        const std::vector<TimedFile> &m_files;
        std::vector<std::size_t> m_order;
        std::vector<Run> m_runs;
        double m_epoch = 0.0;
        double m_nominalHz = 0.0;
        double m_resolution = 0.0;
        bool m_areExact = false;
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
