#include "exchange/ModelFile.h"
#include "support/test.h"

#include "detect/Sprt.h"
#include "noise/openFrames.h"
#include "signal/formats/NumPy.h"
#include "signal/formats/gridFile.h"
#include "support/recordings.h"

#include <limits>

using namespace faintline;
using namespace faintline::test;

namespace {

const char *const example = R"({ "axes": [ { "name": "frequency", "cells": 1000, "cyclic": false,
                  "rates": [-2, -1, 0, 1, 2], "rateChange": [0.3333333333333333, 0.3333333333333333],
                  "round": "halfDown" } ],
      "likelihood": { "kind": "rice", "r0": 0.5 },
      "reset": { "law": "fixed", "lnK": 0.6931471805599453 },
      "initial": "uniform" })";

} // namespace

/// Models, grids and frames from files: the documented keys, their defaults, and refusals that name file and key.
class tst_ModelFile : public QObject
{
    Q_OBJECT

private slots:
    void theDocumentedExample()
    {
        const ModelFile file = model(example);
        QVERIFY(
            (file.model.space.axes()
             == std::vector<KinematicAxis>{
                 {"frequency", 1000, false, -2, 5, {0.3333333333333333, 0.3333333333333333}, {}, Rounding::HalfDown}}));
        QCOMPARE(file.model.space.stateCount(), Index(5000));
        QVERIFY(file.model.likelihood == Likelihood(LikelihoodKind::Rice, 0.5));
        QCOMPARE(file.model.transitionScale, 1.0);
        QCOMPARE(file.reset.law, ResetLaw::Fixed);
        QCOMPARE(file.reset.lnK, 0.6931471805599453);
        QVERIFY(!file.isSum);
    }

    void onlyWhatIsNeeded()
    {
        const ModelFile file = model(R"({"axes": [{"cells": 7}], "likelihood": {"kind": "linear"}})");
        QVERIFY((file.model.space.axes()
                 == std::vector<KinematicAxis>{{"", 7, false, 0, 1, {1.0}, {}, Rounding::HalfDown}}));
        QVERIFY(file.model.likelihood.kind() == LikelihoodKind::Linear);
        QCOMPARE(file.reset.law, ResetLaw::Fixed);
        QCOMPARE(file.reset.lnK, 0.0);
        QVERIFY(!file.isSum);
    }

    void sonarAxes()
    {
        // Slowest first, as the frames' axes.
        const ModelFile file = model(R"({"axes": [{"name": "bearing", "cells": 20, "cyclic": true, "rates": [-1, 0, 1],
                                                   "rateChange": [0.5, 0.25], "round": "trunc"},
                                                  {"name": "range", "cells": 2500, "rates": [3, 4], "rateChange": [1]}],
                                         "likelihood": {"kind": "exponential", "snr": 4},
                                         "reset": {"law": "mean", "K0": 0.25}})");
        const auto &axes = file.model.space.axes();
        QCOMPARE(axes.size(), std::size_t(2));
        QVERIFY((axes[0] == KinematicAxis{"bearing", 20, true, -1, 3, {0.5, 0.25}, {}, Rounding::Trunc}));
        QVERIFY((axes[1] == KinematicAxis{"range", 2500, false, 3, 2, {1.0}, {}, Rounding::HalfDown}));
        QVERIFY(file.model.likelihood == Likelihood(LikelihoodKind::Exponential, 4.0));
        QCOMPARE(file.reset.law, ResetLaw::Mean);
        QCOMPARE(file.reset.k0, 0.25);
    }

    void ratesBelowACell()
    {
        const ModelFile file =
            model(R"({"axes": [{"cells": 20, "rates": [-2, -1, 0, 1, 2], "ratesPerCell": 2, "renormalised": true,
            "rateChange": [0.8, 0.1]}], "likelihood": {"kind": "linear"}})");
        const KinematicAxis &axis = file.model.space.axes().front();
        QCOMPARE(axis.rate(0), -1.0);
        QCOMPARE(axis.phaseCount(), 2);
        QVERIFY(axis.largestLoss() < 1e-12);
    }

    void evidenceOfOnesOwn()
    {
        const ModelFile file = model(R"({"axes": [{"cells": 3}], "likelihood": {"kind": "given"}})");
        QCOMPARE(file.model.likelihood.at(-2.0), -2.0);
    }

    void randomWalk()
    {
        const ModelFile file =
            model(R"({"axes": [{"cells": 8, "step": [0.5, 0.25]}], "likelihood": {"kind": "linear"}})");
        QCOMPARE(file.model.space.axes()[0].step, (std::vector<double>{0.5, 0.25}));
        QCOMPARE(file.model.space.planeCount(), Index(1));
    }

    void stepsThatStayOnTheAxis()
    {
        const ModelFile file =
            model(R"({"axes": [{"cells": 8, "step": "uniform-admissible"}, {"cells": 9, "step": {"gaussian": 0.5}},
                                                  {"cells": 1, "step": "uniform-admissible"}],
                                         "likelihood": {"kind": "linear"}})");
        const auto &axes = file.model.space.axes();
        QCOMPARE(axes[0].step, (std::vector<double>{1.0 / 3.0, 1.0 / 3.0}));
        QVERIFY(axes[0].renormalised && axes[1].renormalised);
        QCOMPARE(axes[0].lnDeparture(0), -std::log(2.0 / 3.0));
        QVERIFY(std::abs(axes[0].lnDeparture(3)) < 1e-15);
        QCOMPARE(axes[1].step, gaussianStep(0.5, 9));
        QCOMPARE(axes[2].step.size(), std::size_t(1));
    }

    void matrix()
    {
        const ModelFile file = model(
            R"({"axes": [{"cells": 2, "transition": [[0.25, 0.75], [0.5, 0.5]]}], "likelihood": {"kind": "linear"}})");
        QCOMPARE(file.model.space.axes()[0].transition, (std::vector<double>{0.25, 0.75, 0.5, 0.5}));
        QVERIFY(file.model.space.axes()[0].isPlaceDependent());
    }

    void sequentialModel()
    {
        writeBytes(path("m.json"),
                   R"({"axes": [{"cells": 3, "step": [0.5, 0.25]}, {"cells": 4, "integrate": true}, {"cells": 2}],
                                       "likelihood": {"kind": "exponential", "snr": 4},
                                       "initial": [0.5, 0.1, 0.1, 0.1, 0.1, 0.1],
                                       "reset": {"law": "none", "semiring": "sum"}})");
        const SequentialModel read = readSequentialModel(path("m.json"));
        QCOMPARE(read.markov.space.stateCount(), Index(6));
        QCOMPARE(read.reduction.frameCells(), Index(24));
        QCOMPARE(read.reduction.foldedCells(), Index(4));
        QCOMPARE(read.initialLaw()[0], 0.5);
        writeBytes(path("m.json"), R"({"axes": [{"cells": 4, "integrate": true}], "likelihood": {"kind": "linear"}})");
        const SequentialModel folded = readSequentialModel(path("m.json"));
        QCOMPARE(folded.initialLaw(), (std::vector<double>{1.0}));
        const FrameCells frames{"y.npy", {2, 3}};
        QVERIFY(contains(errorOf([&] { readSequentialModel(path("m.json"), &frames); }),
                         "has 4 cells, but the frames of y.npy have 2 × 3"));
    }

    void sequentialModelsLoseNothing_data()
    {
        QTest::addColumn<QByteArray>("axes");
        const auto row = [](const char *name, const char *axes) { QTest::newRow(name) << QByteArray(axes); };
        row("slopes",
            R"({"cells": 41, "rates": [-2, -1, 0, 1, 2], "rateChange": [0.3333333333333333, 0.3333333333333333]})");
        row("slopes round a ring",
            R"({"cells": 41, "cyclic": true, "rates": [-2, -1, 0, 1, 2],
                "rateChange": [0.3333333333333333, 0.3333333333333333]})");
        row("law of six digits", R"({"cells": 9, "rates": [-1, 0, 1], "rateChange": [0.333334, 0.333333]})");
        row("sonar", R"({"cells": 7, "cyclic": true, "rates": [-1, 0, 1], "rateChange": [0.5, 0.25], "round": "trunc"},
                        {"cells": 30, "rates": [-3, -2, -1, 0, 1, 2, 3], "rateChange": [0.2, 0.2, 0.1, 0.1],
                         "round": "trunc"})");
        row("list of steps", R"({"cells": 6, "step": [0.5, 0.25]})");
        row("list of steps round a ring", R"({"cells": 6, "cyclic": true, "step": [0.333334, 0.333333]})");
        row("both ways to the same cell", R"({"cells": 2, "cyclic": true, "step": [0.5, 0.25]})");
        row("never staying", R"({"cells": 6, "step": [0, 0.5]})");
        row("admissible",
            R"({"cells": 3, "step": "uniform-admissible"}, {"cells": 5, "step": "uniform-admissible"},
               {"cells": 4, "integrate": true})");
        row("Gaussian", R"({"cells": 20, "step": {"gaussian": 2.5}})");
        row("matrix that loses", R"({"cells": 3, "transition": [[0.2, 0.3, 0], [0.1, 0.1, 0.1], [0, 0, 1]]})");
        row("walk and slopes",
            R"({"cells": 4, "step": [0.6, 0.2]}, {"cells": 12, "rates": [-1, 0, 1], "rateChange": [0.9, 0.05]})");
    }

    void sequentialModelsLoseNothing()
    {
        // Of no evidence ln Λ is 0 at all stages: as E0 e^λ = 1 in every cell, E0[Λ_k] = 1.
        QFETCH(QByteArray, axes);
        writeBytes(path("m.json"), R"({"likelihood": {"kind": "exponential", "snr": 1}, "axes": [)" + axes + "]}");
        const SequentialModel model = readSequentialModel(path("m.json"));
        LikelihoodRatio ratio(model);
        const std::vector<double> lambda(std::size_t(model.reduction.stateCells()), 0.0);
        for (int stage = 0; stage < 200; ++stage)
            QVERIFY2(std::abs(ratio.update(lambda)) < 1e-12,
                     qPrintable(QString("stage %1: %2").arg(stage).arg(ratio.lnLambda())));
    }

    void sequentialRefusals_data()
    {
        QTest::addColumn<QByteArray>("json");
        QTest::addColumn<QString>("message");
        const auto row = [](const char *name, const char *json, const char *message) {
            QTest::newRow(name) << QByteArray(R"({"likelihood": {"kind": "linear"}, )") + json + "}"
                                << QString::fromUtf8(message);
        };
        row("unknown step", R"("axes": [{"cells": 5, "step": "uniform"}])",
            "axes[0].step: must be a list of probabilities, \"uniform-admissible\"");
        row("negative deviation", R"("axes": [{"cells": 5, "step": {"gaussian": -1}}])",
            "axes[0].step.gaussian: must be a standard deviation");
        row("law without end", R"("axes": [{"cells": 1000000000, "step": {"gaussian": 1e9}}])",
            "axes[0].step.gaussian: must be a standard deviation of 0");
        row("more cells than there is memory",
            R"("axes": [{"cells": 1000000000, "integrate": true}, {"cells": 1000000000, "integrate": true}])",
            "axes: give more than 2³¹ cells");
        row("unknown law", R"("axes": [{"cells": 5, "step": {"laplace": 1}}])", "axes[0].step.laplace: unknown");
        row("matrix of different size", R"("axes": [{"cells": 3, "transition": [[1, 0], [0, 1]]}])",
            "as many rows and columns as the axis has cells, 3");
        row("ragged matrix", R"("axes": [{"cells": 2, "transition": [[1, 0], [1]]}])",
            "axes[0].transition: must have as many columns as rows");
        row("matrix of text", R"("axes": [{"cells": 1, "transition": [["1"]]}])",
            "axes[0].transition: must be a list of numbers");
        row("matrix above 1", R"("axes": [{"cells": 1, "transition": [[1.5]]}])",
            "axes[0].transition: holds 1.5; a "
            "probability must lie in 0 … 1");
        row("matrix and steps", R"("axes": [{"cells": 1, "transition": [[1]], "step": [1]}])",
            "has a transition matrix, so");
        row("cyclic matrix", R"("axes": [{"cells": 1, "transition": [[1]], "cyclic": true}])",
            "has a transition matrix, so");
        row("initial of different size", R"("axes": [{"cells": 2}], "initial": [1])",
            "initial: holds 1 probabilities; there are 2 states");
        row("initial that is none", R"("axes": [{"cells": 2}], "initial": [0.5, 0.4])", "initial: adds up to 0.9");
        row("initial as text", R"("axes": [{"cells": 2}], "initial": "centre")", "initial: must be a list of numbers");
        row("all leave", R"("axes": [{"cells": 5, "rates": [1, 2]}])",
            "axes[0].rates: let no target in this cell stay on "
            "the axis: 4");
        row("matrix without a way on", R"("axes": [{"cells": 2, "transition": [[0, 0], [0, 1]]}])",
            "axes[0].transition: row 0 contains only zeros");
        row("integrate no flag", R"("axes": [{"cells": 2, "integrate": 1}])",
            "axes[0].integrate: must be true or false");
        row("scaled transitions", R"("axes": [{"cells": 2}], "scaleTransitions": true)",
            "cannot be used in a sequential test");
    }

    void sequentialRefusals()
    {
        QFETCH(QByteArray, json);
        QFETCH(QString, message);
        writeBytes(path("m.json"), json);
        const std::string said = errorOf([&] { readSequentialModel(path("m.json")); });
        QVERIFY2(said.starts_with(path("m.json")), said.c_str());
        QVERIFY2(contains(said, message.toStdString()), said.c_str());
    }

    void resetLaws_data()
    {
        QTest::addColumn<QByteArray>("more");
        QTest::addColumn<int>("law");
        QTest::addColumn<bool>("isSum");
        QTest::newRow("half") << QByteArray(R"("reset": {"law": "half"})") << int(ResetLaw::Half) << false;
        QTest::newRow("none") << QByteArray(R"("reset": {"law": "none"})") << int(ResetLaw::None) << false;
        QTest::newRow("max") << QByteArray(R"("reset": {"law": "none", "semiring": "max"})") << int(ResetLaw::None)
                             << false;
        QTest::newRow("sum") << QByteArray(R"("reset": {"law": "none", "semiring": "sum"})") << int(ResetLaw::None)
                             << true;
        QTest::newRow("sum outside") << QByteArray(R"("semiring": "sum")") << int(ResetLaw::Fixed) << true;
    }

    void resetLaws()
    {
        QFETCH(QByteArray, more);
        const ModelFile file = model(R"({"axes": [{"cells": 8}], "likelihood": {"kind": "linear"}, )" + more + "}");
        QTEST(int(file.reset.law), "law");
        QTEST(file.isSum, "isSum");
    }

    void scaledTransitions()
    {
        // (1 + ρ)/ρ with ρ = 4.
        const ModelFile file =
            model(R"({"axes": [{"cells": 8}], "likelihood": {"kind": "linear", "snr": 4}, "scaleTransitions": true})");
        QCOMPARE(file.model.transitionScale, 1.25);
    }

    void modelRefusals_data()
    {
        QTest::addColumn<QByteArray>("json");
        QTest::addColumn<QString>("message");
        const auto row = [](const char *name, const char *json, const char *message) {
            QTest::newRow(name) << QByteArray(json) << QString::fromUtf8(message);
        };
        const auto axis = [&](const char *name, const char *json, const char *message) {
            QTest::newRow(name) << QByteArray(R"({"likelihood": {"kind": "linear"}, "axes": [{"cells": 5}, )") + json
                                       + "]}"
                                << QString::fromUtf8(message);
        };
        const auto more = [&](const char *name, const char *json, const char *message) {
            QTest::newRow(name) << QByteArray(R"({"axes": [{"cells": 5}], )") + json + "}"
                                << QString::fromUtf8(message);
        };
        row("no JSON", "{", "is not valid JSON at line 1");
        row("a list", "[]", "must be an object");
        row("no axes", R"({"likelihood": {"kind": "linear"}})", "needs \"axes\", a list of at least one axis");
        row("empty axes", R"({"axes": [], "likelihood": {"kind": "linear"}})", "needs \"axes\"");
        row("axes no list", R"({"axes": {"cells": 5}, "likelihood": {"kind": "linear"}})", "needs \"axes\"");
        row("no likelihood", R"({"axes": [{"cells": 5}]})", "needs \"likelihood\"");
        row("unknown key", R"({"axes": [{"cells": 5}], "likelihood": {"kind": "linear"}, "likelyhood": 1})",
            "likelyhood: unknown; expected one of axes, likelihood");

        axis("axis no object", "5", "axes[1]: must be an object");
        axis("no cells", "{}", "axes[1].cells: must be a whole number, at least 1");
        axis("no whole cells", R"({"cells": 2.5})", "axes[1].cells: must be a whole number, at least 1");
        axis("0 cells", R"({"cells": 0})", "axes[1].cells: must be a whole number, at least 1");
        axis("too many cells", R"({"cells": 1e10})", "axes[1].cells: must be a whole number");
        axis("cells as text", R"({"cells": "5"})", "axes[1].cells: must be a number");
        axis("unknown key in an axis", R"({"cells": 5, "rate": [0]})",
             "axes[1].rate: unknown; expected one of name, cells, cyclic");
        axis("name", R"({"cells": 5, "name": 5})", "axes[1].name: must be a string");
        axis("cyclic", R"({"cells": 5, "cyclic": 1})", "axes[1].cyclic: must be true or false");
        axis("rates with a gap", R"({"cells": 5, "rates": [-1, 1]})",
             "axes[1].rates: must be consecutive integers, ascending");
        axis("rates that fall", R"({"cells": 5, "rates": [1, 0]})",
             "axes[1].rates: must be consecutive integers, ascending");
        axis("half a rate", R"({"cells": 5, "rates": [0.5]})",
             "axes[1].rates: must be consecutive integers, ascending");
        axis("no rate", R"({"cells": 5, "rates": []})", "axes[1].rates: must be a list of numbers");
        axis("rates as text", R"({"cells": 5, "rates": ["1"]})", "axes[1].rates: must be a list of numbers");
        axis("law that is none", R"({"cells": 5, "rates": [0, 1], "rateChange": [0.5, 0.5]})",
             "axes[1].rateChange: h(0) + 2·(h(1) + h(2) + …) is 1.5; it must be 1");
        axis("negative probability", R"({"cells": 5, "rateChange": [1.5, -0.25]})",
             "axes[1].rateChange: holds 1.5; a "
             "probability must lie in 0 … 1");
        axis("step law that is none", R"({"cells": 5, "step": [0.5, 0.3]})",
             "axes[1].step: h(0) + 2·(h(1) + h(2) + …) is 1.1");
        axis("rates and steps", R"({"cells": 5, "rates": [0, 1], "step": [1]})",
             "axes[1]: has both rates and a step law");
        axis("rounding", R"({"cells": 5, "round": "up"})", "axes[1].round: must be one of halfDown, trunc");
        axis("round and round", R"({"cells": 5, "cyclic": true, "rates": [5, 6], "rateChange": [1]})",
             "axes[1]: a step of 6 cells wraps around a cyclic axis of 5");
        axis("too many states", R"({"cells": 1e9})", "model.axes: give more than 2³¹ states");
        axis("overflowing states", R"({"cells": 1e9}, {"cells": 1e9}, {"cells": 1e9}, {"cells": 1e9})",
             "model.axes: give more than 2³¹ states");

        more("no likelihood object", R"("likelihood": "rice")", "needs \"likelihood\"");
        more("unknown kind", R"("likelihood": {"kind": "gauss"})",
             "likelihood.kind: must be one of rice, exponential, linear");
        more("rice without r0", R"("likelihood": {"kind": "rice"})", "likelihood: rice needs \"r0\"");
        more("exponential without snr", R"("likelihood": {"kind": "exponential"})",
             "likelihood: exponential needs \"snr\"");
        more("r0 of 0", R"("likelihood": {"kind": "rice", "r0": 0})",
             "likelihood.r0 = 0: must be a power ratio above 0");
        more("negative snr", R"("likelihood": {"kind": "exponential", "snr": -3})",
             "likelihood.snr = -3: must be a power ratio above 0");
        more("r0 as text", R"("likelihood": {"kind": "rice", "r0": "0.5"})", "likelihood.r0: must be a number");
        more("unknown key in the likelihood", R"("likelihood": {"kind": "rice", "r0": 1, "x": 1})",
             "likelihood.x: unknown; expected one of kind, r0, snr");
        more("unknown law", R"("likelihood": {"kind": "linear"}, "reset": {"law": "never"})",
             "reset.law: must be one of fixed, mean, half, none");
        more("reset no object", R"("likelihood": {"kind": "linear"}, "reset": "none")", "reset: must be an object");
        more("lnK as text", R"("likelihood": {"kind": "linear"}, "reset": {"law": "fixed", "lnK": "0"})",
             "reset.lnK: must be a number");
        more("unknown key in the reset", R"("likelihood": {"kind": "linear"}, "reset": {"K": 1})", "reset.K: unknown");
        more("unknown semiring", R"("likelihood": {"kind": "linear"}, "semiring": "min")",
             "semiring: must be one of max, sum");
        more("sum with Parsons' law",
             R"("likelihood": {"kind": "linear"}, "semiring": "sum", "reset": {"law": "mean"})",
             "reset.law: must be fixed or none if the semiring is sum");
        more("initial", R"("likelihood": {"kind": "linear"}, "initial": [1, 0, 0, 0, 0])",
             "initial: must be \"uniform\" here");
        more("scale without snr", R"("likelihood": {"kind": "linear"}, "scaleTransitions": true)",
             "scaleTransitions: needs \"snr\" in the likelihood");
        more("scale no flag", R"("likelihood": {"kind": "linear"}, "scaleTransitions": 1)",
             "scaleTransitions: must be true or false");
    }

    void modelRefusals()
    {
        QFETCH(QByteArray, json);
        QFETCH(QString, message);
        const std::string said = errorOf([&] { model(json); });
        QVERIFY2(said.starts_with(path("m.json")), said.c_str());
        QVERIFY2(contains(said, message.toStdString()), said.c_str());
        QVERIFY(!contains(said, "\n"));
    }

    void noModel()
    {
        QVERIFY(contains(errorOf([&] { readModelFile(path("none.json")); }), "none.json: no such file"));
    }

    void gridNamesTheAxes()
    {
        writeBytes(path("g.json"),
                   R"({"axes": [{"name": "bearing", "unit": "°", "first": 0, "step": 18, "cyclic": true},
                                                {"name": "range", "unit": "m", "first": 1000, "step": 25.5, "count": 3}],
                                       "time": {"first": 0.5, "step": 10}})");
        const GridFile file = readGridFile(path("g.json"), {7, 20, 3});
        QVERIFY((file.time == Axis{"time", "s", 0.5, 10.0, 7, false}));
        QVERIFY((file.grid == Grid{{{"bearing", "°", 0.0, 18.0, 20, true}, {"range", "m", 1000.0, 25.5, 3, false}}}));

        writeBytes(path("g.json"), R"({"axes": [{}]})"); // all of it has a default
        const GridFile plain = readGridFile(path("g.json"), {7, 20});
        QVERIFY((plain.time == Axis{"time", "s", 0.0, 1.0, 7, false}));
        QVERIFY((plain.grid == Grid{{{"axis 1", "", 0.0, 1.0, 20, false, false}}}));
        for (const GridFile &one : {file, plain}) { // a number does not become a name by being written
            writeBytes(path("again.json"), QByteArray::fromStdString(gridFileText(one)));
            const std::vector<Index> shape =
                one.grid.axes.size() == 2 ? std::vector<Index>{7, 20, 3} : std::vector<Index>{7, 20};
            QVERIFY(readGridFile(path("again.json"), shape).grid == one.grid);
            QVERIFY(readGridFile(path("again.json"), shape).time == one.time);
        }
        QVERIFY(plainGrid({7, 20}).grid == plain.grid);
    }

    void gridRefusals_data()
    {
        QTest::addColumn<QByteArray>("json");
        QTest::addColumn<QString>("message");
        QTest::newRow("no axes") << QByteArray("{}") << "needs \"axes\", one for each of the frames' 2 cell axes";
        QTest::newRow("too few") << QByteArray(R"({"axes": [{}]})")
                                 << "needs \"axes\", one for each of the frames' 2 cell axes";
        QTest::newRow("too many") << QByteArray(R"({"axes": [{}, {}, {}]})") << "needs \"axes\"";
        QTest::newRow("other count") << QByteArray(R"({"axes": [{}, {"count": 4}]})")
                                     << "axes[1].count: is 4, but the frames have 3 cells there";
        QTest::newRow("step of 0") << QByteArray(R"({"axes": [{"step": 0}, {}]})") << "axes[0].step: must be above 0";
        QTest::newRow("step as text") << QByteArray(R"({"axes": [{"step": "1"}, {}]})")
                                      << "axes[0].step: must be a number";
        QTest::newRow("unknown key") << QByteArray(R"({"axes": [{"units": "m"}, {}]})") << "axes[0].units: unknown";
        QTest::newRow("time stands still")
            << QByteArray(R"({"axes": [{}, {}], "time": {"step": 0}})") << "time.step: must be above 0";
        QTest::newRow("time no object") << QByteArray(R"({"axes": [{}, {}], "time": 3})") << "time: must be an object";
    }

    void gridRefusals()
    {
        QFETCH(QByteArray, json);
        QFETCH(QString, message);
        writeBytes(path("g.json"), json);
        const std::string said = errorOf([&] { readGridFile(path("g.json"), {7, 20, 3}); });
        QVERIFY2(said.starts_with(path("g.json")) && contains(said, message.toStdString()), said.c_str());
    }

    void framesReadBack()
    {
        const std::vector<float> values{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
        const NormalisedFramesPointer read = readFrames(frames({2, 2, 3}, values), "");
        QCOMPARE(read->time().count, Index(2));
        QCOMPARE(read->grid().axes.size(), std::size_t(2));
        QCOMPARE(read->grid().size(), Index(6));
        std::vector<float> second(6);
        read->read(1, 1, second);
        QCOMPARE(second, (std::vector<float>{6, 7, 8, 9, 10, 11}));
        // Cells that were not observed are passed on as such.
        std::vector<float> masked = values;
        masked[7] = std::numeric_limits<float>::quiet_NaN();
        readFrames(frames({2, 2, 3}, masked), "")->read(1, 1, second);
        QVERIFY(std::isnan(second[1]) && second[0] == 6.0f && second[2] == 8.0f);
    }

    void framesRefused_data()
    {
        QTest::addColumn<std::vector<Index>>("shape");
        QTest::addColumn<float>("odd"); ///< value of the fourth cell
        QTest::addColumn<QString>("message");
        QTest::newRow("a vector") << std::vector<Index>{6} << 1.0f << "must have the shape (frames, cells…)";
        QTest::newRow("no frame") << std::vector<Index>{0, 6} << 1.0f << "must have the shape (frames, cells…)";
        QTest::newRow("no cell") << std::vector<Index>{6, 0} << 1.0f << "must have the shape (frames, cells…)";
        QTest::newRow("infinite") << std::vector<Index>{2, 3} << std::numeric_limits<float>::infinity()
                                  << "holds inf at position 3";
        QTest::newRow("negative") << std::vector<Index>{2, 3} << -0.5f
                                  << "holds -0.5 at position 3; normalised power must be finite and not negative";
    }

    void framesRefused()
    {
        QFETCH(std::vector<Index>, shape);
        QFETCH(float, odd);
        QFETCH(QString, message);
        Index count = 1;
        for (Index n : shape)
            count *= n;
        std::vector<float> values(std::size_t(count), 1.0f);
        if (count > 3)
            values[3] = odd;
        const std::string said = errorOf([&] { readFrames(frames(shape, values), ""); });
        QVERIFY2(said.starts_with(path("y.npy")) && contains(said, message.toStdString()), said.c_str());
    }

private:
    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }
    ModelFile model(const QByteArray &json) const
    {
        writeBytes(path("m.json"), json);
        return readModelFile(path("m.json"));
    }
    std::string frames(const std::vector<Index> &shape, const std::vector<float> &values) const
    {
        NumPyWriter writer(path("y.npy"), shape);
        writer.write(values);
        writer.finish();
        return path("y.npy");
    }

    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_ModelFile)
#include "tst_ModelFile.moc"
