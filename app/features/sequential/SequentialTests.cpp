#include "app/features/sequential/SequentialTests.h"

#include "app/document/FrameKind.h"
#include "base/parallel.h"
#include "plan/lineSequentialModel.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr int walksAtOnce = 10; ///< of each hypothesis

    Axis partOf(Axis axis, Index first, Index count)
    {
        axis.cyclic = axis.cyclic && count == axis.count;
        axis.first = axis.value(double(first));
        axis.count = count;
        return axis;
    }

    /// Walks number first … first+count-1 of both hypotheses in turn.
    std::vector<SequentialTests::Walk> walk(const ScanTest &test, const SequentialModel &model, int first, int count,
                                            const RunContext &context)
    {
        std::vector<SequentialTests::Walk> walks(std::size_t(2 * count));
        parallelFor(2 * count, context, "walks", [&]() -> std::function<void(Index)> {
            return [&](Index i) {
                const ScanRun run{i % 2 == 1, first + int(i / 2)};
                RunContext inner;
                inner.stop = context.stop;
                walks[std::size_t(i)] = {run, walkScan(test, model, run, inner)};
            };
        });
        return walks;
    }

} // namespace

SequentialTests::SequentialTests(QObject *parent) : QObject(parent)
{
    connect(&m_runner, &JobRunner::progressed, this, &SequentialTests::progressed);
    for (JobRunner *runner : {&m_runner, &m_inspector, &m_scanner}) {
        connect(runner, &JobRunner::failed, this, &SequentialTests::failed);
        connect(runner, &JobRunner::failed, this, &SequentialTests::settle);
        connect(runner, &JobRunner::finished, this, &SequentialTests::settle);
        connect(runner, &JobRunner::cancelled, this, &SequentialTests::settle);
    }
}

void SequentialTests::forget()
{
    ++m_generation;
    m_inspector.cancel();
    m_scanner.cancel();
    m_walks.clear();
    m_sectorRounds.reset();
    m_points.clear();
    m_prior.reset();
    m_fixedSize.reset();
    m_isFixedSizeKnown = false;
    m_selected = -1;
    m_stage = 1;
    m_inspection.reset();
    m_scan.reset();
}

void SequentialTests::start(const ScanTest &test)
{
    checkScanTest(test);
    forget();
    m_test = test;
    m_selection = {};
    emit restarted();
    m_runner.start([this, test, generation = m_generation](const RunContext &context) -> JobRunner::Delivery {
        m_jobGeneration = generation;
        runScans(test, context);
        return [] {};
    });
    emit busyChanged(true);
}

void SequentialTests::start(const Selection &selection, const SprtSettings &sprt)
{
    checkSprt(sprt, "sprt");
    const FrameKind &kind = frameKindOf(selection.frames->grid());
    if (&kind != &lineFrames() || selection.model.motion != Motion::Slopes)
        throw Error("sequential test", "requires a line recording and model.motion = slopes");
    checkLikelihoodRatio(Likelihood(selection.model.likelihood, selection.model.snr), "model.likelihood");
    if (selection.frameCount < 1 || selection.cellCount < 1)
        throw Error("sequential test", "needs at least one frame and one frequency bin in view");
    forget();
    m_test.sprt = sprt;
    m_selection = selection;
    emit restarted();
    m_runner.start([this, selection, sprt](const RunContext &context) -> JobRunner::Delivery {
        const Axis frequency = partOf(selection.frames->grid().axes[0], selection.firstCell, selection.cellCount);
        const SequentialModel model = lineSequentialModel(selection.model, {{frequency}}, *selection.frames);
        const auto inspection = std::make_shared<const Inspection>(Inspection{
            inspectStages(model, sprt, selection.frameCount,
                          stagesOf(selection.frames, selection.firstFrame, selection.firstCell, selection.cellCount),
                          context),
            {}});
        return [this, inspection] {
            m_walks = {{ScanRun{}, inspection->test.result}};
            m_selected = 0;
            m_stage = inspection->test.result.stages;
            m_inspection = inspection;
            emit walksChanged();
            emit selectionChanged();
            emit stageChanged();
            emit inspectionChanged();
        };
    });
    emit busyChanged(true);
}

void SequentialTests::cancel()
{
    m_runner.cancel();
    ++m_generation; // discards results that still arrive
}

template <class Change>
void SequentialTests::deliver(Change change)
{
    QMetaObject::invokeMethod(
        this,
        [this, generation = m_jobGeneration, change = std::move(change)]() mutable {
            if (generation == m_generation)
                change();
        },
        Qt::QueuedConnection);
}

void SequentialTests::runScans(const ScanTest &test, const RunContext &context)
{
    const SequentialModel model = scanModel(test.scene, test.designSnrDb);
    for (int first = 0; first < test.walks; first += walksAtOnce) {
        const double from = 0.15 * first / test.walks;
        const int count = std::min(walksAtOnce, test.walks - first);
        deliver([this, walks = walk(test, model, first, count,
                                    context.part(from, from + 0.15 * count / test.walks))]() mutable {
            addWalks(std::move(walks));
        });
    }
    deliver([this, rounds = visitSectorsOf(test, 0, context.part(0.15, 0.25))]() mutable {
        m_sectorRounds = std::move(rounds);
        emit sectorRoundsChanged();
    });
    measureCurves(test, context.part(0.25, 0.6));
    deliver([this, fixedSize = fixedSizeOf(test, context.part(0.6, 1.0))] {
        m_fixedSize = fixedSize;
        m_isFixedSizeKnown = true;
        if (fixedSize)
            m_sectorRounds->fixedStages = *fixedSize * Index(m_sectorRounds->visits.size());
        emit fixedSizeChanged();
        emit sectorRoundsChanged();
    });
}

void SequentialTests::measureCurves(const ScanTest &test, const RunContext &context)
{
    const std::vector<double> snrs = curveSnrs(test);
    const std::vector<double> &deviations = priorDeviations();
    const auto count = double(snrs.size() + deviations.size());
    double done = 0.0;
    std::optional<ScanPoint> before;
    for (const double snrDb : snrs) {
        before = measureScanPoint(test, snrDb, before ? &*before : nullptr,
                                  context.part(done / count, (done + 1.0) / count));
        done += 1.0;
        deliver([this, point = *before] {
            m_points.push_back(point);
            emit curvesChanged();
        });
    }
    const PriorCurve empty = startPriorCurve(test);
    deliver([this, empty] { m_prior = empty; });
    for (const double deviation : deviations) {
        deliver([this,
                 point = measurePriorPoint(test, empty, deviation, context.part(done / count, (done + 1.0) / count))] {
            m_prior->points.push_back(point);
            emit curvesChanged();
        });
        done += 1.0;
    }
}

void SequentialTests::addWalks(std::vector<Walk> walks)
{
    m_walks.insert(m_walks.end(), std::make_move_iterator(walks.begin()), std::make_move_iterator(walks.end()));
    emit walksChanged();
    if (m_selected < 0)
        select(1); // the first with a target
}

void SequentialTests::select(int walk)
{
    if (walk < 0 || walk >= int(m_walks.size()) || walk == m_selected)
        return;
    m_selected = walk;
    m_stage = m_walks[std::size_t(walk)].second.stages;
    m_scan.reset();
    m_inspection.reset();
    emit selectionChanged();
    emit stageChanged();
    inspect();
    readScan();
}

void SequentialTests::setStage(Index stage)
{
    if (m_selected < 0)
        return;
    stage = std::clamp<Index>(stage, 1, m_walks[std::size_t(m_selected)].second.stages);
    if (stage == m_stage)
        return;
    m_stage = stage;
    emit stageChanged();
    if (isOfScans())
        readScan();
}

void SequentialTests::inspect()
{
    const ScanRun run = m_walks[std::size_t(m_selected)].first;
    m_inspector.start([this, test = m_test, run](const RunContext &context) -> JobRunner::Delivery {
        const auto inspection = std::make_shared<const Inspection>(
            Inspection{inspectStages(scanModel(test.scene, test.designSnrDb), test.sprt, stageLimit(test),
                                     scanStages(test, run), context),
                       truthOf(test, run)});
        return [this, inspection] {
            m_inspection = inspection;
            emit inspectionChanged();
        };
    });
}

void SequentialTests::readScan()
{
    m_scanner.start([this, test = m_test, run = m_walks[std::size_t(m_selected)].first,
                     stage = m_stage](const RunContext &) -> JobRunner::Delivery {
        return [this, scan = Scan{run, stage, rangeDopplerDb(test, run, stage - 1)}] {
            m_scan = scan;
            emit scanChanged();
        };
    });
}

void SequentialTests::settle()
{
    if (!m_runner.isRunning())
        emit busyChanged(false);
    if (!isBusy())
        emit settled();
}

} // namespace faintline
