#include "refine/familyTracks.h"

#include "frames/Window.h"
#include "frames/familyMembers.h"
#include "refine/bothWays.h"
#include "refine/constants.h"
#include "refine/pathStrips.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr std::size_t blockBytes = std::size_t(1) << 20;
    constexpr std::size_t batchBytes = std::size_t(16) << 20;
    constexpr float missingValue = std::numeric_limits<float>::quiet_NaN();

    /// The members' power in the cells around a track.
    struct Neighbourhood {
        PathStrip strip;      ///< the cells; without y
        std::vector<float> y; ///< frames × cells × members × channels
    };

    class LoneTeeth
    {
    public:
        explicit LoneTeeth(const Analysis &analysis)
            : m_analysis(analysis), m_family(analysis.settings.family), m_axis(analysis.grid().axes.back()),
              m_geometry(analysis.frames->geometry()), m_band(analysis.lines.front()->grid().axes.back()),
              m_channels(analysis.lines.size()), m_values(m_family.members.size() * m_channels),
              m_model(bothWaysModel(analysis))
        {
        }

        Neighbourhood neighbourhoodOf(const Track &track) const
        {
            Neighbourhood around;
            const auto length = Index(track.points.size());
            const Index count = std::min(length, testedFrames);
            const auto from = std::size_t((length - count) / 2);
            around.strip.firstFrame = count > 0 ? track.points[from].frame : track.onsetFrame;
            around.strip.halfWidth = corridorHalfWidth(m_model.binsPerCell);
            for (std::size_t i = from; i < from + std::size_t(count); ++i)
                around.strip.centres.push_back(track.points[i].cell);
            around.y.assign(std::size_t(count * around.strip.width()) * m_values, missingValue);
            return around;
        }

        /// Fills in y for all tracks in one pass over their frames.
        void read(std::span<Neighbourhood> all, const RunContext &context) const
        {
            const Index end = m_analysis.time().count;
            const Index block =
                std::max<Index>(1, Index(blockBytes / sizeof(float)) / (m_band.count * Index(m_channels)));
            for (Index first = 0; first < end; first += block) {
                context.checkpoint(double(first) / double(end), "looking at members alone");
                const Index behind = std::min(first + block, end);
                std::vector<Neighbourhood *> here;
                for (Neighbourhood &around : all)
                    if (const PathStrip &strip = around.strip;
                        strip.firstFrame < behind && strip.firstFrame + strip.frameCount() > first)
                        here.push_back(&around);
                if (!here.empty())
                    readBlock(here, first, behind);
            }
        }

        /// Whether it takes more than one member to explain a track.
        bool isFamily(const Neighbourhood &around)
        {
            setLnK(m_model, m_analysis, around.strip);
            std::size_t strongest = 0;
            double most = -std::numeric_limits<double>::infinity();
            for (std::size_t member = 0; member < m_family.members.size(); ++member)
                if (const double alone = strongestIn(memberAlone(around, member), m_model); alone > most) {
                    most = alone;
                    strongest = member;
                }
            return most < m_analysis.threshold
                   || strongestIn(allBut(around, strongest), m_model) >= leastWithout(strongest, around.strip);
        }

    private:
        std::vector<Index> binsAt(Index cell) const
        {
            return memberBins(m_family, m_axis.value(double(cell)), m_band, m_geometry.hasRealEnds);
        }

        void readBlock(std::span<Neighbourhood *const> all, Index first, Index behind) const
        {
            const auto bins = std::size_t(m_band.count);
            const auto frames = std::size_t(behind - first);
            std::vector<float> lines(m_channels * frames * bins);
            for (std::size_t c = 0; c < m_channels; ++c)
                m_analysis.lines[c]->read(first, behind - first,
                                          std::span(lines).subspan(c * frames * bins, frames * bins));
            for (Neighbourhood *around : all) {
                const PathStrip &strip = around->strip;
                const Index to = std::min(behind, strip.firstFrame + strip.frameCount());
                for (Index frame = std::max(first, strip.firstFrame); frame < to; ++frame)
                    copyFrame(*around, frame - strip.firstFrame, [&](std::size_t c, Index bin) {
                        return lines[(c * frames + std::size_t(frame - first)) * bins + std::size_t(bin)];
                    });
            }
        }

        template <class AnyNeighbourhood>
        auto valuesOf(AnyNeighbourhood &around, Index at, Index i) const
        {
            return std::span(around.y).subspan(std::size_t(at * around.strip.width() + i) * m_values, m_values);
        }

        template <class Power>
        void copyFrame(Neighbourhood &around, Index at, Power powerOf) const
        {
            for (Index i = 0; i < around.strip.width(); ++i) {
                const Index cell = around.strip.firstCell(at) + i;
                if (cell < 0 || cell >= m_axis.count)
                    continue;
                const std::vector<Index> bins = binsAt(cell);
                const std::span<float> values = valuesOf(around, at, i);
                for (std::size_t k = 0; k < bins.size(); ++k)
                    for (std::size_t c = 0; bins[k] >= 0 && c < m_channels; ++c)
                        values[k * m_channels + c] = powerOf(c, bins[k]);
            }
        }

        PathStrip memberAlone(const Neighbourhood &around, std::size_t member) const
        {
            PathStrip strip = around.strip;
            for (Index at = 0; at < strip.frameCount(); ++at)
                for (Index i = 0; i < strip.width(); ++i)
                    strip.y.push_back(familyPower(FamilySettings::Present::Together,
                                                  valuesOf(around, at, i).subspan(member * m_channels, m_channels)));
            return strip;
        }

        PathStrip allBut(const Neighbourhood &around, std::size_t member) const
        {
            PathStrip strip = around.strip;
            for (Index at = 0; at < strip.frameCount(); ++at) {
                const std::vector<Line> lines = linesIn(around, member, at);
                for (Index i = 0; i < strip.width(); ++i)
                    strip.y.push_back(
                        withoutMember(valuesOf(around, at, i), member, lines,
                                      binsAt(std::clamp<Index>(strip.firstCell(at) + i, 0, m_axis.count - 1))));
            }
            return strip;
        }

        /// The peak of a member in one frame and channel.
        struct Line {
            Index bin = 0;
            float power = 1.0f;
        };

        std::vector<Line> linesIn(const Neighbourhood &around, std::size_t member, Index at) const
        {
            std::vector<Line> lines(m_channels);
            for (Index i = 0; i < around.strip.width(); ++i)
                for (std::size_t c = 0; c < m_channels; ++c)
                    if (const float y = valuesOf(around, at, i)[member * m_channels + c]; y > lines[c].power)
                        lines[c] = {binsAt(around.strip.firstCell(at) + i)[member], y};
            return lines;
        }

        float withoutMember(std::span<const float> y, std::size_t member, const std::vector<Line> &lines,
                            const std::vector<Index> &bins) const
        {
            std::vector<float> others(y.begin(), y.end());
            for (std::size_t k = 0; k < bins.size(); ++k)
                for (std::size_t c = 0; c < m_channels; ++c) {
                    float &value = others[k * m_channels + c];
                    value = k == member ? missingValue : value / floorAt(bins[k], lines[c]);
                }
            return familyPower(FamilySettings::Present::Together, others);
        }

        float floorAt(Index bin, const Line &line) const
        {
            const double cells = double(std::abs(bin - line.bin)) / m_model.binsPerCell;
            const double leakage = leakageBound(m_geometry.window, cells);
            return float(1.0 + explainedPowerFactor * double(line.power - 1.0f) * leakage);
        }

        /// The score that noise in all members but this one reaches once per hundred strong lines in this member.
        double leastWithout(std::size_t member, const PathStrip &strip) const
        {
            const double cellsPerBin = familyCellsPerBin(m_family);
            const bool isHarmonic = m_family.relation == FamilySettings::Relation::Harmonics;
            const double perBin = isHarmonic ? cellsPerBin / m_family.members[member] : 1.0;
            const double cells = double(strip.width()) + 2.0 * lineHalfWidthCells * m_model.binsPerCell * perBin;
            const double chances = double(m_family.members.size()) * cells * double(strip.frameCount());
            return m_analysis.calibration->thresholdForEventRate(chanceFamilyProbability / chances);
        }

        const Analysis &m_analysis;
        const FamilySettings &m_family;
        const Axis &m_axis; ///< the family's
        FrameGeometry m_geometry;
        const Axis &m_band; ///< of the members
        std::size_t m_channels;
        std::size_t m_values; ///< per cell
        BothWaysModel m_model;
    };

    bool canBeExplainedByOne(const AnalysisSettings &settings)
    {
        return !settings.family.isNone() && settings.family.present == FamilySettings::Present::Together
               && settings.family.members.size() > 1 && std::holds_alternative<SmdSettings>(settings.detector)
               && settings.model.likelihood != LikelihoodKind::Linear;
    }

} // namespace

std::vector<Track> withoutLoneTeeth(const Analysis &analysis, std::vector<Track> tracks, const RunContext &context)
{
    if (!canBeExplainedByOne(analysis.settings))
        return tracks;
    LoneTeeth look(analysis);
    std::vector<Track> result;
    for (std::size_t first = 0; first < tracks.size();) {
        std::vector<Neighbourhood> all;
        for (std::size_t bytes = 0; first + all.size() < tracks.size() && bytes < batchBytes;
             bytes += all.back().y.size() * sizeof(float))
            all.push_back(look.neighbourhoodOf(tracks[first + all.size()]));
        const auto done = [&](std::size_t track) { return double(track) / double(tracks.size()); };
        look.read(all, context.part(done(first), done(first + all.size())));
        for (const Neighbourhood &around : all) {
            if (look.isFamily(around)) {
                result.push_back(std::move(tracks[first]));
                result.back().id = int(result.size());
            }
            ++first;
        }
    }
    return result;
}

} // namespace faintline
