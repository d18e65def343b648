#pragma once

#include "analyse/analyse.h"
#include "bindings/interruptible.h"
#include "bindings/provenance.h"

#include <memory>
#include <vector>

namespace faintline::python {

/// Python object for a detection result. Whole arrays are computed on first access, and then kept.
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

    /// y of frames × cells. Throws Error if that is more than 2³¹ values.
    Values input(const RunOptions &options);
    /// D of frames × cells, by a second run of the detector, as the command line writes it with --statistic.
    Values statistic(const RunOptions &options);
    /// The same, frame by frame into a sink, if it does not fit into memory.
    void streamStatistic(const StatisticSink &sink, const RunContext &context) const;

private:
    std::size_t valueCount() const;

    std::shared_ptr<const Analysis> m_analysis;
    Origin m_origin;
    Values m_input;
    Values m_statistic;
};

} // namespace faintline::python
