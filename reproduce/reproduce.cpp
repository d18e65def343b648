#include "reproduce/reproduce.h"

#include "base/Error.h"
#include "base/oneLine.h"
#include "reproduce/papers.h"

#include <algorithm>

namespace faintline {

const std::vector<Reproducible> &reproducibles()
{
    static const std::vector<Reproducible> list = [] {
        std::vector<Reproducible> all = billonReproducibles();
        for (const auto &part : {std::vector{grossiStages(), grossiTrajectories(), grossiRadar()}, parsonsChain(),
                                 parsonsFalseAlarms(), parsonsDetection(), std::vector{parsonsTable2()}})
            all.insert(all.end(), part.begin(), part.end());
        for (Reproducible &entry : all)
            entry.run = [run = entry.run](const ReproduceOptions &options, const RunContext &context) {
                Reproduction made = run(options, context);
                judgeTogether(made);
                return made;
            };
        return all;
    }();
    return list;
}

const Reproducible &reproducible(std::string_view name)
{
    const auto found = std::ranges::find(reproducibles(), name, &Reproducible::name);
    if (found == reproducibles().end())
        throw Error("reproduce " + std::string(name),
                    "unknown; choose one of " + listed(reproducibles(), &Reproducible::name));
    return *found;
}

} // namespace faintline
