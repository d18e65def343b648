#include "app/features/sequential/sequentialBars.h"

#include "app/base/tr.h"
#include "app/features/sequential/SequentialTests.h"

#include <QCoreApplication>

#include <algorithm>

namespace faintline {

std::vector<BarPlot::Series> stoppingBars(const SequentialTests &tests)
{
    std::vector<BarPlot::Series> series{{tr("H0, noise only"), 0, {}}, {tr("H1, a target"), 1, {}}};
    Index longest = 0;
    for (const auto &[run, result] : tests.walks())
        longest = std::max(longest, result.stages);
    if (!tests.isOfScans())
        longest = 0; // a single test has no histogram
    for (BarPlot::Series &one : series)
        one.values.assign(std::size_t(longest), 0.0);
    if (longest > 0)
        for (const auto &[run, result] : tests.walks())
            series[run.hasTarget ? 1 : 0].values[std::size_t(result.stages - 1)] += 1.0;
    return series;
}

std::vector<BarPlot::Series> sectorBars(const SequentialTests &tests)
{
    const ScanTest &test = tests.test();
    std::vector<BarPlot::Series> series{{tr("empty"), 0, {}}, {tr("with a target"), 1, {}}};
    if (tests.sectorRounds()) {
        for (BarPlot::Series &one : series)
            one.values.assign(std::size_t(test.sectors), 0.0);
        for (const SectorVisit &visit : tests.sectorRounds()->visits)
            series[holdsTarget(test, visit.sector) ? 1 : 0].values[std::size_t(visit.sector)] +=
                double(visit.result.stages) / test.rounds;
    }
    return series;
}

} // namespace faintline
