#include "exchange/ModelFile.h"

#include "base/json.h"
#include "base/oneLine.h"
#include "detect/SumDetector.h"
#include "signal/formats/jsonFields.h"

#include <algorithm>
#include <cmath>

namespace faintline {

using namespace jsonFields;

namespace {

    std::vector<double> numbers(const Json &object, const std::string &where, const std::string &key)
    {
        const auto found = object.find(key);
        if (found == object.end())
            return {};
        std::vector<double> result;
        if (found->is_array())
            for (const Json &value : *found)
                if (value.is_number())
                    result.push_back(value.get<double>());
        if (!found->is_array() || result.size() != found->size() || result.empty())
            throw Error(jsonName(where, key), "must be a list of numbers");
        return result;
    }

    void readRates(KinematicAxis &axis, const std::vector<double> &rates, const std::string &where)
    {
        for (std::size_t i = 0; i < rates.size(); ++i)
            if (rates[i] != std::floor(rates[i]) || std::abs(rates[i]) > 1000.0
                || (i > 0 && rates[i] != rates[i - 1] + 1.0))
                throw Error(where + ".rates", "must be consecutive integers, ascending");
        if (rates.empty())
            return;
        axis.firstRate = int(rates.front());
        axis.rateCount = int(rates.size());
    }

    void readStep(KinematicAxis &axis, const Json &json, const std::string &where)
    {
        const auto step = json.find("step");
        if (step == json.end() || step->is_array()) {
            axis.step = numbers(json, where, "step");
            return;
        }
        axis.renormalised = true;
        if (*step == "uniform-admissible") {
            axis.step.assign(axis.cells > 1 ? 2 : 1, 1.0 / 3.0);
            return;
        }
        if (!step->is_object())
            throw Error(where + ".step",
                        "must be a list of probabilities, \"uniform-admissible\" or {\"gaussian\": cells}");
        checkKeys(*step, where + ".step", {"gaussian"});
        constexpr double deviationLimitCells = 1e5; // the law has nine times as many values
        const double deviation = number(*step, where + ".step", "gaussian", -1.0);
        if (!(deviation >= 0.0 && deviation <= deviationLimitCells))
            throw Error(where + ".step.gaussian",
                        "must be a standard deviation of 0 … " + formatNumber(deviationLimitCells) + " cells");
        axis.step = gaussianStep(deviation, axis.cyclic ? (axis.cells + 1) / 2 : axis.cells);
    }

    std::vector<double> readMatrix(const Json &json, const std::string &where)
    {
        std::vector<double> matrix;
        const auto found = json.find("transition");
        if (found == json.end())
            return matrix;
        if (!found->is_array() || found->empty() || found->size() > 4096)
            throw Error(where + ".transition", "must be a list of at most 4096 rows of numbers, P(from, to)");
        for (const Json &row : *found) {
            const std::vector<double> values = numbers(Json{{"transition", row}}, where, "transition");
            if (values.size() != found->size())
                throw Error(where + ".transition", "must have as many columns as rows");
            matrix.insert(matrix.end(), values.begin(), values.end());
        }
        return matrix;
    }

    KinematicAxis readAxis(const Json &json, const std::string &where, bool mayFold = false)
    {
        std::vector<std::string> known{"name",       "cells", "cyclic", "rates",      "ratesPerCell",
                                       "rateChange", "step",  "round",  "transition", "renormalised"};
        if (mayFold)
            known.push_back("integrate");
        checkKeys(json, where, known);
        KinematicAxis axis;
        axis.name = text(json, where, "name", "");
        const double cells = number(json, where, "cells", 0.0);
        if (!(cells >= 1.0 && cells <= 1e9 && cells == std::floor(cells)))
            throw Error(where + ".cells", "must be a whole number, at least 1");
        axis.cells = Index(cells);
        axis.cyclic = flag(json, where, "cyclic");
        readRates(axis, numbers(json, where, "rates"), where);
        const double perCell = number(json, where, "ratesPerCell", 1.0);
        if (!(perCell >= 1.0 && perCell <= 64.0 && perCell == std::floor(perCell)))
            throw Error(where + ".ratesPerCell", "must be a whole number, 1 … 64");
        axis.ratesPerCell = int(perCell);
        if (json.contains("rateChange"))
            axis.rateChange = numbers(json, where, "rateChange");
        axis.renormalised = flag(json, where, "renormalised");
        readStep(axis, json, where);
        axis.transition = readMatrix(json, where);
        axis.rounding = static_cast<Rounding>(choice(json, where, "round", roundingNames, 0));
        axis.check(where);
        return axis;
    }

    std::string cellsText(const std::vector<Index> &cells)
    {
        return listed(
            cells, [](Index n) { return std::to_string(n); }, " × ");
    }

    /// Checks what all models have.
    void checkModel(const Json &json, const std::string &path)
    {
        checkKeys(json, path, {"axes", "likelihood", "reset", "initial", "semiring", "scaleTransitions"});
        if (!json.contains("axes") || !json["axes"].is_array() || json["axes"].empty())
            throw Error(path, "needs \"axes\", a list of at least one axis");
        constexpr std::size_t mostAxes = 8; // the law of one axis may take megabytes
        if (json["axes"].size() > mostAxes)
            throw Error(path + ": axes", "must be at most " + std::to_string(mostAxes));
        if (!json.contains("likelihood") || !json["likelihood"].is_object())
            throw Error(path, "needs \"likelihood\", such as {\"kind\": \"rice\", \"r0\": 0.5}");
    }

    /// Those of the settings, and likelihood ratios computed elsewhere.
    constexpr std::array<std::string_view, 5> modelLikelihoodNames{"rice", "exponential", "linear", "swerling4",
                                                                   "given"};

    Likelihood readLikelihood(const Json &json, const std::string &path)
    {
        const Json &object = json["likelihood"];
        const std::string where = path + ": likelihood";
        checkKeys(object, where, {"kind", "r0", "snr"});
        const auto kind = static_cast<LikelihoodKind>(choice(object, where, "kind", modelLikelihoodNames, 2));
        const double snr = number(object, where, "r0", number(object, where, "snr", 1.0));
        if (kind == LikelihoodKind::Rice && !object.contains("r0") && !object.contains("snr"))
            throw Error(where, "rice needs \"r0\", the signal-to-noise ratio as a power ratio");
        const bool fluctuates = kind == LikelihoodKind::Exponential || kind == LikelihoodKind::Swerling4;
        if (fluctuates && !object.contains("snr") && !object.contains("r0"))
            throw Error(where, std::string(modelLikelihoodNames[std::size_t(kind)]) + " needs \"snr\", a power ratio");
        if (!(snr > 0.0 && snr < 1e12))
            throw Error(where + (object.contains("r0") ? ".r0" : ".snr") + " = " + formatNumber(snr),
                        "must be a power ratio above 0");
        return Likelihood(kind, snr);
    }

} // namespace

std::unique_ptr<PathDetector> makePathDetector(const ModelFile &file)
{
    if (file.isSum)
        return std::make_unique<SumDetector>(file.model, file.reset);
    return std::make_unique<Smd>(file.model, file.reset);
}

ModelFile readModelFile(const std::string &path)
{
    return modelFromJson(readJsonFile(path), path);
}

KinematicAxis kinematicAxisFromJson(const Json &json, const std::string &where)
{
    return readAxis(json, where);
}

ModelFile modelFromJson(const Json &json, const std::string &path)
{
    checkModel(json, path);
    std::vector<KinematicAxis> axes;
    for (std::size_t i = 0; i < json["axes"].size(); ++i)
        axes.push_back(readAxis(json["axes"][i], path + ": axes[" + std::to_string(i) + "]"));

    const Likelihood likelihood = readLikelihood(json, path);
    ModelFile file;
    const bool scales = flag(json, path, "scaleTransitions");
    if (scales && !json["likelihood"].contains("r0") && !json["likelihood"].contains("snr"))
        throw Error(path + ": scaleTransitions", "needs \"snr\" in the likelihood");
    const double scale = scales ? (1.0 + likelihood.snr()) / likelihood.snr() : 1.0;
    file.model = inFile(path, [&] { return MarkovModel{StateSpace(std::move(axes)), likelihood, scale}; });
    if (json.contains("initial") && json["initial"] != "uniform")
        throw Error(path + ": initial", "must be \"uniform\" here");
    file.isSum = choice(json, path, "semiring", std::array<std::string_view, 2>{"max", "sum"}, 0) == 1;
    if (json.contains("reset")) {
        const Json &reset = json["reset"];
        const std::string place = path + ": reset";
        checkKeys(reset, place, {"law", "lnK", "K0", "gain", "semiring"});
        file.reset.law = static_cast<ResetLaw>(choice(reset, place, "law", resetLawNames, 0));
        file.reset.lnK = number(reset, place, "lnK", 0.0);
        file.reset.k0 = number(reset, place, "K0", 0.0);
        file.reset.gain = number(reset, place, "gain", file.reset.gain);
        file.isSum =
            file.isSum || choice(reset, place, "semiring", std::array<std::string_view, 2>{"max", "sum"}, 0) == 1;
    }
    if (file.isSum && file.reset.law != ResetLaw::Fixed && file.reset.law != ResetLaw::None)
        throw Error(path + ": reset.law", "must be fixed or none if the semiring is sum");
    return file;
}

SequentialModel readSequentialModel(const std::string &path, const FrameCells *frames)
{
    const Json json = readJsonFile(path);
    checkModel(json, path);
    std::vector<KinematicAxis> axes;
    std::vector<bool> isFolded;
    std::vector<Index> cells;
    for (std::size_t i = 0; i < json["axes"].size(); ++i) {
        const std::string where = path + ": axes[" + std::to_string(i) + "]";
        axes.push_back(readAxis(json["axes"][i], where, true));
        isFolded.push_back(flag(json["axes"][i], where, "integrate"));
        cells.push_back(axes.back().cells);
    }
    if (frames && frames->cells != cells)
        throw Error(path, "has " + cellsText(cells) + " cells, but the frames of " + frames->path + " have "
                              + cellsText(frames->cells));
    std::vector<double> initial;
    if (json.contains("initial") && json["initial"] != "uniform")
        initial = numbers(json, path, "initial");
    const Likelihood likelihood = readLikelihood(json, path);
    if (json.contains("scaleTransitions") && json["scaleTransitions"] != false)
        throw Error(path + ": scaleTransitions",
                    "cannot be used in a sequential test, whose likelihood ratio is exact");
    return inFile(path, [&] { return makeSequentialModel(axes, isFolded, likelihood, std::move(initial)); });
}

} // namespace faintline
