#include "detect/averagedStages.h"

#include "base/Error.h"
#include "detect/cellAveraging.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    /// The last axis with a state: its number of cells and their stride in a frame.
    struct Row {
        Index cells = 0;
        Index stride = 1;
    };

    Row rowOf(const CellReduction &reduction)
    {
        Index stride = 1;
        for (std::size_t axis = reduction.axisCells().size(); axis-- > 0;) {
            if (!reduction.isFolded(axis))
                return {reduction.axisCells()[axis], stride};
            stride *= reduction.axisCells()[axis];
        }
        return {};
    }

} // namespace

StageSource averagedStages(StageSource source, const SequentialModel &model, Index N, const std::string &where)
{
    const Likelihood likelihood = model.markov.likelihood;
    if (likelihood.kind() != LikelihoodKind::Exponential)
        throw Error(where, "requires an exponential likelihood; no other likelihood of the average is implemented");
    const Row row = rowOf(model.reduction);
    if (N < 1 || N >= row.cells)
        throw Error(where + " = " + std::to_string(N),
                    row.cells < 2
                        ? "has no neighbours to average"
                        : "must lie in 1 … " + std::to_string(row.cells - 1) + ", the other cells of the row");
    return [source = std::move(source), where, row, N, snr = likelihood.snr(),
            line = std::vector<float>(std::size_t(row.cells))](Index stage, std::span<double> y) mutable {
        source(stage, y);
        if (std::any_of(y.begin(), y.end(), [](double value) { return std::isnan(value); }))
            throw Error(where, "averages neighbours and needs all cells; stage " + std::to_string(stage)
                                   + " has unobserved cells");
        const Index block = row.cells * row.stride;
        for (Index first = 0; first < std::ssize(y); ++first) {
            if (first % block >= row.stride) // not the first cell of a row
                continue;
            for (Index i = 0; i < row.cells; ++i)
                line[std::size_t(i)] = float(y[std::size_t(first + i * row.stride)]);
            averageCells(line, row.cells, N);
            correctAveraged(line, N, snr);
            for (Index i = 0; i < row.cells; ++i)
                y[std::size_t(first + i * row.stride)] = double(line[std::size_t(i)]);
        }
    };
}

} // namespace faintline
