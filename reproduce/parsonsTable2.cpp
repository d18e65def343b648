#include "reproduce/parsonsParts.h"

#include "base/Field.h"
#include "base/logmath.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    Reproduction reproduceTable2(const ReproduceOptions &, const RunContext &)
    {
        constexpr double threshold = 9.2;
        Reproduction made{
            "parsons:table2", "Parsons 2008, Table 2: Pd of one ping by conventional processing", "Pd (%)", {}, {}, {}};
        const std::vector<double> snrDb{5.0, 7.0, 9.0};
        const std::vector<double> paper{0.24, 1.5, 30.1};
        const std::vector<double> reference{0.239, 1.518, 28.46};
        const std::vector<double> lastDigit{0.001, 0.001, 0.01};
        Chart chart{made.title, "SNR (dB)", "Pd", false, true, {}};
        Curve theory{"constant added power, threshold 9.2", Curve::Kind::Theory, {}};
        Curve points{"paper", Curve::Kind::Paper, {}};
        const auto pd = [](double db) { return std::min(1.0, std::exp(-(threshold - ratioFromDb(db)))); };
        for (double db = 4.0; db <= 10.0 + 1e-9; db += 0.1)
            theory.points.push_back({db, pd(db), {}});
        for (std::size_t i = 0; i < snrDb.size(); ++i) {
            made.cells.push_back(
                printed(judged(cellOf("conventional", formatNumber(snrDb[i]) + " dB", 100.0 * pd(snrDb[i])),
                               reference[i], lastDigit[i]),
                        paper[i]));
            points.points.push_back({snrDb[i], 0.01 * paper[i], {}});
        }
        chart.curves = {theory, points};
        made.charts.push_back(chart);
        made.notes = {"Closed form: y = noise + S exceeds T with probability e^-(T - S). The paper rounds S: its 1.5 % "
                      "is S = 5, its "
                      "30.1 % is S = 8."};
        return made;
    }

} // namespace

Reproducible parsonsTable2()
{
    return {"parsons:table2", "Parsons 2008, Table 2: Pd of one ping by conventional processing", reproduceTable2};
}

} // namespace faintline
