#include "exchange/sequentialCsv.h"
#include "support/test.h"

#include "exchange/csvText.h"

using namespace faintline;

namespace {

SprtResult result(SprtDecision decision, std::vector<double> lnLambda)
{
    SprtResult made;
    made.decision = decision;
    made.stages = std::ssize(lnLambda);
    made.lnLambda = std::move(lnLambda);
    return made;
}

} // namespace

/// A radar's tests as tables, row by row.
class tst_sequentialCsv : public QObject
{
    Q_OBJECT

private slots:
    void walksEndWithTheirDecision()
    {
        QCOMPARE(walksCsv({{{false, 0}, result(SprtDecision::H0, {-1.5, -7.25})},
                           {{true, 4}, result(SprtDecision::H1, {8.0})},
                           {{true, 5}, result(SprtDecision::Undecided, {0.125})}},
                          true),
                 std::string("hypothesis,run,stage,lnLambda,decision\n"
                             "H0,0,1,-1.5,\n"
                             "H0,0,2,-7.25,H0\n"
                             "H1,4,1,8,H1\n"
                             "H1,5,1,0.125,undecided\n"));
    }

    void recordedWalksHaveNoHypothesis()
    {
        QCOMPARE(walksCsv({{{true, 0}, result(SprtDecision::H1, {8.0})}}, false),
                 std::string("hypothesis,run,stage,lnLambda,decision\n,0,1,8,H1\n"));
    }

    // Every fourth stage was kept: rows belong to stages 1, 5, 9.
    void thinnedPosteriorsKeepTheirStages()
    {
        PosteriorPicture picture;
        picture.cells = 2;
        picture.stride = 4;
        picture.probability = {0.25f, 0.75f, 0.5f, 0.5f, 1.0f, 0.0f};
        QCOMPARE(posteriorCsv(picture), std::string("stage,cell,probability\n"
                                                    "1,0,0.25\n1,1,0.75\n5,0,0.5\n5,1,0.5\n9,0,1\n9,1,0\n"));
    }

    void looksOfASurvey()
    {
        ScanTest test;
        test.sectors = 4;
        test.targetSectors = 1; // in the middle: sector number 2 of 0 … 3
        SectorRounds made;
        made.visits = {{0, 1, 0, result(SprtDecision::H0, {-7.0})},
                       {0, 2, 1, result(SprtDecision::H1, {1.0, 2.0, 9.0})},
                       {1, 0, 4, result(SprtDecision::Undecided, {0.0, 0.0})}};
        QCOMPARE(sectorsCsv(test, made), std::string("round,sector,target,first_stage,stages,decision\n"
                                                     "1,2,0,0,1,H0\n"
                                                     "1,3,1,1,3,H1\n"
                                                     "2,1,0,4,2,undecided\n"));
    }

    void nothingButAHeader()
    {
        QCOMPARE(walksCsv({}, true), std::string("hypothesis,run,stage,lnLambda,decision\n"));
        QCOMPARE(walksCsv({{{true, 0}, result(SprtDecision::Undecided, {})}}, true), walksCsv({}, true));
        QCOMPARE(posteriorCsv({}), std::string("stage,cell,probability\n"));
        QCOMPARE(sectorsCsv({}, {}), std::string("round,sector,target,first_stage,stages,decision\n"));
    }

    void quotesAreDoubled()
    {
        QCOMPARE(csvText(""), std::string("\"\""));
        QCOMPARE(csvText("a,b"), std::string("\"a,b\""));
        QCOMPARE(csvText("\"a\" or\n\"b\""), std::string("\"\"\"a\"\" or\n\"\"b\"\"\""));
    }
};

FAINTLINE_TEST(tst_sequentialCsv)
#include "tst_sequentialCsv.moc"
