#pragma once

#include "analysis/analyse.h"
#include "bindings/interruptible.h"
#include "bindings/provenance.h"

#include <memory>
#include <vector>

namespace faintline::python {

/// A detection as Python holds it. Whole arrays are made when they are first asked for, and then kept.
class Result
{
public:
    explicit Result(std::shared_ptr<const Analysis> analysis, Origin origin = {})
        : m_analysis(std::move(analysis)), m_origin(std::move(origin))
    {
    }

    const std::shared_ptr<const Analysis> &analysis() const { return m_analysis; }
    const Origin &origin() const { return m_origin; }

    using Values = std::shared_ptr<const std::vector<float>>;

    /// y of frames × cells. Throws Error where that is more than 2³¹ values.
    Values input(const RunOptions &options);
    /// D of frames × cells, by a second run of the detector: what the command line writes with --statistic.
    Values statistic(const RunOptions &options);
    /// The same, frame by frame into a sink: for who has no memory for all of it.
    void streamStatistic(const StatisticSink &sink, const RunContext &context) const;

private:
    std::size_t valueCount() const;

    std::shared_ptr<const Analysis> m_analysis;
    Origin m_origin;
    Values m_input;
    Values m_statistic;
};

} // namespace faintline::python
