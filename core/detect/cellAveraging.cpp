#include "detect/cellAveraging.h"

#include "base/fastmath.h"
#include "base/multiversion.h"

#include <algorithm>
#include <vector>

namespace faintline {

namespace {

    FAINTLINE_MULTIVERSION
    void divideByNeighbours(float *cells, const double *sums, Index count, double N)
    {
        for (Index i = 0; i < count; ++i) {
            const double value = double(cells[i]);
            const double neighbours = sums[i] - value;
            const double ratio = N * value / neighbours;
            cells[i] = float(neighbours > 0.0 ? ratio : 0.0);
        }
    }

} // namespace

void averageCells(std::span<float> y, Index row, Index N)
{
    std::vector<double> until(std::size_t(row + 1), 0.0);
    std::vector<double> sums(static_cast<std::size_t>(row));
    for (Index first = 0; first + row <= std::ssize(y); first += row) {
        float *cells = y.data() + first;
        for (Index i = 0; i < row; ++i)
            until[std::size_t(i + 1)] = until[std::size_t(i)] + double(cells[i]);
        for (Index i = 0; i < row; ++i) {
            const auto begin = std::size_t(std::clamp<Index>(i - N / 2, 0, row - N - 1));
            sums[std::size_t(i)] = until[begin + std::size_t(N + 1)] - until[begin];
        }
        divideByNeighbours(cells, sums.data(), row, double(N));
    }
}

FAINTLINE_MULTIVERSION
void correctAveraged(std::span<float> t, Index N, double snr)
{
    const auto n = float(N);
    const auto factor = float((double(N) + 1.0) * (1.0 + snr) / snr);
    const auto slope = 1.0f / n;
    const auto targetSlope = float(1.0 / (double(N) * (1.0 + snr)));
    for (float &value : t)
        value = factor * fastLn((1.0f + slope * value) / (1.0f + targetSlope * value));
}

} // namespace faintline
