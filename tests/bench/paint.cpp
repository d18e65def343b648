// What a frame of the whole window costs the thread that paints while somebody pans, zooms or drags the threshold: both
// pictures, the curves below them, the overview, the list of events and whatever else follows. An hour of lines in
// noise, or the recording named.
//
//     QT_QPA_PLATFORM=offscreen faintline-bench-paint [recording [width height]]

#include "app/features/pictures/Workbench.h"
#include "app/window/MainWindow.h"
#include "widgets/base/Theme.h"
#include "widgets/plot/ExceedancePlot.h"

#include <qwt_scale_div.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QFile>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

using namespace faintline;

namespace {

/// Milliseconds by the clock and of this thread's processor: the first depends on what else runs.
struct Cost {
    std::vector<double> clock;
    std::vector<double> processor;
};

double processorMilliseconds()
{
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
}

double quantile(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    return values[std::size_t(share * double(values.size() - 1))];
}

/// One hour with a line every minute, as strong as to be found and as long as to be followed.
QString hourOfLines(const QTemporaryDir &folder)
{
    const QString path = folder.filePath(QStringLiteral("hour.json"));
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly))
        return {};
    file.write(R"({"kind": "lines", "sampleRateHz": 16000, "durationSeconds": 3600, "seed": 5, "lines": [)");
    for (int i = 0; i < 59; ++i)
        file.write(QStringLiteral(
                       R"(%1{"snrDb":8, "driftHzPerSecond": 0.4, "startSeconds": %2, "durationSeconds": 50,
                      "frequencyHz": %3})")
                       .arg(i == 0 ? "" : ", ")
                       .arg(60 * i + 5)
                       .arg(300 + (i * 1237) % 7400)
                       .toUtf8());
    file.write("]}");
    return path;
}

void report(const char *gesture, double zoom, const Cost &cost)
{
    std::printf("%-16s %6.4g x   processor: median %5.1f ms, 95 %% %5.1f ms   clock: median %5.1f ms, 95 %% %5.1f ms\n",
                gesture, zoom, quantile(cost.processor, 0.5), quantile(cost.processor, 0.95), quantile(cost.clock, 0.5),
                quantile(cost.clock, 0.95));
    std::fflush(stdout);
}

class Hand
{
public:
    explicit Hand(MainWindow &window) : m_window(window), m_canvas(window.workbench().output()->canvas()) {}

    void mouse(QEvent::Type type, const QPointF &at) { mouse(m_canvas, type, at); }

    static void mouse(QWidget *canvas, QEvent::Type type, const QPointF &at)
    {
        const bool isMove = type == QEvent::MouseMove;
        const bool isUp = type == QEvent::MouseButtonRelease;
        QMouseEvent event(type, at, canvas->mapToGlobal(at), isMove ? Qt::NoButton : Qt::LeftButton,
                          isUp ? Qt::NoButton : Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(canvas, &event);
    }

    void zoom(double notches)
    {
        const QPointF at = m_canvas->rect().center() + QPointF(20, 30);
        const QPointF inView = m_canvas->mapTo(m_window.workbench().output(), at);
        QWheelEvent event(inView, m_canvas->mapToGlobal(at), {}, QPoint(0, int(std::lround(120.0 * notches))),
                          Qt::NoButton, Qt::ControlModifier, Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(m_window.workbench().output(), &event);
    }

    /// One event and the painting that follows from it.
    template <class Act>
    static void frame(Cost &cost, const Act &act)
    {
        QElapsedTimer clock;
        clock.start();
        const double before = processorMilliseconds();
        act();
        QCoreApplication::sendPostedEvents();
        QCoreApplication::processEvents();
        cost.processor.push_back(processorMilliseconds() - before);
        cost.clock.push_back(double(clock.nsecsElapsed()) * 1e-6);
    }

    /// Drags the picture to and fro, a few pixels at a time.
    Cost pan(int frames)
    {
        Cost cost;
        QPointF at = m_canvas->rect().center();
        mouse(QEvent::MouseButtonPress, at);
        for (int i = 0; i < frames; ++i) {
            at += QPointF((i / 20) % 2 == 0 ? 3.0 : -3.0, (i / 30) % 2 == 0 ? 7.0 : -7.0);
            frame(cost, [&] { mouse(QEvent::MouseMove, at); });
        }
        mouse(QEvent::MouseButtonRelease, at);
        QTest::qWait(300);
        return cost;
    }

    /// Zooms in and out by eighths of a notch.
    Cost wheel(int frames)
    {
        Cost cost;
        for (int i = 0; i < frames; ++i)
            frame(cost, [&] { zoom((i / 40) % 2 == 0 ? 0.125 : -0.125); });
        QTest::qWait(300);
        return cost;
    }

    /// Drags the threshold over the statistics of events, as far as the plot goes, and back.
    Cost threshold(int frames)
    {
        Cost cost;
        QwtPlot *plot = m_window.findChild<ExceedancePlot *>();
        QWidget *canvas = plot->canvas();
        const double before = m_window.document().shownThreshold();
        const double farthest = plot->axisScaleDiv(QwtAxis::XBottom).upperBound();
        const auto at = [&](double nats) {
            return QPointF(plot->transform(QwtAxis::XBottom, nats), 0.5 * canvas->height());
        };
        mouse(canvas, QEvent::MouseButtonPress, at(before));
        for (int i = 0; i < frames; ++i) {
            const double share = 1.0 - std::abs(1.0 - 2.0 * i / frames);
            frame(cost, [&] { mouse(canvas, QEvent::MouseMove, at(before + (farthest - before) * share)); });
        }
        mouse(canvas, QEvent::MouseMove, at(before));
        return cost;
    }

private:
    MainWindow &m_window;
    QWidget *m_canvas;
};

} // namespace

int main(int argc, char **argv)
{
    Theme::prepareForPictures();
    QApplication application(argc, argv);
    Theme::apply(Theme::Kind::Light);
    MainWindow window;
    window.setAsking(false);
    window.resize(argc > 3 ? QByteArray(argv[2]).toInt() : 1600, argc > 3 ? QByteArray(argv[3]).toInt() : 1000);
    window.show();
    const QTemporaryDir folder;
    QSignalSpy settled(&window.controller(), &AnalysisController::settled);
    window.open(argc > 1 ? QString::fromLocal8Bit(argv[1]) : hourOfLines(folder));
    if (!settled.wait(600'000) || !window.document().analysis())
        return 1;
    QTest::qWait(3000); // what follows an analysis in the background

    const QSize canvas = window.workbench().output()->canvas()->size();
    const auto &picture = *window.document().analysis()->input;
    std::printf("window %d x %d, two canvases of %d x %d; %lld frames, %lld cells, %lld frames a row; %zu events\n",
                window.width(), window.height(), canvas.width(), canvas.height(),
                static_cast<long long>(picture.frameCount()), static_cast<long long>(picture.cells()),
                static_cast<long long>(picture.framesPerRow(0)), window.document().shownEvents().size());
    Hand hand(window);
    Viewport &viewport = window.document().viewport();
    for (const double zoom : {1.25, 4.0, 32.0, 256.0}) {
        const Viewport::Box full = viewport.full();
        const double seconds = full.time.width() / zoom;
        const double hz = full.frequency.width() / std::min(zoom, 8.0);
        viewport.zoomTo({full.time.middle() - 0.5 * seconds, full.time.middle() + 0.5 * seconds},
                        {full.frequency.middle() - 0.5 * hz, full.frequency.middle() + 0.5 * hz});
        QTest::qWait(300);
        report("dragged", zoom, hand.pan(240));
        report("wheel and Ctrl", zoom, hand.wheel(240));
    }
    for (const double zoom : {1.0, 8.0}) {
        const Span &all = viewport.full().time;
        viewport.zoomTo({all.low, all.low + all.width() / zoom}, viewport.full().frequency);
        QTest::qWait(300);
        report("threshold", zoom, hand.threshold(120));
    }
    return 0;
}
