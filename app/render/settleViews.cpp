#include "app/render/settleViews.h"

#include "app/control/Closeup.h"
#include "app/control/OutputLayers.h"
#include "app/panels/ChannelsPanel.h"
#include "app/panels/DopplerPanel.h"
#include "app/panels/EvaluatePanel.h"
#include "app/panels/ExperimentForm.h"
#include "app/panels/InfoPanel.h"
#include "app/panels/LatencyPanel.h"
#include "app/panels/NoiseCheck.h"
#include "app/panels/NoiseFitPanel.h"
#include "app/panels/SequentialPanel.h"
#include "app/panels/SpectrumPanel.h"
#include "app/panels/StateSlicePanel.h"
#include "app/panels/SweepForm.h"
#include "app/panels/SweepPanel.h"
#include "app/panels/WhyPanel.h"
#include "app/window/MainWindow.h"
#include "app/workspace/Workbench.h"

#include <QEventLoop>

#include <optional>

namespace faintline {

namespace {

    /// Waits until a busy part emits that it has settled.
    template <class Part>
    void waitFor(Part &part)
    {
        QEventLoop loop;
        QObject::connect(&part, &Part::settled, &loop, &QEventLoop::quit);
        if (part.isBusy())
            loop.exec();
    }

    void waitForExperiments(MainWindow &window)
    {
        QEventLoop loop;
        QObject::connect(&window.experiments(), &Experiments::busyChanged, &loop, [&](bool isBusy) {
            if (!isBusy)
                loop.quit();
        });
        if (window.experiments().isBusy())
            loop.exec();
    }

} // namespace

void settleExperiments(MainWindow &window)
{
    waitForExperiments(window);
    for (const Experiments::Entry &entry : window.experiments().entries())
        if (entry.state == Experiments::State::Failed)
            throw Error("experiment", entry.failure.toStdString(), Error::Kind::Failure);
}

void measureCurves(MainWindow &window)
{
    constexpr int runs = 2;
    window.evaluation().form().setQuick(
        runs, {QStringLiteral("SMD 5 slopes"), QStringLiteral("3 of 4"), QStringLiteral("integrator")}, -5, 3, 2);
    window.evaluation().start();
    settleExperiments(window);
}

void sweepThreshold(MainWindow &window)
{
    constexpr int trials = 24;
    SweepPanel &panel = window.sweep();
    panel.setMeasuringCost(false);
    panel.form().setParameter(QStringLiteral("decide.thresholdNats"));
    panel.form().setRange(4.0, 16.0, 7, false);
    panel.form().setLines(0.0, 30.0, trials);
    window.showSweep();
    panel.start();
    waitForExperiments(window);
    const Experiments::Entry *entry = window.experiments().entry(panel.shown());
    if (!entry || entry->state == Experiments::State::Failed)
        throw Error("--view sweep", entry ? entry->failure.toStdString() : "cannot be drawn for this source",
                    Error::Kind::Failure);
}

void explainCursor(MainWindow &window)
{
    QEventLoop loop;
    QObject::connect(&window.why(), &WhyPanel::settled, &loop, &QEventLoop::quit);
    window.showWhy();
    loop.exec();
}

void measureNoise(MainWindow &window)
{
    window.showNoiseFit();
    waitFor(window.noiseFit());
}

void settleSpectrum(MainWindow &window)
{
    window.showSpectrum();
    waitFor(window.spectrum());
}

void showChannels(MainWindow &window)
{
    window.showChannels();
    waitFor(window.channels());
}

void fitDoppler(MainWindow &window)
{
    window.showDoppler();
    waitFor(window.doppler());
}

void settleNoiseCheck(MainWindow &window)
{
    waitFor(*window.info().check());
}

void settleLayers(MainWindow &window)
{
    waitFor(window.workbench().layers());
}

void settleCloseup(MainWindow &window)
{
    QEventLoop loop;
    QObject::connect(&window.workbench().closeup(), &Closeup::settled, &loop, [&] {
        if (!window.workbench().closeup().isBusy())
            loop.quit();
    });
    if (window.workbench().closeup().isBusy())
        loop.exec();
}

void cutStates(MainWindow &window)
{
    window.showStates();
    waitFor(window.states());
    settleLayers(window); // the read-out shows the state, too
}

void measureLatency(MainWindow &window)
{
    constexpr int runs = 4;
    if (const QString why = window.latency().obstacle(); !why.isEmpty())
        throw Error("--view latency", why.toStdString());
    QEventLoop loop;
    QObject::connect(&window.latency(), &LatencyPanel::settled, &loop, &QEventLoop::quit);
    window.showLatency();
    window.latency().start(runs);
    loop.exec();
}

void testAndSettle(MainWindow &window, const std::function<void()> &start)
{
    QEventLoop loop;
    std::optional<Error> failure;
    QObject::connect(&window.sequential(), &SequentialPanel::failed, &loop, [&](const Error &error) {
        failure = error;
        loop.quit();
    });
    QObject::connect(&window.sequentialTests(), &SequentialTests::settled, &loop, &QEventLoop::quit);
    start();
    if (!failure && window.sequentialTests().isBusy())
        loop.exec();
    if (failure)
        throw *failure;
}

} // namespace faintline
