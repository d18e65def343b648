#include "support/recordings.h"
#include "support/test.h"

#include "analyse/analyse.h"
#include "plan/Analysis.h"

#include <cmath>
#include <functional>

using namespace faintline;
using namespace faintline::test;

namespace {

using Complex = std::complex<double>;

/// A signal with its truth: frequency and amplitude over time, s.
struct Signal {
    double from;
    double to;
    std::function<double(double)> hz;
    double snrDb; ///< in a window of `windowSeconds`
    double windowSeconds;
    std::function<double(double)> envelope = [](double) { return 1.0; };
};

/// Signals in noise of power 1 in each sample.
class Mixture
{
public:
    Mixture(double rateHz, double seconds, std::uint64_t seed)
        : m_rateHz(rateHz), m_random(seed, 1),
          m_samples(std::make_shared<std::vector<float>>(std::size_t(rateHz * seconds)))
    {
        Random(seed, 0).normals(*m_samples, 1.0f);
    }

    double uniform(double from, double to) { return from + (to - from) * m_random.uniform(); }

    /// Changes the noise that is there so far.
    void modulate(const std::function<double(double)> &gain)
    {
        for (std::size_t i = 0; i < m_samples->size(); ++i)
            (*m_samples)[i] *= float(gain(double(i) / m_rateHz));
    }

    void click(double at, double deviation, int count)
    {
        for (int i = 0; i < count; ++i)
            (*m_samples)[std::size_t(at * m_rateHz) + std::size_t(i)] +=
                float(deviation * std::exp(-8.0 * i / count) * m_random.normal());
    }

    void add(const Signal &signal)
    {
        const double amplitude =
            std::sqrt(4.0 * std::pow(10.0, signal.snrDb / 10.0) / (m_rateHz * signal.windowSeconds));
        double phase = uniform(0.0, 6.28);
        const auto end = std::min(m_samples->size(), std::size_t(signal.to * m_rateHz));
        for (auto i = std::size_t(signal.from * m_rateHz); i < end; ++i) {
            const double t = double(i) / m_rateHz;
            phase += 2.0 * std::numbers::pi * signal.hz(t) / m_rateHz;
            (*m_samples)[i] += float(amplitude * signal.envelope(t) * std::cos(phase));
        }
        m_truth.push_back(signal);
    }

    const std::vector<Signal> &truth() const { return m_truth; }

    RecordingPointer recording() const
    {
        const ArrayLayout layout{.sampleRateHz = m_rateHz, .sampleCount = std::ssize(*m_samples)};
        return std::make_shared<ArrayRecording>("mixture", std::shared_ptr<const float>(m_samples, m_samples->data()),
                                                layout);
    }

private:
    double m_rateHz;
    Random m_random;
    std::shared_ptr<std::vector<float>> m_samples;
    std::vector<Signal> m_truth;
};

/// How far the tracks of an analysis follow the truth.
struct Score {
    double found = 0.0;     ///< signals that are followed for 60 % of their time
    double fragments = 0.0; ///< tracks on a signal, in the mean over those found
    double onSignal = 0.0;  ///< share of the tracks' time within the tolerance of a signal
};

Score scoreOf(const Analysis &analysis, const std::vector<Signal> &truth, double toleranceHz)
{
    const Axis &time = analysis.time();
    const Axis &frequency = analysis.grid().axes.back();
    std::vector<std::vector<Index>> on(truth.size(), std::vector<Index>(analysis.tracks.size(), 0));
    double all = 0.0;
    double right = 0.0;
    for (std::size_t k = 0; k < analysis.tracks.size(); ++k) {
        const Track &track = analysis.tracks[k];
        for (std::size_t i = 0; i < track.points.size(); ++i) {
            const double t = time.value(double(track.points[i].frame));
            const double hz =
                frequency.value(track.smoothed.empty() ? double(track.points[i].cell) : track.smoothed[i].position);
            bool isOn = false;
            for (std::size_t s = 0; s < truth.size(); ++s)
                if (t >= truth[s].from - time.step && t <= truth[s].to + time.step
                    && std::abs(hz - truth[s].hz(t)) <= toleranceHz) {
                    isOn = true;
                    ++on[s][k];
                }
            all += 1.0;
            right += isOn ? 1.0 : 0.0;
        }
    }
    Score score;
    for (std::size_t s = 0; s < truth.size(); ++s) {
        const double frames = (truth[s].to - truth[s].from) / time.step;
        double followed = 0.0;
        double tracks = 0.0;
        for (const Index count : on[s]) {
            followed += double(count);
            tracks += double(count) > 0.03 * frames ? 1.0 : 0.0;
        }
        if (followed < 0.6 * frames)
            continue;
        score.found += 1.0;
        score.fragments += tracks;
    }
    score.fragments /= std::max(1.0, score.found);
    score.onSignal = all > 0.0 ? right / all : 0.0;
    return score;
}

} // namespace

/// What `detect` without settings makes of recordings of many kinds, whose truth is known.
class tst_kindsOfSignals : public QObject
{
    Q_OBJECT

private:
    /// At least so many signals are found, in so many tracks each at most, and that share of the tracks' time is theirs.
    static void expect(const Mixture &mixture, double toleranceHz, double found, double fragments, double onSignal)
    {
        const auto analysis = analyse(mixture.recording(), {});
        const Score score = scoreOf(*analysis, mixture.truth(), toleranceHz);
        const QString told = QString("%1 of %2 found, %3 tracks each, %4 of the time on a signal")
                                 .arg(score.found)
                                 .arg(mixture.truth().size())
                                 .arg(score.fragments)
                                 .arg(score.onSignal);
        QVERIFY2(score.found >= found && score.fragments <= fragments && score.onSignal >= onSignal, qPrintable(told));
    }

private slots:
    void ordersOfARunUp()
    {
        Mixture mixture(4000.0, 60.0, 1);
        const auto order = [](int n) {
            return [n](double t) { return n * (22.0 + 30.0 * std::clamp((t - 15.0) / 25.0, 0.0, 1.0)); };
        };
        for (int n = 3; n <= 10; ++n)
            mixture.add({0.0, 60.0, order(n), 12.0, 0.5});
        expect(mixture, 3.0, 8, 3.5, 0.8);
    }

    void overtonesOfASungNote()
    {
        Mixture mixture(16000.0, 15.0, 2);
        for (const double from : {1.0, 6.0, 11.0}) {
            const double lowest = mixture.uniform(200.0, 300.0);
            for (int n = 1; n <= 10; ++n)
                mixture.add({from, from + 3.0,
                             [=](double t) { return n * lowest * (1.0 + 0.02 * std::sin(34.0 * (t - from))); },
                             26.0 - n, 0.064});
        }
        expect(mixture, 25.0, 28, 2.5, 0.55);
    }

    void whistlesOverClicks()
    {
        Mixture mixture(48000.0, 12.0, 3);
        for (int i = 0; i < 100; ++i)
            mixture.click(mixture.uniform(0.0, 11.9), mixture.uniform(5.0, 30.0), 300);
        for (int i = 0; i < 9; ++i) {
            const double from = 0.5 + 1.2 * i;
            const double middle = mixture.uniform(7000.0, 14000.0);
            const double sweep = mixture.uniform(-3000.0, 3000.0);
            const double bend = mixture.uniform(500.0, 2000.0);
            mixture.add({from, from + 0.8,
                         [=](double t) { return middle + sweep * (t - from) + bend * std::sin(9.0 * (t - from)); },
                         16.0, 0.0107});
        }
        expect(mixture, 150.0, 9, 1.2, 0.95);
    }

    /// Too fast for the window of the recording, and some too faint for a quarter of it.
    void crossingChirps()
    {
        Mixture mixture(8000.0, 60.0, 7);
        for (int i = 0; i < 30; ++i) {
            const double from = mixture.uniform(0.0, 48.0);
            const double seconds = mixture.uniform(5.0, 12.0);
            const double slope = mixture.uniform(-90.0, 90.0);
            const double first = mixture.uniform(1100.0, 2900.0);
            mixture.add({from, from + seconds, [=](double t) { return first + slope * (t - from); },
                         mixture.uniform(4.0, 12.0), 0.1});
        }
        expect(mixture, 30.0, 28, 2.6, 0.95);
    }

    void tonalsUnderModulatedNoise()
    {
        Mixture mixture(2000.0, 120.0, 4);
        mixture.modulate([](double t) { return 1.0 + 1.5 * std::pow(std::max(0.0, std::sin(19.5 * t)), 2.0); });
        for (const double hz : {61.0, 87.3, 180.0, 312.0, 515.0, 640.0})
            mixture.add({0.0, 120.0, [hz](double t) { return hz + 0.3 * std::sin(t / 22.0); }, 12.0, 2.0});
        expect(mixture, 0.8, 6, 1.2, 0.95);
    }

    void oneSignalAmongTheLinesOfAComb()
    {
        Mixture mixture(4000.0, 60.0, 5);
        for (int n = 1; n <= 40; ++n)
            mixture.add({0.0, 60.0, [n](double) { return 45.0 * n; }, mixture.uniform(12.0, 24.0), 1.0});
        mixture.add({0.0, 60.0, [](double t) { return 700.0 + 1.8 * t; }, 10.0, 1.0});
        expect(mixture, 1.5, 41, 1.2, 0.95);
    }

    void aSpreadCarrier()
    {
        constexpr double rateHz = 20.0;
        Mixture mixture(rateHz, 4.0 * 3600.0, 6);
        Random random(6, 2);
        std::vector<Complex> gains{Complex(random.normal(), random.normal())}; // changes within 10 s
        while (gains.size() < std::size_t(rateHz * 4.0 * 3600.0))
            gains.push_back(0.995 * gains.back() + 0.1 * Complex(random.normal(), random.normal()) / std::sqrt(2.0));
        mixture.add({0.0, 4.0 * 3600.0, [](double t) { return 5.0 + 0.5 * std::sin(t / 2900.0); }, 14.0, 25.0,
                     [&](double t) { return gains[std::size_t(t * rateHz)].real(); }});
        expect(mixture, 0.15, 1, 1.0, 0.8);
    }
};

FAINTLINE_TEST(tst_kindsOfSignals)
#include "tst_kindsOfSignals.moc"
