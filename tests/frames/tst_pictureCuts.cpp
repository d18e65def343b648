#include "frames/pictureCuts.h"
#include "support/test.h"

using namespace faintline;

namespace {

/// Two pings of 3 ranges × 2 bearings.
Grid grid()
{
    return {{{"range", "m", 100.0, 10.0, 3, false}, {"bearing", "°", 0.0, 180.0, 2, true}}};
}

std::shared_ptr<const PeakPyramid> pings(std::size_t budget = std::size_t(1) << 20)
{
    auto picture = std::make_shared<PeakPyramid>(Axis{"time", "s", 0.0, 40.0, 2, false}, 6,
                                                 ByteScale(ByteScale::Kind::ScoreNats), budget);
    picture->append(std::vector<float>{1, 2, 3, 4, 5, 6, 10, 9, 8, 7, 6, 5});
    picture->finish();
    return picture;
}

std::vector<double> valuesOf(const PeakPyramid &picture)
{
    std::vector<double> values;
    for (Index row = 0; row < picture.rowCount(0); ++row)
        for (const std::uint8_t byte : picture.row(0, row))
            values.push_back(picture.scale().value(byte));
    return values;
}

} // namespace

class tst_pictureCuts : public QObject
{
    Q_OBJECT

private slots:
    void alongAnAxisIsTheMaximumOverTheOther()
    {
        const auto ranges = pictureAlong(*pings(), grid(), 0);
        QCOMPARE(ranges->cells(), Index(3));
        QCOMPARE(valuesOf(*ranges), (std::vector<double>{2, 4, 6, 10, 8, 6}));
        QCOMPARE(ranges->time().step, 40.0);
        const auto bearings = pictureAlong(*pings(), grid(), 1);
        QCOMPARE(bearings->cells(), Index(2));
        QCOMPARE(valuesOf(*bearings), (std::vector<double>{5, 6, 10, 9}));
    }

    void aFrameKeepsItsCells()
    {
        const auto frame = pictureOfFrame(*pings(), grid(), 1);
        QCOMPARE(frame->time(), grid().axes[0]);
        QCOMPARE(frame->cells(), Index(2));
        QCOMPARE(valuesOf(*frame), (std::vector<double>{10, 9, 8, 7, 6, 5}));
        // Beyond the end the last one stands.
        QCOMPARE(valuesOf(*pictureOfFrame(*pings(), grid(), 7)), valuesOf(*frame));
    }

    /// Every pair of axes, with maxima and with cuts, against loops over all cells.
    void planesOfFourAxes()
    {
        const Grid scan{{{"range", "m", 0.0, 1.0, 3, false},
                         {"bearing", "°", 0.0, 1.0, 4, true},
                         {"elevation", "°", 0.0, 1.0, 2, false},
                         {"Doppler", "m/s", 0.0, 1.0, 5, false}}};
        std::vector<float> values;
        for (Index cell = 0; cell < scan.size(); ++cell)
            values.push_back(0.25f * float(7 * cell % scan.size() % 60)); // steps of the scale, in no order
        PeakPyramid picture(Axis{"time", "s", 0.0, 1.0, 1, false}, scan.size(), ByteScale(ByteScale::Kind::ScoreNats));
        picture.append(values);
        picture.finish();
        for (std::size_t along = 0; along < 4; ++along)
            for (std::size_t across = 0; across < 4; ++across)
                for (int cuts = 0; along != across && cuts < 4; ++cuts) {
                    FramePlane plane{along, across, {2, 3, 1, 4}};
                    for (std::size_t axis = 0, hidden = 0; axis < 4; ++axis)
                        if (!plane.isShown(axis) && !(cuts >> hidden++ & 1))
                            plane.cuts[axis].reset();
                    std::vector<double> expected(std::size_t(scan.axes[along].count * scan.axes[across].count), -1e9);
                    for (Index cell = 0; cell < scan.size(); ++cell) {
                        const std::vector<Index> at = scan.coordinates(cell);
                        bool isCutAway = false;
                        for (std::size_t axis = 0; axis < 4; ++axis)
                            isCutAway |= plane.cutOf(axis) && *plane.cutOf(axis) != at[axis];
                        double &most = expected[std::size_t(at[along] * scan.axes[across].count + at[across])];
                        if (!isCutAway)
                            most = std::max(most, double(values[std::size_t(cell)]));
                    }
                    const auto frame = pictureOfFrame(picture, scan, 0, plane);
                    QCOMPARE(frame->time(), scan.axes[along]);
                    QCOMPARE(valuesOf(*frame), expected);
                    const Index behind = strongestCell(picture, scan, 0, plane, 1, 1);
                    const std::vector<Index> at = scan.coordinates(behind);
                    QVERIFY(at[along] == 1 && at[across] == 1);
                    QCOMPARE(double(values[std::size_t(behind)]), expected[std::size_t(scan.axes[across].count + 1)]);
                }
    }

    void mergedFramesAreShownAsTheirMaximum()
    {
        auto picture = std::make_shared<PeakPyramid>(Axis{"time", "s", 0.0, 1.0, 16, false}, 6,
                                                     ByteScale(ByteScale::Kind::ScoreNats), 40);
        for (int frame = 0; frame < 16; ++frame)
            picture->append(std::vector<float>(6, float(frame)));
        picture->finish();
        QVERIFY(picture->framesPerRow(0) > 1);
        const auto last = double(picture->framesPerRow(0) - 1);
        QCOMPARE(valuesOf(*pictureOfFrame(*picture, grid(), 0)).front(), last);
        const auto ranges = pictureAlong(*picture, grid(), 0);
        QCOMPARE(ranges->time().first, 0.5 * last); // in the middle of what it stands for
        QCOMPARE(ranges->frameCount() * picture->framesPerRow(0), Index(16));
    }

    void rowsAndColumnsAsAPicture()
    {
        const auto picture = pictureOf(grid().axes[0], grid().axes[1], std::vector<float>{0, 1, 2, 3, 4, 5},
                                       ByteScale(ByteScale::Kind::ScoreNats));
        QCOMPARE(picture->rowCount(0), Index(3));
        QCOMPARE(valuesOf(*picture), (std::vector<double>{0, 1, 2, 3, 4, 5}));
    }
};

FAINTLINE_TEST(tst_pictureCuts)
#include "tst_pictureCuts.moc"
