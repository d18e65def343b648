#pragma once

#include "app/openWindow.h"
#include "live/sources/PipeSource.h"
#include "scene/SimulatedRecording.h"
#include "support/recordings.h"

#include <atomic>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

/// What tests of listening in the window listen to: a pipe that is fed.
namespace faintline::test {

inline constexpr double liveRate = 1000.0;

inline std::vector<float> scene(double seconds)
{
    LineScene lines;
    lines.sampleRateHz = liveRate;
    lines.durationSeconds = seconds;
    lines.noise.deviation = 0.1;
    for (int i = 0; i < 4; ++i) {
        LineSettings line;
        line.frequencyHz = 90.0 + 100.0 * i;
        line.snrDb = 6.0 + i;
        line.startSeconds = 20.0 + 10.0 * i;
        line.durationSeconds = 60.0;
        lines.lines.push_back(line);
    }
    return readAll(SimulatedRecording(lines));
}

inline StreamFormat format()
{
    return {parseSampleType("rf32_le", "test"), liveRate, 1, 0.0, "FIFO"};
}

/// A FIFO that a thread writes samples to, as many as it is allowed to.
class Feeder
{
public:
    Feeder(const QTemporaryDir &folder, std::vector<float> samples)
        : m_path(folder.filePath("fifo").toStdString()), m_samples(std::move(samples))
    {
        if (mkfifo(m_path.c_str(), 0600) != 0)
            qFatal("cannot make a FIFO");
        m_thread = std::jthread([this](const std::stop_token &stop) { feed(stop); });
    }

    void allow(double seconds) { m_allowed = std::size_t(seconds * liveRate); }
    void allowAll() { m_allowed = m_samples.size(); }
    LiveRun::OpenSource source() const
    {
        return [path = m_path](const std::stop_token &stop) -> std::unique_ptr<SampleSource> {
            return std::make_unique<PipeSource>(path, format(), stop);
        };
    }

private:
    void feed(const std::stop_token &stop)
    {
        const int fifo = open(m_path.c_str(), O_WRONLY | O_CLOEXEC);
        for (std::size_t at = 0; at < m_samples.size() && !stop.stop_requested();) {
            const std::size_t count = std::min<std::size_t>(100, m_samples.size() - at);
            if (at + count > m_allowed) {
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
                continue;
            }
            if (write(fifo, m_samples.data() + at, count * sizeof(float)) < 0)
                break;
            at += count;
        }
        close(fifo);
    }

    std::string m_path;
    std::vector<float> m_samples;
    std::atomic<std::size_t> m_allowed = 0;
    std::jthread m_thread;
};

inline AnalysisSettings liveSettings()
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 0.25;
    settings.decide.falseAlarmsPerHour = 60.0;
    return settings;
}

/// A window that listens with the settings of the test.
inline std::unique_ptr<MainWindow> listeningWindow(const QTemporaryDir &folder, Feeder &feeder,
                                                   const AnalysisSettings &settings)
{
    auto window = newWindow();
    window->listening().start(feeder.source(), folder.path(), settings);
    return window;
}

} // namespace faintline::test
