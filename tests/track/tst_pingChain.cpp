#include "detect/ModelBank.h"
#include "evaluate/comparison/trackScore.h"
#include "model/sonarModels.h"
#include "scene/SimulatedPings.h"
#include "support/test.h"
#include "track/DetectionChain.h"

using namespace faintline;

namespace {

PingScene scene(std::vector<PingTarget> targets, int pings = 50)
{
    PingScene made;
    made.pings = pings;
    made.rangeCells = 150;
    made.beams = 12;
    made.seed = 5;
    made.targets = std::move(targets);
    return made;
}

PingTarget target(double rangeCell, double beam, double rangeRate, double bearingRate, double snrDb = 10.0)
{
    PingTarget made;
    made.snrDb = snrDb;
    made.rangeMetres = 3000.0 + 10.0 * rangeCell;
    made.bearingDegrees = 30.0 * beam;
    made.appearPing = 8;
    made.legs = {{0, 0.0, 0.0, rangeRate, bearingRate, 1}};
    return made;
}

SonarMotion slow(SonarMotion motion)
{
    motion.fastestRange = 4;
    return motion;
}

ChainSettings settings()
{
    ChainSettings chain;
    chain.threshold = 22.0;
    chain.shoulder = 14.0;
    chain.linkCells = {3, 1};
    chain.inhibitCells = {3, 1};
    chain.forgetCells = {8, 1};
    chain.track.windowCells = {8.0, 1.0};
    chain.track.decayNats = 0.5;
    chain.track.ceilingNats = 10.0;
    chain.track.endNats = 8.0;
    chain.track.confirmNats = 6.0;
    chain.track.confirmFrames = 3;
    return chain;
}

/// Keeps its rates for 20 pings, long enough for the model of such targets, and turns then.
PingTarget turningLate()
{
    PingTarget made = target(60, 6, 2, 0, 8.0);
    made.legs[0].pings = 20;
    made.legs.push_back({0, 0.0, 0.0, -2.0, 0.0, 8});
    return made;
}

std::unique_ptr<DetectionChain> newChain(const SimulatedPings &pings, const ChainSettings &chainSettings, bool bank)
{
    const MarkovModel turning = sonarModel(pings.grid(), slow(manoeuvring(1)));
    const MarkovModel steady = sonarModel(pings.grid(), slow(nonManoeuvring()));
    std::unique_ptr<DetectionChain> chain;
    if (bank)
        chain =
            std::make_unique<DetectionChain>(std::vector{steady, turning}, pings.grid(),
                                             std::make_unique<ModelBank>(std::vector<ModelBank::Member>{
                                                 {steady, {ResetLaw::Mean}, 8.0}, {turning, {ResetLaw::Mean}, 0.0}}),
                                             chainSettings);
    else
        chain = std::make_unique<DetectionChain>(
            turning, pings.grid(), std::make_unique<Smd>(turning, ResetRule{ResetLaw::Mean}), chainSettings);
    return chain;
}

/// A chain that has taken all pings.
std::unique_ptr<DetectionChain> run(const SimulatedPings &pings, const ChainSettings &chainSettings, bool bank = false)
{
    std::unique_ptr<DetectionChain> chain = newChain(pings, chainSettings, bank);
    std::vector<float> y(std::size_t(pings.grid().size()));
    std::vector<float> statistic(y.size());
    for (Index ping = 0; ping < pings.time().count; ++ping) {
        pings.read(ping, 1, y);
        chain->update(ping, y, statistic);
    }
    return chain;
}

TrackScore scoreOf(DetectionChain &chain, const SimulatedPings &pings)
{
    chain.finish();
    return scoreTracks(chain.tracks(), pings.truth(), pings.grid(), {3, 1});
}

} // namespace

/// Parsons' chain on a small sonar.
class tst_pingChain : public QObject
{
    Q_OBJECT

private slots:
    void followsATargetOverTheWrap();
    void crossingTargetsKeepTheirTracks();
    void aTargetOffTheRangeEdgeEnds();
    void inhibitionNamesItsTracks();
    void feedbackKeepsTracksFew();
    void bankTracksWithTheWinner();
    void aTrackChangesItsModel();
    void aSteadyTargetEndsInItsModel();
    void aSavedStateKeepsTheRivals();
    void pathTermsAddUp();
};

void tst_pingChain::followsATargetOverTheWrap()
{
    const SimulatedPings pings(scene({target(40, 9, 1, 0.25)}));
    const auto chain = run(pings, settings());
    const TrackScore score = scoreOf(*chain, pings);
    QCOMPARE(score.targets[0].tracks, 1);
    QVERIFY(score.targets[0].isConfirmed());
    QVERIFY2(score.targets[0].detectLatency <= 6, qPrintable(QString::number(score.targets[0].detectLatency)));
    QVERIFY(score.targets[0].rmsCells[0] < 1.0);
    QCOMPARE(score.falseConfirmed, 0);
    QVERIFY(chain->tracks().front().isOpen);
    QVERIFY(chain->tracks().front().confirmFrame > chain->tracks().front().detectFrame);
}

void tst_pingChain::crossingTargetsKeepTheirTracks()
{
    const SimulatedPings pings(scene({target(30, 4, 2, 0), target(90, 4, -1, 0)}));
    const auto chain = run(pings, settings());
    const TrackScore score = scoreOf(*chain, pings);
    QVERIFY(score.targets[0].isConfirmed() && score.targets[1].isConfirmed());
    QCOMPARE(score.falseConfirmed, 0);
}

void tst_pingChain::aTargetOffTheRangeEdgeEnds()
{
    const SimulatedPings pings(scene({target(110, 4, 3, 0)}));
    const auto chain = run(pings, settings());
    chain->finish();
    const auto owner =
        std::find_if(chain->tracks().begin(), chain->tracks().end(), [](const Track &t) { return t.isConfirmed; });
    QVERIFY(owner != chain->tracks().end());
    QVERIFY(!owner->isOpen);
    QVERIFY2(owner->endFrame <= 24, qPrintable(QString::number(owner->endFrame))); // it is gone from ping 22 on
}

void tst_pingChain::inhibitionNamesItsTracks()
{
    const SimulatedPings pings(scene({target(40, 4, 1, 0)}, 30));
    const auto chain = run(pings, settings());
    QCOMPARE(chain->trackers().size(), std::size_t(1));
    const auto inhibitions = chain->inhibitions();
    QCOMPARE(inhibitions.size(), std::size_t(1));
    QCOMPARE(inhibitions[0].track, chain->trackers()[0].track().id);
    const Index cell = pings.truth().targets[0].cellAt(29);
    QVERIFY(inhibitions[0].box.contains(pings.grid(), pings.grid().coordinates(cell)));
}

void tst_pingChain::feedbackKeepsTracksFew()
{
    const SimulatedPings pings(scene({target(40, 4, 1, 0, 12.0), target(90, 9, -1, 0, 12.0)}));
    const auto tracksOf = [&](bool resets, bool inhibits) {
        ChainSettings chain = settings();
        chain.resets = resets;
        chain.inhibits = inhibits;
        const auto made = run(pings, chain);
        made->finish();
        return made->tracks().size();
    };
    const std::size_t both = tracksOf(true, true);
    QVERIFY2(tracksOf(false, true) > both, "without the detector's reset");
    QVERIFY2(tracksOf(true, false) > both, "without inhibition");
}

void tst_pingChain::bankTracksWithTheWinner()
{
    // One target keeps its rates, the other turns at every chance.
    PingTarget turning = target(90, 9, 0, 0, 11.0);
    turning.weaveCellsPerPing = 3.0;
    turning.weavePings = 12.0;
    const SimulatedPings pings(scene({target(30, 4, 2, 0, 8.0), turning}));
    const auto chain = run(pings, settings(), true);
    const TrackScore score = scoreOf(*chain, pings);
    QVERIFY(score.targets[0].isConfirmed() && score.targets[1].isConfirmed());
    for (std::size_t i = 0; i < score.targetOfTrack.size(); ++i)
        if (score.targetOfTrack[i] == 1 && chain->tracks()[i].isConfirmed)
            QCOMPARE(chain->tracks()[i].model, std::size_t(1));
}

void tst_pingChain::aTrackChangesItsModel()
{
    const SimulatedPings pings(scene({turningLate()}, 60));
    const auto chain = run(pings, settings(), true);
    const TrackScore score = scoreOf(*chain, pings);
    QCOMPARE(score.targets[0].tracks, 1);
    QCOMPARE(score.falseTracks, 0);
    QVERIFY2(score.targets[0].matchedPoints >= 45,
             qPrintable(QString("%1 of 52 pings followed").arg(score.targets[0].matchedPoints)));
    const Track &track = chain->tracks().front();
    const auto isTurning = [&](Index ping) { return modelAt(ping, track.model, track.modelChanges) == 1; };
    const Index turn = 8 + 20; // its first ping
    QVERIFY2(!isTurning(turn - 6), "keeps its rates before the turn");
    QVERIFY2(isTurning(turn + 2), "manoeuvres in the turn");
    QVERIFY2(!isTurning(turn + 24), "keeps its rates after the turn");
    for (std::size_t i = 1; i < track.points.size(); ++i)
        QCOMPARE(track.points[i].frame, track.points[i - 1].frame + 1);
}

void tst_pingChain::aSteadyTargetEndsInItsModel()
{
    const SimulatedPings pings(scene({target(30, 4, 2, 0)}));
    const auto chain = run(pings, settings(), true);
    chain->finish();
    QCOMPARE(chain->tracks().size(), std::size_t(1));
    QCOMPARE(chain->tracks().front().lastModel(), std::size_t(0));
    QVERIFY(chain->tracks().front().modelChanges.size() <= 1);
}

void tst_pingChain::aSavedStateKeepsTheRivals()
{
    const SimulatedPings pings(scene({turningLate()}, 60));
    const auto whole = newChain(pings, settings(), true);
    const auto resumed = newChain(pings, settings(), true);
    std::vector<float> y(std::size_t(pings.grid().size()));
    std::vector<float> statistic(y.size());
    std::vector<float> again(y.size());
    for (Index ping = 0; ping < pings.time().count; ++ping) {
        pings.read(ping, 1, y);
        whole->update(ping, y, statistic);
        if (ping == 27) // the turn is about to begin
            resumed->setState(*whole->state());
        if (ping <= 27)
            continue;
        resumed->update(ping, y, again);
        QVERIFY2(statistic == again, qPrintable(QString("ping %1").arg(ping)));
    }
    QVERIFY(!whole->trackers().empty());
    QVERIFY(!whole->trackers().front().track().modelChanges.empty());
    QCOMPARE(resumed->trackers().front().track().modelChanges, whole->trackers().front().track().modelChanges);
}

void tst_pingChain::pathTermsAddUp()
{
    // Under the mean law K changes from ping to ping, and boxes are forgotten: the terms must add up all the same.
    for (bool bank : {false, true}) {
        const SimulatedPings pings(scene({target(40, 4, 1, 0), target(90, 9, -1, 0)}, 30));
        const auto chain = run(pings, settings(), bank);
        for (Index cell = 0; cell < pings.grid().size(); cell += 97) {
            const std::size_t model = chain->detector().winnerAt(cell);
            const std::span<const float> scores = chain->detector().scores(model);
            Index best = cell;
            for (Index state = cell; state < std::ssize(scores); state += pings.grid().size())
                if (scores[std::size_t(state)] > scores[std::size_t(best)])
                    best = state;
            const std::vector<PathStep> path = chain->detectorPathInto(best, model);
            QVERIFY2(std::abs(path.back().score - double(scores[std::size_t(best)])) < 1e-3,
                     qPrintable(QString("cell %1: %2, detector %3")
                                    .arg(cell)
                                    .arg(path.back().score)
                                    .arg(scores[std::size_t(best)])));
        }
    }
}

FAINTLINE_TEST(tst_pingChain)
#include "tst_pingChain.moc"
