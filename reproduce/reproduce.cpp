#include "reproduce/reproduce.h"

#include "base/Error.h"
#include "reproduce/reproduceBillon.h"
#include "reproduce/reproduceGrossi.h"
#include "reproduce/reproduceParsons.h"

namespace faintline {

const std::vector<Reproducible> &reproducibles()
{
    static const std::vector<Reproducible> list = [] {
        std::vector<Reproducible> all;
        for (const auto &paper : {billonReproducibles(), grossiReproducibles(), parsonsReproducibles()})
            all.insert(all.end(), paper.begin(), paper.end());
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
    std::string known;
    for (const Reproducible &entry : reproducibles()) {
        if (entry.name == name)
            return entry;
        known += (known.empty() ? "" : ", ") + entry.name;
    }
    throw Error("reproduce " + std::string(name), "unknown; choose one of " + known);
}

} // namespace faintline
