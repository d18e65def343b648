#include "spectrum/cellAveraging.h"

#include <algorithm>
#include <vector>

namespace faintline {

void averageCells(std::span<float> y, Index row, Index N)
{
    std::vector<double> sums(static_cast<std::size_t>(row + 1), 0.0);
    for (std::size_t first = 0; first + static_cast<std::size_t>(row) <= y.size(); first += static_cast<std::size_t>(row)) {
        float *cells = y.data() + first;
        for (Index i = 0; i < row; ++i)
            sums[static_cast<std::size_t>(i + 1)] = sums[static_cast<std::size_t>(i)] + static_cast<double>(cells[i]);
        for (Index i = 0; i < row; ++i) {
            const Index begin = std::clamp<Index>(i - N / 2, 0, row - N - 1);
            const double reference = (sums[static_cast<std::size_t>(begin + N + 1)] - sums[static_cast<std::size_t>(begin)] - static_cast<double>(cells[i]))
                                     / static_cast<double>(N);
            cells[i] = reference > 0.0 ? static_cast<float>(static_cast<double>(cells[i]) / reference) : 0.0f;
        }
    }
}

} // namespace faintline
