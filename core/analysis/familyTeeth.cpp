#include "analysis/familyTeeth.h"

#include "analysis/plan.h"
#include "base/Error.h"
#include "spectrum/Spectrogram.h"
#include "spectrum/familyMembers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace faintline {

namespace {

    constexpr float notObserved = std::numeric_limits<float>::quiet_NaN();

    void checkInside(const Analysis &analysis, const PathCell &at)
    {
        if (at.frame < 0 || at.frame >= analysis.time().count || at.cell < 0 || at.cell >= analysis.grid().size())
            throw Error("path at frame " + std::to_string(at.frame) + ", cell " + std::to_string(at.cell),
                        "lies outside the picture");
    }

    /// Reads the members' power in one cell of a family after the other.
    class MemberReader
    {
    public:
        explicit MemberReader(const Analysis &analysis)
            : m_family(analysis.settings.family), m_axis(analysis.grid().axes.back()), m_lines(framesOfLines(analysis)),
              m_innerOnly(m_lines->spectrogram()->hasRealEnds()), m_frame(std::size_t(m_lines->grid().size()))
        {
        }

        /// y of each member; NaN where it was not observed.
        std::vector<float> at(const PathCell &place)
        {
            m_lines->read(place.frame, 1, m_frame);
            std::vector<float> members;
            for (const Index bin :
                 memberBins(m_family, m_axis.value(double(place.cell)), m_lines->grid().axes.back(), m_innerOnly))
                members.push_back(bin < 0 ? notObserved : m_frame[std::size_t(bin)]);
            return members;
        }

    private:
        const FamilySettings &m_family;
        const Axis &m_axis; ///< the family's
        NormalisedFramesPointer m_lines;
        bool m_innerOnly;
        std::vector<float> m_frame;
    };

    /// Adds one frame to all members, whose power in it is `y`.
    void addFrame(std::vector<FamilyTooth> &teeth, std::vector<float> y, FamilySettings::Present present,
                  const Likelihood &likelihood)
    {
        const auto evidence = [&] {
            const float together = familyPower(present, y);
            return std::isnan(together) ? 0.0 : likelihood.at(double(together));
        };
        const double all = evidence();
        for (std::size_t k = 0; k < teeth.size(); ++k) {
            if (std::isnan(y[k]))
                continue;
            teeth[k].frames += 1;
            teeth[k].meanPower += double(y[k]);
            const float own = std::exchange(y[k], notObserved);
            teeth[k].evidence += all - evidence();
            y[k] = own;
        }
    }

} // namespace

std::vector<FamilyTooth> familyTeeth(const Analysis &analysis, std::span<const PathCell> path, std::size_t model,
                                     const RunContext &context)
{
    const FamilySettings &family = analysis.settings.family;
    if (family.isNone() || path.empty())
        return {};
    for (const PathCell &at : path)
        checkInside(analysis, at);
    const std::vector<double> hz =
        memberFrequencies(family, analysis.grid().axes.back().value(double(path.back().cell)));
    std::vector<FamilyTooth> teeth;
    for (std::size_t k = 0; k < hz.size(); ++k)
        teeth.push_back({family.members[k], hz[k]});
    MemberReader reader(analysis);
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (i % 64 == 0)
            context.checkpoint(double(i) / double(path.size()), "evaluating the members");
        addFrame(teeth, reader.at(path[i]), family.present, analysis.modelAt(model).likelihood);
    }
    for (FamilyTooth &tooth : teeth)
        if (tooth.frames > 0)
            tooth.meanPower /= double(tooth.frames);
    return teeth;
}

std::vector<FamilyTooth> familyTeeth(const Analysis &analysis, const Explanation &explanation,
                                     const RunContext &context)
{
    const StateSpace &space = analysis.modelAt(explanation.model).space;
    std::vector<PathCell> path;
    for (const PathStep &step : explanation.steps)
        path.push_back({step.frame, space.cellOf(step.state)});
    return familyTeeth(analysis, path, explanation.model, context);
}

} // namespace faintline
