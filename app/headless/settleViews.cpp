#include "app/headless/settleViews.h"

#include "app/features/evaluate/EvaluatePanel.h"
#include "app/features/evaluate/ExperimentForm.h"
#include "app/features/evaluate/SweepForm.h"
#include "app/features/evaluate/SweepPanel.h"
#include "app/features/inspect/LatencyPanel.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/views/WindowViews.h"
#include "app/window/MainWindow.h"

#include <QCoreApplication>

namespace faintline {

void showAndSettle(MainWindow &window, const QString &view)
{
    window.showView(view);
    settle(*window.views().named(view));
}

void settleExperiments(MainWindow &window)
{
    settle(window.experiments());
    for (const Experiments::Entry &entry : window.experiments().entries())
        if (entry.state == Experiments::State::Failed)
            throw Error("experiment", entry.failure.toStdString(), Error::Kind::Failure);
}

void measureCurves(MainWindow &window)
{
    constexpr int runs = 2;
    window.panel<EvaluatePanel>().form().setQuick(
        runs, {QStringLiteral("SMD 5 slopes"), QStringLiteral("3 of 4"), QStringLiteral("integrator")},
        {-5, -3, -1, 1, 3});
    window.panel<EvaluatePanel>().start();
    settleExperiments(window);
}

void sweepThreshold(MainWindow &window)
{
    constexpr int trials = 24;
    SweepPanel &panel = window.panel<SweepPanel>();
    panel.setMeasuringCost(false);
    panel.form().setParameter(QStringLiteral("decide.thresholdNats"));
    panel.form().setRange(4.0, 16.0, 7, false);
    panel.form().setLines(0.0, 30.0, trials);
    window.showView(QStringLiteral("sweep"));
    panel.start();
    settle(window.experiments());
    const Experiments::Entry *entry = window.experiments().entry(panel.shown());
    if (!entry || entry->state == Experiments::State::Failed)
        throw Error("--view sweep", entry ? entry->failure.toStdString() : "cannot be drawn for this source",
                    Error::Kind::Failure);
}

void measureLatency(MainWindow &window)
{
    constexpr int runs = 4;
    if (const QString why = window.panel<LatencyPanel>().obstacle(); !why.isEmpty())
        throw Error("--view latency", why.toStdString());
    window.panel<LatencyPanel>().start(runs);
    showAndSettle(window, QStringLiteral("latency"));
}

void testAndSettle(MainWindow &window, const std::function<void()> &start)
{
    std::optional<Error> failure;
    const QObject scope;
    QObject::connect(&window.panel<SequentialPanel>(), &SequentialPanel::failed, &scope,
                     [&](const Error &error) { failure = error; });
    start();
    while (!failure && window.sequentialTests().isBusy())
        QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    if (failure)
        throw *failure;
}

} // namespace faintline
