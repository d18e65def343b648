#include "exchange/sequentialCsv.h"

namespace faintline {

namespace {

    std::string nameOfDecision(SprtDecision decision)
    {
        return std::string(sprtDecisionNames[std::size_t(decision)]);
    }

} // namespace

std::string walksCsv(const std::vector<std::pair<ScanRun, SprtResult>> &walks, bool isSimulated)
{
    std::string csv = "hypothesis,run,stage,lnLambda,decision\n";
    for (const auto &[run, result] : walks)
        for (std::size_t i = 0; i < result.lnLambda.size(); ++i)
            csv += std::string(!isSimulated    ? ""
                               : run.hasTarget ? "H1"
                                               : "H0")
                   + "," + std::to_string(run.number) + "," + std::to_string(i + 1) + ","
                   + formatNumber(result.lnLambda[i]) + ","
                   + (i + 1 == result.lnLambda.size() ? nameOfDecision(result.decision) : "") + "\n";
    return csv;
}

std::string posteriorCsv(const PosteriorPicture &posterior)
{
    std::string csv = "stage,cell,probability\n";
    for (std::size_t i = 0; i < posterior.probability.size(); ++i) {
        const auto index = Index(i);
        csv += std::to_string(index / posterior.cells * posterior.stride + 1) + ","
               + std::to_string(index % posterior.cells) + "," + formatNumber(double(posterior.probability[i])) + "\n";
    }
    return csv;
}

std::string sectorsCsv(const ScanTest &test, const SectorRounds &rounds)
{
    std::string csv = "round,sector,target,first_stage,stages,decision\n";
    for (const SectorVisit &visit : rounds.visits)
        csv += std::to_string(visit.round + 1) + "," + std::to_string(visit.sector + 1) + ","
               + (holdsTarget(test, visit.sector) ? "1" : "0") + "," + std::to_string(visit.firstStage) + ","
               + std::to_string(visit.result.stages) + "," + nameOfDecision(visit.result.decision) + "\n";
    return csv;
}

} // namespace faintline
