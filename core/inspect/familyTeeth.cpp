#include "inspect/familyTeeth.h"

#include "base/Error.h"
#include "frames/familyMembers.h"

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

    /// Reads the members' power in successive cells of a family.
    class MemberReader
    {
    public:
        explicit MemberReader(const Analysis &analysis)
            : m_analysis(analysis), m_family(familyOrLine(analysis.settings.family)),
              m_axis(analysis.grid().axes.back()), m_channels(analysis.lines)
        {
        }

        std::size_t channelCount() const { return m_channels.size(); }
        std::vector<double> hzAt(Index cell) const { return memberFrequencies(m_family, m_axis.value(double(cell))); }
        const FamilySettings &family() const { return m_family; }

        /// y of each member, channel by channel; NaN if not observed.
        std::vector<float> at(const PathCell &place)
        {
            const Axis &band = m_channels.front()->grid().axes.back();
            const std::vector<Index> bins = memberBins(m_analysis.settings.family, m_axis.value(double(place.cell)),
                                                       band, m_analysis.frames->geometry().hasRealEnds);
            std::vector<float> members(bins.size() * channelCount());
            m_frame.resize(std::size_t(band.count));
            for (std::size_t c = 0; c < channelCount(); ++c) {
                m_channels[c]->read(place.frame, 1, m_frame);
                for (std::size_t k = 0; k < bins.size(); ++k)
                    members[k * channelCount() + c] = bins[k] < 0 ? notObserved : m_frame[std::size_t(bins[k])];
            }
            return members;
        }

    private:
        const Analysis &m_analysis;
        FamilySettings m_family;
        const Axis &m_axis; ///< the family's
        const std::vector<NormalisedFramesPointer> &m_channels;
        std::vector<float> m_frame;
    };

    std::vector<FamilyTooth> emptyTeeth(const MemberReader &reader, Index cell, const std::vector<int> &channels)
    {
        const std::vector<double> hz = reader.hzAt(cell);
        std::vector<FamilyTooth> teeth;
        for (std::size_t k = 0; k < hz.size(); ++k)
            for (const int channel : channels)
                teeth.push_back({reader.family().members[k], hz[k], channels.size() > 1 ? channel : -1});
        return teeth;
    }

    /// Adds one frame with member powers `y` to all members.
    void addFrame(std::vector<FamilyTooth> &teeth, std::vector<float> y, const MemberReader &reader,
                  const Likelihood &likelihood)
    {
        const auto evidence = [&] {
            const float together = familyPower(reader.family().present, y, reader.channelCount());
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
    if (!analysis.settings.family.isSum(int(analysis.lines.size())) || path.empty())
        return {};
    for (const PathCell &at : path)
        checkInside(analysis, at);
    MemberReader reader(analysis);
    std::vector<FamilyTooth> teeth =
        emptyTeeth(reader, path.back().cell, channelsOf(analysis.settings.selection, analysis.recording->info()));
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (i % 64 == 0)
            context.checkpoint(double(i) / double(path.size()), "evaluating the members");
        addFrame(teeth, reader.at(path[i]), reader, analysis.modelAt(model).likelihood);
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
