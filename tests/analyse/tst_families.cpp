#include "analyse/analyse.h"
#include "base/Error.h"
#include "scene/SimulatedRecording.h"
#include "support/frames.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

namespace {

constexpr double fundamental = 57.3;

/// Sixty seconds of equal multiples of a fundamental that drifts, from the tenth second on.
RecordingPointer harmonics(int count, double snrDb, const std::vector<int> &missing = {})
{
    LineScene scene;
    scene.sampleRateHz = 1000.0;
    scene.durationSeconds = 60.0;
    scene.seed = 21;
    for (int k = 1; k <= count; ++k) {
        if (std::find(missing.begin(), missing.end(), k) != missing.end())
            continue;
        LineSettings line;
        line.snrDb = snrDb;
        line.referenceSeconds = 1.0;
        line.startSeconds = 10.0;
        line.frequencyHz = fundamental * k;
        line.driftHzPerSecond = 0.02 * k;
        scene.lines.push_back(line);
    }
    return std::make_shared<SimulatedRecording>(scene);
}

AnalysisSettings familyOf(std::vector<double> members,
                          FamilySettings::Relation relation = FamilySettings::Relation::Harmonics)
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 1.0;
    settings.family.relation = relation;
    settings.family.members = std::move(members);
    return settings;
}

const std::vector<double> eight{1, 2, 3, 4, 5, 6, 7, 8};

} // namespace

/// Lines that are looked for as one, through the whole pipeline.
class tst_families : public QObject
{
    Q_OBJECT

private slots:
    void findsOneFundamental_data();
    void findsOneFundamental();
    void findsTwoFundamentals_data();
    void findsTwoFundamentals();
    void findsSidebandsByTheirCarrier();
    void needsMoreThanOneMember_data();
    void needsMoreThanOneMember();
    void findsFaintMembersOfAStrongLine();
    void ordersFewFalseAlarms();
    void isCalibratedInTheAutomaticWindow();
    void isRefusedWhereLinesAreSingle();
};

void tst_families::findsOneFundamental_data()
{
    QTest::addColumn<double>("snrDb");
    QTest::addColumn<bool>("oneIsMissing");
    QTest::newRow("faint: no line by itself") << -1.0 << false;
    QTest::newRow("strong") << 10.0 << false;
    QTest::newRow("strong, without its third multiple") << 10.0 << true;
    QTest::newRow("very strong") << 30.0 << false;
}

/// One event at the fundamental, none at half, a third or twice of it.
void tst_families::findsOneFundamental()
{
    QFETCH(double, snrDb);
    QFETCH(bool, oneIsMissing);
    const auto recording = harmonics(8, snrDb, oneIsMissing ? std::vector{3} : std::vector<int>{});
    const auto found = events(*analyse(recording, familyOf(eight)));
    QCOMPARE(found.size(), std::size_t(1));
    // In the middle of its track.
    const double expected = fundamental + 0.02 * (0.5 * (found[0].onsetSeconds + found[0].endSeconds) - 10.0);
    QVERIFY2(std::abs(found[0].position[0] - expected) < 0.15, qPrintable(QString::number(found[0].position[0])));
    QVERIFY(std::abs(found[0].onsetSeconds - 10.0) < 6.0);
    QVERIFY(std::abs(found[0].driftPerSecond - 0.02) < 0.01);
    AnalysisSettings alone;
    alone.spectrogram.windowSeconds = 1.0;
    if (snrDb < 0.0)
        QCOMPARE(analyse(recording, alone)->tracks.size(), std::size_t(0));
}

void tst_families::findsTwoFundamentals_data()
{
    QTest::addColumn<double>("ratio");
    QTest::addColumn<double>("snrDb");
    QTest::addColumn<double>("otherSnrDb");
    QTest::newRow("twice") << 2.0 << 4.0 << 4.0;
    QTest::newRow("twice, strong") << 2.0 << 25.0 << 25.0;
    QTest::newRow("twice, faint") << 2.0 << 12.0 << 2.0;
    QTest::newRow("three halves") << 1.5 << 0.0 << 0.0;
    QTest::newRow("three halves, strong") << 1.5 << 25.0 << 25.0;
    QTest::newRow("three halves, faint") << 1.5 << 12.0 << 4.0;
}

/// Two families that share members are two events, and their common fractions and multiples are none.
void tst_families::findsTwoFundamentals()
{
    QFETCH(double, ratio);
    QFETCH(double, snrDb);
    QFETCH(double, otherSnrDb);
    constexpr double lower = 27.4;
    LineScene scene;
    scene.sampleRateHz = 1000.0;
    scene.durationSeconds = 60.0;
    scene.seed = 41;
    for (int k = 1; k <= 8; ++k) {
        LineSettings line{.snrDb = snrDb, .referenceSeconds = 1.0, .startSeconds = 10.0, .frequencyHz = lower * k};
        scene.lines.push_back(line);
        line.snrDb = otherSnrDb;
        line.frequencyHz *= ratio;
        scene.lines.push_back(line);
    }
    const auto found = events(*analyse(std::make_shared<SimulatedRecording>(scene), familyOf(eight)));
    QCOMPARE(found.size(), std::size_t(2));
    for (const double hz : {lower, ratio * lower})
        QVERIFY(
            std::ranges::any_of(found, [hz](const Event &event) { return std::abs(event.position[0] - hz) < 0.15; }));
}

void tst_families::findsSidebandsByTheirCarrier()
{
    LineScene scene;
    scene.sampleRateHz = 1000.0;
    scene.durationSeconds = 60.0;
    scene.seed = 22;
    for (const double hz : {150.0, 200.0, 250.0})
        scene.lines.push_back({.snrDb = 4.0, .referenceSeconds = 1.0, .startSeconds = 10.0, .frequencyHz = hz});
    const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene),
                                  familyOf({-50.0, 0.0, 50.0}, FamilySettings::Relation::Offsets));
    const auto found = events(*analysis);
    QCOMPARE(found.size(), std::size_t(1));
    QVERIFY(std::abs(found[0].position[0] - 200.0) < 0.3);
    QVERIFY(analysis->areas.empty());
}

void tst_families::needsMoreThanOneMember_data()
{
    using Relation = FamilySettings::Relation;
    QTest::addColumn<Relation>("relation");
    QTest::addColumn<std::vector<double>>("members");
    QTest::addColumn<double>("snrDb");
    for (const double snrDb : {8.0, 20.0, 40.0}) {
        const auto row = [&](const char *name, Relation relation, std::vector<double> members) {
            QTest::addRow("%s, %.0f dB", name, snrDb) << relation << std::move(members) << snrDb;
        };
        row("multiples", Relation::Harmonics, eight);
        row("sidebands", Relation::Offsets, {-50.0, 50.0});
        row("sidebands of a carrier", Relation::Offsets, {-50.0, 0.0, 50.0});
        row("in its side lobes", Relation::Offsets, {-3.0, 3.0});
    }
}

/// A line by itself is a member of no family. Events of noise elsewhere may be.
void tst_families::needsMoreThanOneMember()
{
    QFETCH(FamilySettings::Relation, relation);
    QFETCH(std::vector<double>, members);
    QFETCH(double, snrDb);
    LineScene scene;
    scene.sampleRateHz = 1000.0;
    scene.durationSeconds = 60.0;
    scene.lines = {{.snrDb = snrDb, .referenceSeconds = 1.0, .startSeconds = 10.0, .frequencyHz = 211.3}};
    const AnalysisSettings settings = familyOf(members, relation);
    for (scene.seed = 31; scene.seed < 35; ++scene.seed)
        for (const Event &event : events(*analyse(std::make_shared<SimulatedRecording>(scene), settings)))
            for (const double hz : memberFrequencies(settings.family, event.position[0]))
                QVERIFY2(std::abs(hz - 211.3) > 2.0, qPrintable(QString::number(event.position[0])));
}

/// Sidebands that nobody would find alone belong to a line 26 dB above them.
void tst_families::findsFaintMembersOfAStrongLine()
{
    LineScene scene;
    scene.sampleRateHz = 1000.0;
    scene.durationSeconds = 60.0;
    scene.seed = 36;
    for (const double hz : {150.0, 200.0, 250.0})
        scene.lines.push_back(
            {.snrDb = hz == 200.0 ? 28.0 : 2.0, .referenceSeconds = 1.0, .startSeconds = 10.0, .frequencyHz = hz});
    const RecordingPointer recording = std::make_shared<SimulatedRecording>(scene);
    const auto found = events(*analyse(recording, familyOf({-50.0, 0.0, 50.0}, FamilySettings::Relation::Offsets)));
    QCOMPARE(found.size(), std::size_t(1));
    QVERIFY(std::abs(found[0].position[0] - 200.0) < 0.3);
}

/// Half an hour of noise at 40 false alarms an hour: 20 of them.
void tst_families::ordersFewFalseAlarms()
{
    LineScene scene;
    scene.sampleRateHz = 400.0;
    scene.durationSeconds = 1800.0;
    scene.seed = 23;
    AnalysisSettings settings = familyOf({1, 2, 3, 4});
    settings.decide.falseAlarmsPerHour = 40.0;
    const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), settings);
    const auto count = analysis->tracks.size();
    QVERIFY2(count >= 8 && count <= 34, qPrintable(QString::number(count))); // Poisson, 99.8 %
}

/// Distances in Hz are cells of the window in use, whoever has chosen it.
void tst_families::isCalibratedInTheAutomaticWindow()
{
    const RecordingPointer recording = harmonics(1, 0.0);
    AnalysisSettings settings = familyOf({0.0, 4.0}, FamilySettings::Relation::Offsets);
    settings.spectrogram.windowSeconds = 0.0;
    const auto automatic = analyse(recording, settings);
    settings.spectrogram.windowSeconds = automatic->frames->spectrogram()->windowSeconds();
    QCOMPARE(automatic->threshold, analyse(recording, settings)->threshold);
}

void tst_families::isRefusedWhereLinesAreSingle()
{
    AnalysisSettings settings = familyOf({1, 2});
    const auto frames = test::framesOf(30, std::vector<float>(600, 1.0f));
    QVERIFY_EXCEPTION_THROWN(analyse(frames, settings), Error);
    settings.noise.causal = true;
    QVERIFY_EXCEPTION_THROWN(checkSettings(settings), Error);
}

FAINTLINE_TEST(tst_families)
#include "tst_families.moc"
