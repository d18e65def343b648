#include "base/Random.h"
#include "detect/MapTrajectory.h"
#include "detect/Sprt.h"
#include "support/errors.h"
#include "support/paths.h"
#include "support/test.h"

#include <numeric>

using namespace faintline;
using namespace faintline::test;

namespace {

const Likelihood twoToOne(LikelihoodKind::Exponential, 2.0);

KinematicAxis axis(Index cells, bool cyclic = false)
{
    return {.cells = cells, .cyclic = cyclic};
}

KinematicAxis admissible(Index cells)
{
    KinematicAxis a = axis(cells);
    a.step = {1.0 / 3.0, 1.0 / 3.0};
    a.renormalised = true;
    return a;
}

KinematicAxis gaussian(Index cells, double deviation)
{
    KinematicAxis a = axis(cells);
    a.step = gaussianStep(deviation, cells);
    a.renormalised = true;
    return a;
}

/// The longest step of a ring of five goes half-way round.
KinematicAxis ring(double deviation)
{
    KinematicAxis a = axis(5, true);
    a.step = gaussianStep(deviation, 3);
    a.renormalised = true;
    return a;
}

KinematicAxis matrix(std::vector<double> rows)
{
    KinematicAxis a = axis(Index(std::sqrt(double(rows.size()))));
    a.transition = std::move(rows);
    return a;
}

KinematicAxis stageAxis(Index cells)
{
    KinematicAxis a = axis(cells, true);
    a.firstRate = -1;
    a.rateCount = 3;
    a.rateChange = {0.5, 0.25};
    return a;
}

/// Rates on an axis with ends: some rates lead off it from where they are.
KinematicAxis bounded(Index cells, int firstRate, int rateCount, std::vector<double> rateChange,
                      Rounding rounding = Rounding::HalfDown)
{
    KinematicAxis a = axis(cells);
    a.firstRate = firstRate;
    a.rateCount = rateCount;
    a.rateChange = std::move(rateChange);
    a.rounding = rounding;
    return a;
}

KinematicAxis halves(KinematicAxis a)
{
    a.ratesPerCell = 2;
    return a;
}

struct World {
    const char *name;
    std::vector<KinematicAxis> axes;
    std::vector<bool> isFolded;
    std::vector<double> initial;
};

/// Every kind of axis, alone and together, few enough states that all trajectories can be listed.
std::vector<World> worlds()
{
    return {
        {"one cell", {axis(1)}, {false}, {}},
        {"admissible moves", {admissible(4)}, {false}, {}},
        {"an initial law", {admissible(4)}, {false}, {0.7, 0.0, 0.1, 0.2}},
        {"Gaussian walk", {gaussian(5, 0.8)}, {false}, {}},
        {"uniform walk", {gaussian(4, std::numeric_limits<double>::infinity())}, {false}, {}},
        {"Gaussian walk round a ring", {ring(1.2)}, {false}, {}},
        {"matrix", {matrix({0.1, 0.9, 0.0, 0.3, 0.3, 0.4, 0.0, 0.0, 1.0})}, {false}, {}},
        {"matrix and admissible", {matrix({0.25, 0.75, 0.6, 0.4}), admissible(3)}, {false, false}, {}},
        {"admissible and matrix", {admissible(3), matrix({0.25, 0.75, 0.6, 0.4})}, {false, false}, {}},
        {"two walks", {admissible(3), gaussian(3, 1.5)}, {false, false}, {}},
        {"Doppler last", {admissible(3), axis(2)}, {false, true}, {}},
        {"Doppler first", {axis(3), admissible(2)}, {true, false}, {0.25, 0.75}},
        {"Doppler alone", {axis(5)}, {true}, {}},
        {"rates and Doppler", {stageAxis(3), axis(2)}, {false, true}, {}},
        {"rates between ends", {bounded(3, -1, 3, {0.5, 0.25})}, {false}, {}},
        {"five slopes between ends", {bounded(3, -2, 5, {1.0 / 3.0, 1.0 / 3.0})}, {false}, {}},
        {"rates to be held", {bounded(4, -1, 3, {1.0})}, {false}, {}},
        {"rates always changed", {bounded(4, -1, 3, {0.0, 0.5})}, {false}, {}},
        {"rates toward zero", {bounded(4, -2, 4, {0.4, 0.2, 0.1}, Rounding::Trunc)}, {false}, {}},
        {"rates of half a cell", {halves(bounded(3, -3, 6, {0.6, 0.2}))}, {false}, {}},
        {"rates of half a cell round a ring",
         {[] {
             KinematicAxis a = halves(bounded(3, -2, 4, {0.6, 0.2}));
             a.cyclic = true;
             return a;
         }()},
         {false},
         {}},
        {"rates of half a cell to be held", {halves(bounded(4, -2, 5, {1.0}))}, {false}, {}},
        {"whole and half rates",
         {bounded(2, -1, 2, {0.5, 0.25}), halves(bounded(2, 0, 2, {0.6, 0.2}))},
         {false, false},
         {}},
        {"rates on both axes", {bounded(2, -1, 2, {0.5, 0.25}), bounded(2, 0, 2, {0.6, 0.2})}, {false, false}, {}},
        {"a walk and rates", {gaussian(2, 0.7), bounded(2, -1, 3, {0.8, 0.1})}, {false, false}, {}},
        {"rates and Doppler between ends", {bounded(3, -1, 3, {0.5, 0.25}), axis(2)}, {false, true}, {}},
        {"a walk that loses at the ends",
         {[] {
             KinematicAxis a = axis(4);
             a.step = {0.4, 0.3};
             return a;
         }()},
         {false},
         {}},
        {"a matrix that loses", {matrix({0.1, 0.5, 0.2, 0.3})}, {false}, {}},
    };
}

SequentialModel modelOf(const World &world)
{
    return makeSequentialModel(world.axes, world.isFolded, twoToOne, world.initial);
}

/// The same world with a state on every axis: folded axes become a walk whose every step is equally likely.
SequentialModel unfolded(const World &world)
{
    std::vector<KinematicAxis> axes = world.axes;
    Index folded = 1;
    for (std::size_t i = 0; i < axes.size(); ++i)
        if (world.isFolded[i]) {
            const auto cells = std::size_t(axes[i].cells);
            axes[i].transition.assign(cells * cells, 1.0 / double(cells));
            folded *= axes[i].cells;
        }
    SequentialModel model = makeSequentialModel(axes, std::vector<bool>(axes.size(), false), twoToOne);
    if (!world.initial.empty()) // of the worlds here the Doppler axis comes first
        for (Index d = 0; d < folded; ++d)
            for (const double p : world.initial)
                model.initial.push_back(p / double(folded));
    return model;
}

/// The law of a renormalised axis with rates from its definition: moves off the axis do not exist, the others share
/// their probability; a rate with none first becomes the nearest one with some.
double sharedProbability(const KinematicAxis &x, Index p, int rate, Index pNext, int rateNext, Index step)
{
    const auto law = [&](int from, Index cell, int to) { return axisProbability(x, p, from, cell, to, step); };
    const auto remaining = [&](int from) {
        double sum = 0.0;
        for (Index cell = 0; cell < x.cells; ++cell)
            for (int to = 0; to < x.rateCount; ++to)
                sum += law(from, cell, to);
        return sum;
    };
    int nearest = -1;
    for (int other = x.rateCount - 1; other >= 0; --other)
        if (remaining(other) > 0.0 && (nearest < 0 || std::abs(other - rate) <= std::abs(nearest - rate)))
            nearest = other;
    return law(nearest, pNext, rateNext) / remaining(nearest);
}

double probability(const StateSpace &space, Index from, Index to, Index step)
{
    const StateSpace::Coordinates a = space.coordinates(from);
    const StateSpace::Coordinates b = space.coordinates(to);
    double product = 1.0;
    for (std::size_t i = 0; i < space.axes().size(); ++i) {
        const KinematicAxis &x = space.axes()[i];
        if (x.renormalised && x.step.empty()) {
            product *= sharedProbability(x, a.cells[i], a.rates[i], b.cells[i], b.rates[i], step);
        } else if (!x.transition.empty()) {
            product *= x.transition[std::size_t(a.cells[i] * x.cells + b.cells[i])];
        } else if (x.renormalised) {
            const auto q = [&](Index cell) {
                const Index apart = std::abs(cell - a.cells[i]);
                const auto d = std::size_t(x.cyclic ? std::min(apart, x.cells - apart) : apart);
                return d < x.step.size() ? x.step[d] : 0.0;
            };
            double sum = 0.0;
            for (Index cell = 0; cell < x.cells; ++cell)
                sum += q(cell);
            product *= q(b.cells[i]) / sum;
        } else {
            product *= axisProbability(x, a.cells[i], a.rates[i], b.cells[i], b.rates[i], step);
        }
    }
    return product;
}

struct Enumerated {
    double lambda = 0.0;
    double best = 0.0;
    std::vector<Index> bestPath;
};

/// All trajectories, in the linear domain.
Enumerated enumerate(const SequentialModel &model, const std::vector<std::vector<double>> &y, Index stages)
{
    const StateSpace &space = model.markov.space;
    const std::vector<double> initial = model.initialLaw();
    Enumerated all;
    for (Index last = 0; last < space.stateCount(); ++last)
        forEachPath(space.stateCount(), stages, last, [&](const std::vector<Index> &path) {
            double p = initial[std::size_t(path[0])];
            for (std::size_t k = 0; k < path.size(); ++k) {
                if (k > 0)
                    p *= probability(space, path[k - 1], path[k], Index(k));
                p *= std::exp(twoToOne.at(y[k][std::size_t(space.cellOf(path[k]))]));
            }
            all.lambda += p;
            if (p > all.best) {
                all.best = p;
                all.bestPath = path;
            }
        });
    return all;
}

std::vector<std::vector<double>> frames(Index cells, Index stages, std::uint64_t stream)
{
    Random random(5, stream);
    std::vector<std::vector<double>> y(std::size_t(stages), std::vector<double>(std::size_t(cells), 0.0));
    for (auto &frame : y)
        for (double &value : frame)
            value = random.exponential();
    return y;
}

StageSource source(const std::vector<std::vector<double>> &y)
{
    return [&y](Index stage, std::span<double> out) {
        std::copy(y[std::size_t(stage)].begin(), y[std::size_t(stage)].end(), out.begin());
    };
}

} // namespace

/// The sequential test against enumeration of all trajectories, its boundaries, and its trajectory.
class tst_Sprt : public QObject
{
    Q_OBJECT

private slots:
    void allTrajectories_data() { rows(); }

    void allTrajectories()
    {
        const SequentialModel model = modelOf(world());
        const SequentialModel whole = unfolded(world());
        const auto y = frames(model.reduction.frameCells(), 4, 1);
        LikelihoodRatio ratio(model);
        std::vector<double> lambda(std::size_t(model.reduction.frameCells()));
        std::vector<double> folded(std::size_t(model.reduction.stateCells()));
        for (Index stages = 1; stages <= 4; ++stages) {
            for (std::size_t cell = 0; cell < lambda.size(); ++cell)
                lambda[cell] = twoToOne.at(y[std::size_t(stages - 1)][cell]);
            model.reduction.sum(lambda, folded);
            const double lnLambda = ratio.update(folded);
            QVERIFY(std::abs(lnLambda - std::log(enumerate(whole, y, stages).lambda)) < 1e-9);
            const std::span<const double> posterior = ratio.posterior();
            QVERIFY(std::abs(std::accumulate(posterior.begin(), posterior.end(), 0.0) - 1.0) < 1e-12);
        }
    }

    void bestTrajectory_data() { rows(); }

    void bestTrajectory()
    {
        const SequentialModel model = modelOf(world());
        const SequentialModel whole = unfolded(world());
        const auto y = frames(model.reduction.frameCells(), 4, 2);
        // Boundaries out of reach and a cut-off at which anything is accepted.
        SprtSettings settings{1e-3, 1e-250, 4};
        const SprtResult result = runSprt(model, settings, 4, source(y));
        QCOMPARE(result.decision, SprtDecision::H1);
        QVERIFY(result.stages >= 1);
        const Enumerated all = enumerate(whole, y, result.stages);
        QVERIFY(std::abs(result.lnMapScore - std::log(all.best)) < 1e-9);
        QCOMPARE(std::ssize(result.trajectory), result.stages);
        for (std::size_t stage = 0; stage < result.trajectory.size(); ++stage)
            QCOMPARE(result.trajectory[stage], whole.markov.space.coordinates(all.bestPath[stage]).cells);
    }

    void everyModelIsALaw_data() { rows(); }

    void everyModelIsALaw()
    {
        const SequentialModel whole = unfolded(world());
        const StateSpace &space = whole.markov.space;
        for (Index step = 0; step < space.phaseCount(); ++step) {
            std::vector<double> leaving(std::size_t(space.stateCount()), 0.0);
            for (Index to = 0; to < space.stateCount(); ++to)
                for (const StateSpace::Predecessor &p : space.predecessors(to, step)) {
                    QVERIFY(std::abs(std::exp(p.lnProbability) - probability(space, p.state, to, step)) < 1e-14);
                    leaving[std::size_t(p.state)] += std::exp(p.lnProbability);
                }
            for (std::size_t from = 0; from < leaving.size(); ++from)
                QVERIFY(std::abs(leaving[from] - 1.0) < 1e-12);
        }
    }

    void tiesGoToTheLowest()
    {
        const SequentialModel model = makeSequentialModel({admissible(5)}, {false}, twoToOne);
        const std::vector<std::vector<double>> y(3, std::vector<double>(5, 2.0)); // all alike
        const MapTrajectory map = MapEstimator(model).estimate(3, [&](Index stage, std::span<double> out) {
            std::copy(y[std::size_t(stage)].begin(), y[std::size_t(stage)].end(), out.begin());
        });
        // Row 0 has two admissible moves of ½, the others three of ⅓: 0 → 0 → 0 is as good as 0 → 0 → 1, 4 → 4 → 4 …
        QCOMPARE(map.states, (std::vector<Index>{0, 0, 0}));
    }

    void keptInPartsIsTheSame()
    {
        // 3 × 3000 states, 600 stages: 43 MB of scores, so only milestones are kept; the corridor round the target fits in
        // whole.
        KinematicAxis wide = stageAxis(3000);
        wide.cyclic = false;
        const auto lambdaAt = [](Index stage, Index cell) {
            return cell == 1400 + stage / 4 ? 8.0 : 0.001 * double((cell * 7 + stage * 13) % 97);
        };
        const auto estimate = [&](KinematicAxis a, Index firstCell) {
            const SequentialModel model = makeSequentialModel({a}, {false}, twoToOne);
            const MapTrajectory map = MapEstimator(model).estimate(600, [&](Index stage, std::span<double> out) {
                for (std::size_t cell = 0; cell < out.size(); ++cell)
                    out[cell] = lambdaAt(stage, firstCell + Index(cell));
            });
            std::vector<Index> cells;
            for (const Index state : map.states)
                cells.push_back(firstCell + model.markov.space.cellOf(state));
            return cells;
        };
        KinematicAxis narrow = wide;
        narrow.cells = 300;
        const std::vector<Index> inParts = estimate(wide, 0);
        QCOMPARE(inParts, estimate(narrow, 1350));
        QCOMPARE(inParts[400], Index(1500));
    }

    void aThousandStages()
    {
        // One cell: ln Λ is the sum of λ, whatever its size.
        const SequentialModel one = makeSequentialModel({axis(1)}, {false}, twoToOne);
        // A uniform walk: ln Λ is the sum of ln of the mean, also where Λ itself is beyond the largest double.
        const SequentialModel uniform =
            makeSequentialModel({gaussian(4, std::numeric_limits<double>::infinity())}, {false}, twoToOne);
        LikelihoodRatio single(one);
        LikelihoodRatio all(uniform);
        Random random(3, 3);
        long double sum = 0.0L;
        long double sumOfMeans = 0.0L;
        for (int stage = 0; stage < 1000; ++stage) {
            std::vector<double> lambda(4);
            for (double &value : lambda)
                value = stage < 500 ? 20.0 * random.uniform() : -40.0 * random.uniform();
            sum += static_cast<long double>(lambda[0]);
            long double mean = 0.0L;
            for (const double value : lambda)
                mean += std::exp(static_cast<long double>(value)) / 4.0L;
            sumOfMeans += std::log(mean);
            single.update(std::span<const double>(lambda).first(1));
            all.update(lambda);
            QVERIFY(std::abs(single.lnLambda() - double(sum)) < 1e-9);
            QVERIFY(std::abs(all.lnLambda() - double(sumOfMeans)) < 1e-9);
        }
    }

    void unreachableCellsDoNotDrownTheRest()
    {
        // The target is in cell 0 and stays; a strong echo in cell 2 does not change its ratio.
        const SequentialModel model = makeSequentialModel({axis(3)}, {false}, twoToOne, {1.0, 0.0, 0.0});
        LikelihoodRatio ratio(model);
        QCOMPARE(ratio.update(std::vector<double>{-1.0, 0.0, 5000.0}), -1.0);
        QCOMPARE(ratio.update(std::vector<double>{-2.0, 5000.0, 0.0}), -3.0);
    }

    void aTargetThatLeaves()
    {
        // Every target moves one cell up each stage and off the axis: such a law cannot be made to lose nothing.
        const auto refusal = [](const std::vector<KinematicAxis> &axes) {
            return errorOf([&] { makeSequentialModel(axes, {false}, twoToOne); });
        };
        KinematicAxis rising = axis(2);
        rising.firstRate = 1;
        QCOMPARE(refusal({rising}),
                 std::string("model.axes[0].rates: let no target in this cell stay on the axis: 1; a "
                             "lossless law needs a transition from every cell"));
        KinematicAxis jumping = axis(3);
        jumping.step = {0.0, 0.0, 0.5};
        QVERIFY(refusal({jumping}).starts_with("model.axes[0].step: let no target in this cell stay on the axis: 1"));
        QVERIFY(
            refusal({matrix({0.0, 0.0, 0.5, 0.5})}).starts_with("model.axes[0].transition: row 0 contains only zeros"));
        rising.cyclic = true;
        QCOMPARE(refusal({rising}), std::string());

        // What is put together by hand is looked at, too.
        SequentialModel model = makeSequentialModel({axis(3)}, {false}, twoToOne);
        KinematicAxis slopes = bounded(3, -1, 3, {0.5, 0.25});
        slopes.name = "frequency";
        model.markov.space = StateSpace({slopes});
        QCOMPARE(
            errorOf([&] { runSprt(model, {}, 1, source(frames(3, 1, 1))); }),
            std::string("model: has an axis of frequency that loses up to 100 % of a target's probability per stage; "
                        "a likelihood ratio needs a lossless law"));
        model.markov.space = StateSpace({slopes.stochastic("axis")});
        runSprt(model, {}, 1, source(frames(3, 1, 1)));
        model.markov.transitionScale = 1.5;
        QVERIFY_THROWS_EXCEPTION(Error, runSprt(model, {}, 1, source(frames(3, 1, 1))));
    }

    void noEvidenceMeansNothing_data()
    {
        QTest::addColumn<bool>("isCyclic");
        QTest::addColumn<bool>("isFine");
        for (const bool isFine : {false, true})
            for (const bool isCyclic : {false, true})
                QTest::addRow("%s, %s", isFine ? "17 slopes of 1/8" : "five slopes", isCyclic ? "cyclic" : "bounded")
                    << isCyclic << isFine;
    }

    void noEvidenceMeansNothing()
    {
        // ρ = 1 and y = 2 ln 2 in every cell: λ = 0 but for rounding, and ln Λ stays 0 for as long as one looks.
        QFETCH(bool, isCyclic);
        QFETCH(bool, isFine);
        KinematicAxis slopes = isFine ? bounded(41, -8, 17, {0.9, 0.05}) : bounded(41, -2, 5, {1.0 / 3.0, 1.0 / 3.0});
        slopes.ratesPerCell = isFine ? 8 : 1;
        slopes.cyclic = isCyclic;
        const SequentialModel model =
            makeSequentialModel({slopes}, {false}, Likelihood(LikelihoodKind::Exponential, 1.0));
        const SprtResult result = runSprt(
            model, {}, 2000, [](Index, std::span<double> y) { std::fill(y.begin(), y.end(), 2.0 * std::log(2.0)); });
        QCOMPARE(result.decision, SprtDecision::Undecided);
        QCOMPARE(result.stages, Index(2000));
        for (const double lnLambda : result.lnLambda)
            QVERIFY2(std::abs(lnLambda) < 1e-12, qPrintable(QString::number(lnLambda)));
    }

    void framesBetweenAreNotLookedAt()
    {
        // Of every third frame only: the others are not asked for, the target moves on through them.
        const SequentialModel model = makeSequentialModel({bounded(5, -1, 3, {0.5, 0.25})}, {false}, twoToOne);
        const auto y = frames(5, 7, 3);
        std::vector<Index> asked;
        SequentialModel sparse = model;
        sparse.observedEvery = 3;
        const SprtSettings open{1e-200, 1e-200, 7};
        const SprtResult result = runSprt(sparse, open, 7, [&](Index stage, std::span<double> out) {
            asked.push_back(stage);
            source(y)(stage, out);
        });
        for (const Index stage : asked)
            QCOMPARE(stage % 3, Index(0));
        LikelihoodRatio ratio(model);
        for (Index stage = 0; stage < 7; ++stage) {
            std::vector<double> lambda(5, 0.0);
            for (std::size_t cell = 0; cell < 5 && stage % 3 == 0; ++cell)
                lambda[cell] = twoToOne.at(y[std::size_t(stage)][cell]);
            QCOMPARE(result.lnLambda[std::size_t(stage)], ratio.update(lambda));
        }
    }

    void meanOfTheRatioOnNoise()
    {
        // E0[Λ] = 1. A small SNR keeps the tail of Λ light enough to see it: 4 standard errors.
        const SequentialModel model =
            makeSequentialModel({admissible(5), axis(3)}, {false, true}, Likelihood(LikelihoodKind::Exponential, 0.3));
        constexpr int runs = 20000;
        double sum = 0.0;
        double squares = 0.0;
        for (int run = 0; run < runs; ++run) {
            LikelihoodRatio ratio(model);
            std::vector<double> lambda(15);
            std::vector<double> folded(5);
            Random random(9, std::uint64_t(run));
            for (int stage = 0; stage < 5; ++stage) {
                for (double &value : lambda)
                    value = model.markov.likelihood.at(random.exponential());
                model.reduction.sum(lambda, folded);
                ratio.update(folded);
            }
            const double value = std::exp(ratio.lnLambda());
            sum += value;
            squares += value * value;
        }
        const double mean = sum / runs;
        const double error = std::sqrt((squares / runs - mean * mean) / runs);
        QVERIFY2(std::abs(mean - 1.0) < 4.0 * error, qPrintable(QString("%1 ± %2").arg(mean).arg(error)));
    }

    void boundaries()
    {
        const SprtBoundaries at = sprtBoundaries({0.01, 0.02, 0});
        QCOMPARE(at.lnUpper, std::log(98.0));
        QCOMPARE(at.lnLower, std::log(0.02 / 0.99));
        QCOMPARE(at.lnCutOff(), 0.5 * (at.lnUpper + at.lnLower));
        const SprtBoundaries far = sprtBoundaries({1e-290, 1e-290, 0});
        QVERIFY(std::isfinite(far.lnLower) && std::isfinite(far.lnUpper));
    }

    void decisions_data()
    {
        QTest::addColumn<double>("lnLambda");
        QTest::addColumn<int>("stage");
        QTest::addColumn<int>("decision");
        const SprtBoundaries at = sprtBoundaries({1e-3, 1e-2, 7});
        const auto row = [](const char *name, double ln, int stage, SprtDecision d) {
            QTest::newRow(name) << ln << stage << int(d);
        };
        row("between", 0.0, 6, SprtDecision::Undecided);
        row("at the upper boundary", at.lnUpper, 1, SprtDecision::H1);
        row("just below it", std::nextafter(at.lnUpper, 0.0), 1, SprtDecision::Undecided);
        row("at the lower boundary", at.lnLower, 1, SprtDecision::H0);
        row("just above it", std::nextafter(at.lnLower, 0.0), 1, SprtDecision::Undecided);
        row("cut-off, at the geometric mean", at.lnCutOff(), 7, SprtDecision::H1);
        row("cut-off, below it", std::nextafter(at.lnCutOff(), -1e9), 7, SprtDecision::H0);
        row("cut-off, at the lower boundary", at.lnLower, 7, SprtDecision::H0);
    }

    void decisions()
    {
        QFETCH(double, lnLambda);
        QFETCH(int, stage);
        QFETCH(int, decision);
        QCOMPARE(int(decide({1e-3, 1e-2, 7}, lnLambda, stage)), decision);
    }

    void cutOff()
    {
        // Evidence that stays where it is: undecided until the cut-off stage, decided by its sign there (α = β).
        const SequentialModel model = makeSequentialModel({axis(1)}, {false}, twoToOne);
        const double neutral = std::log(3.0) * 1.5; // λ = 0 at an SNR of 2
        const auto constant = [&](double first) {
            return [=](Index stage, std::span<double> out) { out[0] = neutral + (stage == 0 ? first : 0.0); };
        };
        const SprtResult up = runSprt(model, {1e-3, 1e-3, 4}, 10, constant(0.3));
        QCOMPARE(up.decision, SprtDecision::H1);
        QCOMPARE(up.stages, Index(4));
        QVERIFY(up.isForced);
        const SprtResult down = runSprt(model, {1e-3, 1e-3, 4}, 10, constant(-0.3));
        QCOMPARE(down.decision, SprtDecision::H0);
        QVERIFY(down.isForced && down.trajectory.empty());
        const SprtResult open = runSprt(model, {1e-3, 1e-3, 0}, 10, constant(0.3));
        QCOMPARE(open.decision, SprtDecision::Undecided);
        QCOMPARE(open.stages, Index(10));
        const SprtResult none = runSprt(model, {}, 0, constant(0.0));
        QCOMPARE(none.decision, SprtDecision::Undecided);
        QVERIFY(none.lnLambda.empty());
    }

    void stopsAtTheBoundary()
    {
        // λ = +1 nat a stage: ln 999 = 6.907 is passed at stage 7, and the eighth frame is never asked for.
        const SequentialModel model = makeSequentialModel({axis(1)}, {false}, Likelihood(LikelihoodKind::Linear));
        Index furthest = -1;
        const SprtResult result = runSprt(model, {}, 100, [&](Index stage, std::span<double> out) {
            furthest = std::max(furthest, stage);
            out[0] = 1.0;
        });
        QCOMPARE(result.stages, Index(7));
        QCOMPARE(furthest, Index(6));
        QVERIFY(!result.isForced);
        QCOMPARE(result.lnLambda.back(), 7.0);
        QCOMPARE(result.lnMapScore, 7.0);
    }

    void sectors()
    {
        // Only sector 1 has a target, from the second round on: the echo is overwhelming there and half a nat short of
        // nothing elsewhere.
        const SequentialModel model = makeSequentialModel({axis(1)}, {false}, twoToOne);
        const SectorRounds made = visitSectors(model, {}, {3, 2, 100, 20}, [](const SectorVisit &visit) -> StageSource {
            const bool isThere = visit.sector == 1 && visit.round == 1;
            return [isThere](Index, std::span<double> out) { out[0] = isThere ? 50.0 : 0.0; };
        });
        QCOMPARE(made.visits.size(), std::size_t(6));
        Index stages = 0;
        for (const SectorVisit &visit : made.visits) {
            const bool isThere = visit.sector == 1 && visit.round == 1;
            QCOMPARE(visit.result.decision, isThere ? SprtDecision::H1 : SprtDecision::H0);
            QCOMPARE(visit.result.stages, Index(isThere ? 1 : 7)); // -ln 3 a stage against -6.907
            QCOMPARE(visit.firstStage, stages);
            stages += visit.result.stages;
        }
        QCOMPARE(made.stages, Index(5 * 7 + 1));
        QCOMPARE(made.fixedStages, Index(120));
        QCOMPARE(made.saving(), 0.7);
    }

    void refusals()
    {
        const auto ofTest = [](const SprtSettings &test) { return errorOf([&] { checkSprt(test, "test"); }); };
        QVERIFY(ofTest({0.0, 1e-3, 0}).starts_with("test.falseAlarm = 0: must lie in"));
        QVERIFY(ofTest({1e-3, 0.6, 0}).starts_with("test.miss = 0.6"));
        QVERIFY(contains(ofTest({0.5, 0.5, 0}), "must be below 1"));
        const auto ofModel = [](const KinematicAxis &axis, const std::vector<double> &initial = {}) {
            return errorOf([&] { makeSequentialModel({axis}, {false}, twoToOne, initial); });
        };
        QVERIFY(contains(ofModel(axis(2), {0.5, 0.6}), "adds up to 1.1"));
        QVERIFY(contains(ofModel(axis(2), {1.0}), "holds 1 probabilities; there are 2 states"));
        QVERIFY(contains(ofModel(matrix({0.5, 0.6, 0.5, 0.5})), "row 0 adds up to 1.1"));
        KinematicAxis bothWays = admissible(2);
        bothWays.cyclic = true;
        QVERIFY(contains(ofModel(bothWays), "the same cell in both directions"));
    }

private:
    void rows()
    {
        QTest::addColumn<int>("index");
        for (std::size_t i = 0; i < worlds().size(); ++i)
            QTest::newRow(worlds()[i].name) << int(i);
    }
    World world() const
    {
        QFETCH(int, index);
        return worlds()[std::size_t(index)];
    }
};

FAINTLINE_TEST(tst_Sprt)
#include "tst_Sprt.moc"
