// Finds a faint tone among samples in memory.
#include <faintline.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

using namespace faintline;

int main()
{
    // One minute at 1 kHz: white noise and, 21 dB below it, a tone that drifts from 200 to 203 Hz.
    constexpr double rate = 1000.0, seconds = 60.0, amplitude = 0.12;
    std::mt19937 random(1);
    std::normal_distribution<double> noise;
    const auto samples = std::make_shared<std::vector<float>>();
    for (double t = 0.0; t < seconds; t += 1.0 / rate) {
        const double cycles = 200.0 * t + 0.5 * 0.05 * t * t;
        samples->push_back(float(noise(random) + amplitude * std::cos(2.0 * std::numbers::pi * cycles)));
    }

    const ArrayLayout layout{.sampleRateHz = rate, .sampleCount = std::ssize(*samples)};
    const auto recording =
        std::make_shared<ArrayRecording>("tone", std::shared_ptr<const float>(samples, samples->data()), layout);
    const auto analysis = analyse(recording, AnalysisSettings());

    std::printf("threshold %.1f nat, one false alarm an hour\n", analysis->threshold);
    for (const Event &event : events(*analysis))
        std::printf("%.1f to %.1f s at %.2f Hz, %+.3f Hz/s, %.1f dB in a window\n", event.onsetSeconds,
                    event.endSeconds, event.position.front(), event.driftPerSecond, event.snrDb);
    return events(*analysis).empty() ? 1 : 0;
}
