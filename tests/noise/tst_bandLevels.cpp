#include "noise/bandLevels.h"
#include "support/test.h"

#include "base/Random.h"
#include "noise/CausalBackground.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

namespace {

constexpr Index blockCells = 600;
constexpr Index bands = 4;

/// Noise of ln power 1 in every cell, all of it firm.
BlockBackground block()
{
    BlockBackground made;
    made.lnPower.assign(std::size_t(blockCells), 1.0f);
    made.medians = made.lnPower;
    made.isNoise.assign(std::size_t(blockCells), true);
    made.isFirm = made.isNoise;
    return made;
}

/// Frames of such noise, with a level for each frame and sub-band.
template <class Level>
std::vector<float> frames(Index count, std::uint64_t stream, Level level)
{
    std::vector<float> values(std::size_t(count * blockCells));
    Random(91, stream).exponentials(values);
    for (Index frame = 0; frame < count; ++frame)
        for (Index cell = 0; cell < blockCells; ++cell)
            values[std::size_t(frame * blockCells + cell)] *=
                float(std::exp(1.0 + level(frame, cell * bands / blockCells)));
    return values;
}

double meanOfColumn(const std::vector<float> &levels, Index column)
{
    double sum = 0.0;
    for (std::size_t i = std::size_t(column); i < levels.size(); i += bands + 1)
        sum += double(levels[i]);
    return sum / (double(levels.size()) / (bands + 1));
}

} // namespace

/// Levels of noise in sub-bands: what was put in comes out, within the errors of that many cells.
class tst_bandLevels : public QObject
{
    Q_OBJECT

private slots:
    void levelsAreThoseOfTheFrames()
    {
        constexpr Index count = 400;
        const auto level = [](Index frame, Index) { return frame < count / 2 ? 0.0 : 0.5; };
        const std::vector<float> found = levelsOf(frames(count, 1, level), block(), bands, 1.0);
        QCOMPARE(found.size(), std::size_t(count * (bands + 1)));
        const std::vector<float> early(found.begin(), found.begin() + count / 2 * (bands + 1));
        const std::vector<float> late(found.begin() + count / 2 * (bands + 1), found.end());
        for (Index column = 0; column <= bands; ++column) {
            // Of 150 cells, or 600, in 200 frames.
            const double error = 1.2 / std::sqrt((column == bands ? 600.0 : 150.0) * 200.0);
            QVERIFY2(std::abs(meanOfColumn(early, column)) < 4.5 * error,
                     qPrintable(QString::number(meanOfColumn(early, column))));
            QVERIFY(std::abs(meanOfColumn(late, column) - 0.5) < 4.5 * error);
        }
    }

    void aLoudSubBandIsNotTheWhole()
    {
        const auto level = [](Index, Index band) { return band == 2 ? 2.0 : 0.0; };
        const std::vector<float> found = levelsOf(frames(200, 2, level), block(), bands, 1.0);
        QVERIFY(std::abs(meanOfColumn(found, 2) - 2.0) < 0.04);
        for (const Index column : {Index(0), Index(1), Index(3), bands})
            QVERIFY(std::abs(meanOfColumn(found, column)) < 0.04);
    }

    // A hundred times the noise in cells that the block knows as lines.
    void linesHaveNoSay()
    {
        BlockBackground lines = block();
        std::vector<float> values = frames(50, 3, [](Index, Index) { return 0.0; });
        const std::vector<float> before = levelsOf(values, lines, bands, 1.0);
        for (Index cell = 0; cell < blockCells; cell += 10) {
            lines.isNoise[std::size_t(cell)] = lines.isFirm[std::size_t(cell)] = false;
            for (Index frame = 0; frame < 50; ++frame)
                values[std::size_t(frame * blockCells + cell)] *= 100.0f;
        }
        const std::vector<float> after = levelsOf(values, lines, bands, 1.0);
        for (Index column = 0; column <= bands; ++column)
            QVERIFY(std::abs(meanOfColumn(after, column) - meanOfColumn(before, column)) < 0.02);
    }

    void aSubBandOfLinesGoesWithTheCommonLevel()
    {
        BlockBackground lines = block();
        std::fill_n(lines.isNoise.begin() + 150, 140, false); // ten cells of noise are left of the second sub-band
        lines.isFirm = lines.isNoise;
        const std::vector<float> found = levelsOf(frames(30, 4, [](Index, Index) { return 0.3; }), lines, bands, 1.0);
        for (std::size_t i = 0; i < found.size(); i += bands + 1)
            QVERIFY(found[i + 1] == found[i + bands] && found[i] != found[i + bands]);
    }

    void silenceHasNoLevel()
    {
        std::vector<float> values = frames(3, 5, [](Index, Index) { return 0.0; });
        std::fill_n(values.begin() + blockCells, blockCells, 0.0f);
        const std::vector<float> found = levelsOf(values, block(), bands, 1.0);
        for (Index column = 0; column <= bands; ++column) {
            QVERIFY(found[std::size_t(column)] < levelNotKnown);
            QCOMPARE(found[std::size_t(bands + 1 + column)], levelNotKnown);
            QVERIFY(found[std::size_t(2 * (bands + 1) + column)] < levelNotKnown);
        }
    }

    void withoutSubBandsThereAreNoLevels()
    {
        QVERIFY(levelsOf(frames(3, 6, [](Index, Index) { return 0.0; }), block(), 0, 1.0).empty());
        QVERIFY(levelsOf({}, block(), bands, 1.0).empty());
    }

    void mediansOfColumns()
    {
        const float no = levelNotKnown;
        const std::vector<float> levels{5.0f, no, 1.0f, no, 3.0f, 7.0f, 9.0f, no}; // two columns of four
        QCOMPARE(mediansOf(levels, 2), (std::vector<float>{3.0f, 7.0f}));          // the lower median
        QCOMPARE(mediansOf({no, no}, 2), (std::vector<float>{0.0f, 0.0f}));
        QCOMPARE(mediansOf({}, 3), (std::vector<float>(3, 0.0f)));
    }

    void whatLinesMayMake()
    {
        QCOMPARE(shareOfLines(-1.0f), 0.0f);
        QCOMPARE(shareOfLines(0.02f), 0.0f);
        QVERIFY(std::abs(shareOfLines(0.1f) - 0.08f) < 1e-7f);
        QCOMPARE(shareOfLines(3.0f), 0.15f);
    }

    // One column scatters about 0, the other by a tenth about 1.
    void sureOffsetsAreBeyondTheirDeviation()
    {
        Random random(92, 0);
        std::vector<float> levels;
        for (int i = 0; i < 50; ++i) {
            levels.push_back(float(random.normal()));
            levels.push_back(1.0f + 0.1f * float(random.normal()));
        }
        const LevelOffsets offsets(levels, 2);
        QCOMPARE(offsets.medians, mediansOf(levels, 2));
        QVERIFY(!offsets.isSure[0] && offsets.isSure[1]);
        levels.resize(14); // seven are too few to be sure of anything
        QVERIFY(!LevelOffsets(levels, 2).isSure[1]);
        levels.insert(levels.end(), {0.0f, 1.0f});
        QVERIFY(LevelOffsets(levels, 2).isSure[1]);
    }

    void sureOffsetsAreTakenOff()
    {
        std::vector<float> steady;
        for (int i = 0; i < 21; ++i)
            for (const float level : {1.0f, 0.1f, 0.1f}) // sure, unsure, and the common one
                steady.push_back(level == 1.0f ? level : level + 0.5f * float(i % 3 - 1));
        const LevelOffsets offsets(steady, 3);
        QVERIFY(offsets.isSure[0] && !offsets.isSure[1] && !offsets.isSure[2]);
        std::vector<float> levels{1.5f, 0.25f, 0.75f, levelNotKnown, 0.25f, levelNotKnown};
        removeOffsets(levels, {offsets}, {0, 0});
        QVERIFY(std::abs(levels[0] - 0.5f) < 1e-6f);
        QVERIFY(std::abs(levels[1] - (0.25f - shareOfLines(offsets.medians[1]))) < 1e-6f);
        QCOMPARE(levels[2], 0.75f); // of what is common lines make nothing
        QCOMPARE(levels[3], levelNotKnown);
        QCOMPARE(levels[5], levelNotKnown);
        std::vector<float> same{1.0f};
        removeOffsets(same, {}, {});
        QCOMPARE(same, std::vector<float>{1.0f});
    }

    // Ten cells in three sub-bands of 3, 3 and 4; nothing of the second is noise.
    void meansOverARow()
    {
        std::vector<float> upper;
        std::vector<float> lower;
        std::vector<bool> isNoise;
        for (int cell = 0; cell < 10; ++cell) {
            upper.push_back(float(cell * cell));
            lower.push_back(float(cell));
            isNoise.push_back(cell < 2 || cell > 6);
        }
        const std::vector<double> means = meanOver(upper.data(), lower.data(), isNoise.begin(), 10, 3);
        QCOMPARE(means.size(), std::size_t(4));
        QCOMPARE(means[0], 0.0); // 0 and 1 differ from their squares by nothing
        QVERIFY(std::abs(means[2] - (42.0 + 56.0 + 72.0) / 3.0) < 1e-9);
        QVERIFY(std::abs(means[3] - (42.0 + 56.0 + 72.0) / 5.0) < 1e-9);
        QCOMPARE(means[1], means[3]); // it goes with the whole
        const std::vector<bool> none(10, false);
        QCOMPARE(meanOver(upper.data(), lower.data(), none.begin(), 10, 3), std::vector<double>(4, 0.0));
    }

    // A step far beyond the scatter counts at once, of one sub-band as of all.
    void causalLevelsFollowAStep()
    {
        CausalLevels levels(2, 0.05, 0.1);
        QCOMPARE(levels.latest(), (std::vector<float>{0.0f, 0.0f}));
        for (int frame = 0; frame < 300; ++frame)
            levels.push(std::vector<float>{0.0f, 0.0f, 0.0f});
        levels.push(std::vector<float>{5.0f, 5.0f, 5.0f});
        for (const float level : levels.latest())
            QVERIFY2(std::abs(level - 5.0f) < 0.1f, qPrintable(QString::number(double(level))));
        for (int frame = 0; frame < 300; ++frame)
            levels.push(std::vector<float>{5.0f, 5.0f, 5.0f});
        levels.push(std::vector<float>{5.0f, 9.0f, 5.0f});
        QVERIFY(std::abs(levels.latest()[0] - 5.0f) < 0.01f);
        QVERIFY(std::abs(levels.latest()[1] - 9.0f) < 0.1f);
        levels.moveBy(std::vector<double>{1.0, 1.0, 1.0}); // the background has become lower
        QVERIFY(std::abs(levels.latest()[0] - 6.0f) < 0.01f);
    }

    void causalLevelsAverageSteadyNoise()
    {
        constexpr double scatter = 0.1;
        CausalLevels levels(1, scatter, scatter);
        Random random(93, 0);
        double squares = 0.0;
        constexpr int frames = 2000;
        for (int frame = 0; frame < 300 + frames; ++frame) {
            const auto common = float(2.0 + scatter * random.normal());
            levels.push(std::vector<float>{common + float(scatter * random.normal()), common});
            if (frame >= 300)
                squares += std::pow(double(levels.latest().front()) - 2.0, 2.0) / frames;
        }
        // Two means of 128 values would scatter by 0.0125; each frame's own by 0.14.
        QVERIFY2(std::sqrt(squares) < 0.04, qPrintable(QString::number(std::sqrt(squares))));
        QVERIFY(std::sqrt(squares) > 0.005);
    }

    void silenceKeepsTheLevelBeforeIt()
    {
        CausalLevels heard(1, 0.1, 0.1);
        CausalLevels silent(1, 0.1, 0.1);
        for (int frame = 0; frame < 700; ++frame) {
            const float level = frame < 400 ? 1.0f : 3.0f;
            heard.push(std::vector<float>{level, level});
            silent.push(frame % 5 == 4 ? std::vector<float>{levelNotKnown, levelNotKnown}
                                       : std::vector<float>{level, level});
        }
        QVERIFY(std::abs(silent.latest().front() - 3.0f) < 0.01f);
        QVERIFY(silent.latest() == heard.latest()); // the step was not within a silence
    }
};

FAINTLINE_TEST(tst_bandLevels)
#include "tst_bandLevels.moc"
