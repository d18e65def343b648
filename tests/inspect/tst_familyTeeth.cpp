#include "analyse/analyse.h"
#include "base/Error.h"
#include "inspect/familyTeeth.h"
#include "scene/SimulatedRecording.h"
#include "support/test.h"

#include <boost/math/special_functions/gamma.hpp>

#include <cmath>

using namespace faintline;

namespace {

RecordingPointer lines(const std::vector<double> &hz, double snrDb)
{
    LineScene scene{.sampleRateHz = 1000.0, .durationSeconds = 30.0, .seed = 31};
    for (const double frequency : hz)
        scene.lines.push_back({.snrDb = snrDb, .referenceSeconds = 1.0, .frequencyHz = frequency});
    return std::make_shared<SimulatedRecording>(scene);
}

AnalysisSettings settingsOf(const FamilySettings &family)
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 1.0;
    settings.family = family;
    return settings;
}

/// How the threshold is found does not matter here.
std::shared_ptr<const Analysis> analysed(const RecordingPointer &recording, const FamilySettings &family)
{
    return analyse(recording, settingsOf(family),
                   {.calibration = CalibrationDepth::FirstEstimate, .depth = AnalysisDepth::Tracks});
}

std::vector<PathCell> straightPath(const Analysis &analysis, double hz)
{
    std::vector<PathCell> path;
    for (Index frame = 5; frame < 35; ++frame)
        path.push_back({frame, analysis.grid().axes.back().nearest(hz)});
    return path;
}

/// y of the members together, straight from the definition.
double plainPower(const std::vector<double> &y, FamilySettings::Present present)
{
    double sum = 0.0, largest = 0.0;
    for (const double one : y) {
        sum += one;
        largest = std::max(largest, one);
    }
    if (present == FamilySettings::Present::Together)
        return -std::log(boost::math::gamma_q(double(y.size()), sum));
    return -std::log(1.0 - std::pow(1.0 - std::exp(-largest), double(y.size())));
}

} // namespace

/// A family tooth by tooth, against the lines themselves: an analysis of the same recording without a family.
class tst_familyTeeth : public QObject
{
    Q_OBJECT

private slots:
    void areAsInAPlainComputation_data()
    {
        QTest::addColumn<bool>("areHarmonics");
        QTest::addColumn<bool>("areTogether");
        QTest::newRow("harmonics together") << true << true;
        QTest::newRow("harmonics in turn") << true << false;
        QTest::newRow("offsets together") << false << true;
    }

    void areAsInAPlainComputation()
    {
        QFETCH(bool, areHarmonics);
        QFETCH(bool, areTogether);
        FamilySettings family;
        family.relation = areHarmonics ? FamilySettings::Relation::Harmonics : FamilySettings::Relation::Offsets;
        family.members =
            areHarmonics ? std::vector{1.0, 2.0, 4.0} : std::vector{-20.0, 0.0, 30.0, 1000.0}; // one outside
        family.present = areTogether ? FamilySettings::Present::Together : FamilySettings::Present::InTurn;
        const double at = 61.2;
        const RecordingPointer recording = lines({61.2, 122.4}, 3.0);
        const auto analysis = analysed(recording, family);
        const auto single = analysed(recording, {});
        const std::vector<PathCell> path = straightPath(*analysis, at);
        const std::vector<FamilyTooth> teeth = familyTeeth(*analysis, path);
        QCOMPARE(teeth.size(), family.members.size());

        const Axis &axis = single->grid().axes.back();
        const double hz = analysis->grid().axes.back().value(double(path.front().cell));
        std::vector<float> frame(std::size_t(axis.count));
        std::vector<double> power(teeth.size(), 0.0), evidence(teeth.size(), 0.0);
        constexpr std::size_t inBand = 3;
        for (const PathCell &step : path) {
            single->frames->read(step.frame, 1, frame);
            std::vector<double> y;
            for (std::size_t k = 0; k < inBand; ++k) {
                const double member = areHarmonics ? family.members[k] * hz : hz + family.members[k];
                y.push_back(double(frame[std::size_t(std::lround((member - axis.first) / axis.step))]));
            }
            for (std::size_t k = 0; k < inBand; ++k) {
                std::vector<double> others = y;
                others.erase(others.begin() + std::ptrdiff_t(k));
                power[k] += y[k] / double(path.size());
                evidence[k] += analysis->model.likelihood.at(plainPower(y, family.present))
                               - analysis->model.likelihood.at(plainPower(others, family.present));
            }
        }
        for (std::size_t k = 0; k < teeth.size(); ++k) {
            const FamilyTooth &tooth = teeth[k];
            QCOMPARE(tooth.member, family.members[k]);
            QCOMPARE(tooth.hz, areHarmonics ? family.members[k] * hz : hz + family.members[k]);
            QCOMPARE(tooth.frames, k < inBand ? std::ssize(path) : 0);
            QVERIFY(std::abs(tooth.meanPower - power[k]) < 1e-5 * (1.0 + power[k]));
            QVERIFY2(std::abs(tooth.evidence - evidence[k]) < 0.02 + 2e-3 * std::abs(evidence[k]),
                     qPrintable(QStringLiteral("%1 %2").arg(tooth.evidence).arg(evidence[k])));
        }
    }

    /// Along the track of a family without its third multiple.
    void showWhichMemberIsMissing()
    {
        const auto analysis = analysed(lines({57.3, 114.6, 229.2, 286.5}, 6.0),
                                       {FamilySettings::Relation::Harmonics, {1.0, 2.0, 3.0, 4.0, 5.0}});
        QCOMPARE(analysis->tracks.size(), std::size_t(1));
        std::vector<PathCell> path;
        for (const TrackPoint &point : analysis->tracks[0].points)
            path.push_back({point.frame, point.cell});
        for (const FamilyTooth &tooth : familyTeeth(*analysis, path)) {
            const bool isMissing = tooth.member == 3.0;
            QCOMPARE(tooth.isSeen(), !isMissing);
            const double db = 10.0 * std::log10(tooth.meanPower);
            QVERIFY2(isMissing ? std::abs(db) < 1.5 : db > 3.0, qPrintable(QString::number(db)));
        }
    }

    void areNoneWithoutAFamily()
    {
        const auto analysis = analysed(lines({100.0}, 6.0), {});
        QVERIFY(familyTeeth(*analysis, straightPath(*analysis, 100.0)).empty());
    }

    void refuseWhatIsNotInThePicture()
    {
        const auto analysis = analysed(lines({100.0}, 6.0), {FamilySettings::Relation::Harmonics, {1.0, 2.0}});
        for (const PathCell &outside :
             {PathCell{-1, 0}, PathCell{analysis->time().count, 0}, PathCell{0, analysis->grid().size()}})
            QVERIFY_EXCEPTION_THROWN(familyTeeth(*analysis, std::vector{outside}), Error);
    }
};

FAINTLINE_TEST(tst_familyTeeth)
#include "tst_familyTeeth.moc"
