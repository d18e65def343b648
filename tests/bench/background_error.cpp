// How far the noise background is off, in one recording without signals: mean and deviation of (mean of y in tiles) -
// 1, beside the deviation that counting alone gives white noise of known power.
//
//     faintline-background-error FILE [name=value …] [--dump PREFIX]
//
// A tile is 16 frames × 200 resolution cells, and others for comparison. --dump writes PREFIX.s.npy and PREFIX.y.npy,
// frames × bins.

#include "noise/NoiseNormaliser.h"
#include "plan/AnalysisSettings.h"
#include "signal/formats/NumPy.h"
#include "signal/openRecording.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <string>

using namespace faintline;

namespace {

constexpr Index leftOut = 6; ///< cells at both ends of the band, where real spectra overlap with their mirror image

/// |Σₙ w(n) w(n + i·hop) e^(2πikn/N)|²: how alike two values of white noise are, i frames and k bins apart.
double likeness(const std::vector<float> &window, Index shift, Index bins, Index length)
{
    std::complex<double> sum = 0.0;
    for (Index n = 0; n + shift < std::ssize(window); ++n) {
        const double phase = 2.0 * std::numbers::pi * double(bins * n % length) / double(length);
        sum += double(window[std::size_t(n)]) * double(window[std::size_t(n + shift)]) * std::polar(1.0, phase);
    }
    return std::norm(sum);
}

/// Standard deviation of the mean of a tile of exponentials.
double countingError(const Spectrogram &s, Index frames, Index bins)
{
    const std::vector<float> window = sampleWindow(s.settings().window, s.windowSamples());
    const auto reach = Index(std::ceil(4.0 * s.binsPerCell()));
    double sum = 0.0;
    for (Index i = 0; i < std::min<Index>(frames, s.settings().stepsPerWindow); ++i)
        for (Index k = 0; k <= std::min(reach, bins - 1); ++k)
            sum += likeness(window, i * s.hopSamples(), k, s.transformLength()) * (i > 0 ? 2.0 : 1.0)
                   * (k > 0 ? 2.0 : 1.0) * double((frames - i) * (bins - k));
    return std::sqrt(sum) / double(frames * bins);
}

} // namespace

int main(int argc, char **argv)
try {
    AnalysisSettings settings;
    std::string dump;
    for (int i = 2; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument == "--dump" && i + 1 < argc) {
            dump = argv[++i];
            continue;
        }
        const std::size_t sign = argument.find('=');
        setSetting(settings, argument.substr(0, sign), sign == std::string::npos ? "" : argument.substr(sign + 1));
    }
    const auto spectrogram =
        std::make_shared<const Spectrogram>(openRecording(argv[1]), settings.spectrogram, settings.selection);
    const NormalisedSpectrogram normalised(spectrogram, estimateBackground(*spectrogram, settings.noise),
                                           settings.noise);
    const Index frames = normalised.time().count;
    const Index bins = normalised.grid().size();
    std::vector<float> y(std::size_t(frames * bins));
    normalised.read(0, frames, y);
    if (!dump.empty()) {
        NumPyWriter out(dump + ".y.npy", {frames, bins});
        out.write(y);
        out.finish();
        std::vector<float> power(y.size());
        spectrogram->read(0, frames, power);
        NumPyWriter raw(dump + ".s.npy", {frames, bins});
        raw.write(power);
        raw.finish();
    }
    const auto edge = Index(std::ceil(double(leftOut) * spectrogram->binsPerCell()));
    for (const auto &[tileFrames, tileCells] :
         {std::pair<Index, Index>{1, 200}, {4, 200}, {16, 40}, {16, 200}, {64, 40}, {64, 200}, {256, 20}}) {
        const Index tileBins =
            std::min(Index(std::lround(double(tileCells) * spectrogram->binsPerCell())), bins - 2 * edge);
        std::vector<double> errors;
        for (Index first = 0; first + tileFrames <= frames; first += tileFrames)
            for (Index bin = edge; bin + tileBins <= bins - edge; bin += tileBins) {
                double sum = 0.0;
                double counted = 0.0;
                for (Index frame = first; frame < first + tileFrames; ++frame)
                    for (Index k = bin; k < bin + tileBins; ++k) {
                        const float value = y[std::size_t(frame * bins + k)];
                        sum += double(value);
                        counted += value > 0.0f ? 1.0 : 0.0;
                    }
                if (counted >= 0.9 * double(tileFrames * tileBins))
                    errors.push_back(sum / counted - 1.0);
            }
        if (errors.empty())
            continue;
        double mean = 0.0;
        for (const double error : errors)
            mean += error / double(errors.size());
        double square = 0.0;
        for (const double error : errors)
            square += error * error / double(errors.size());
        std::sort(errors.begin(), errors.end());
        const auto at = [&](double part) { return errors[std::size_t(part * double(errors.size() - 1))]; };
        const double counting = countingError(*spectrogram, tileFrames, tileBins);
        std::printf("%4lld x %-4lld %6zu tiles  mean %+7.4f  deviation %7.4f  counting %7.4f  ratio %6.2f  1 %% %+7.3f "
                    " 99 %% %+7.3f  most %+8.3f\n",
                    static_cast<long long>(tileFrames), static_cast<long long>(tileCells), errors.size(), mean,
                    std::sqrt(square), counting, std::sqrt(square) / counting, at(0.01), at(0.99), errors.back());
    }
    return 0;
} catch (const std::exception &error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
}
