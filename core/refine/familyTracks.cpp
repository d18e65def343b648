#include "refine/familyTracks.h"

#include "frames/Family.h"
#include "frames/Window.h"
#include "frames/familyMembers.h"
#include "refine/bothWays.h"
#include "refine/constants.h"
#include "refine/explanation.h"
#include "refine/pathStrips.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

namespace faintline {

namespace {

    constexpr std::size_t batchValues = std::size_t(1) << 22; ///< of strips read in one pass

    /// A track, or a piece of a long one: an empty strip along its path.
    struct FamilyPiece {
        const Track *track;
        PathStrip path;

        /// Its share of the track's.
        double statistic() const
        {
            return track->peakStatistic * double(path.centres.size()) / double(track->points.size());
        }
    };

    void addPieces(std::vector<FamilyPiece> &pieces, const Track &track, Index halfWidth)
    {
        const std::size_t length = track.points.size();
        const std::size_t count = (length + piecesFromFrames - 1) / piecesFromFrames;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t from = i * length / count;
            PathStrip &path = pieces.emplace_back(&track, PathStrip{}).path;
            path.firstFrame = track.points[from].frame;
            path.halfWidth = halfWidth;
            for (std::size_t at = from; at < (i + 1) * length / count; ++at)
                path.centres.push_back(track.points[at].cell);
        }
    }

    class FamilyQuestion
    {
    public:
        explicit FamilyQuestion(const Analysis &analysis)
            : m_analysis(analysis), m_family(analysis.settings.family), m_lines(familyFrames(analysis.lines, {})),
              m_model(bothWaysModel(analysis)), m_explanations(m_lines->grid().size(), leakage(), leakage())
        {
        }

        /// Of each piece, the strongest first, whether it is a family of its own.
        std::vector<bool> answers(std::span<const FamilyPiece> pieces, const RunContext &context)
        {
            std::vector<bool> result;
            const auto done = [&](std::size_t piece) { return double(piece) / double(pieces.size()); };
            while (result.size() < pieces.size()) {
                const std::size_t first = result.size();
                std::vector<PathStrip> members;
                std::size_t end = first;
                for (std::size_t values = 0; end < pieces.size() && values < batchValues; ++end) {
                    addMembers(members, pieces[end].path);
                    values +=
                        m_family.members.size() * std::size_t(members.back().frameCount() * members.back().width());
                }
                readStrips(*m_lines, members, context.part(done(first), done(end)), "looking at members alone");
                for (std::span<const PathStrip> left = members; !left.empty();
                     left = left.subspan(m_family.members.size()))
                    result.push_back(isFamily(pieces[result.size()].statistic(), pieces[result.size()].path,
                                              left.first(m_family.members.size())));
            }
            return result;
        }

    private:
        /// Upper bound of the window's leakage over a distance in bins.
        std::function<double(double)> leakage() const
        {
            return [geometry = m_lines->geometry()](double bins) {
                return leakageBound(geometry.window, bins / geometry.binsPerCell);
            };
        }

        std::vector<Index> binsAt(Index cell) const
        {
            return memberBins(m_family, m_analysis.grid().axes.back().value(double(cell)), m_lines->grid().axes.back(),
                              m_lines->geometry().hasRealEnds);
        }

        /// Appends empty strips of single lines along the members of a path.
        void addMembers(std::vector<PathStrip> &members, const PathStrip &path) const
        {
            const std::size_t first = members.size();
            members.resize(first + m_family.members.size(), {path.firstFrame, path.halfWidth, {}, {}, {}});
            for (const Index cell : path.centres) {
                const std::vector<Index> bins = binsAt(cell);
                for (std::size_t k = 0; k < bins.size(); ++k)
                    members[first + k].centres.push_back(bins[k]);
            }
        }

        /// Explains what it finds.
        bool isFamily(double statistic, const PathStrip &path, std::span<const PathStrip> members)
        {
            setLnK(m_model, m_analysis, path);
            bool isRaised = false;
            const std::vector<PathStrip> rest = overFloor(path, members, isRaised);
            if (isRaised && strongestIn(together(path, rest), m_model) < ghostStatisticShare * statistic)
                return false;
            if (m_family.present == FamilySettings::Present::Together && members.size() > 1) {
                std::vector<double> alone;
                for (const PathStrip &member : rest)
                    alone.push_back(strongestIn(member, m_model));
                const auto strongest = std::ranges::max_element(alone);
                if (*strongest >= m_model.threshold)
                    explain(members[std::size_t(strongest - alone.begin())]);
            }
            const PathStrip all = together(path, overFloor(path, members, isRaised));
            if (isRaised && strongestIn(all, m_model) < m_model.threshold)
                return false;
            for (const PathStrip &member : members)
                explain(member);
            return true;
        }

        /// The members along a path, in the family's cells, over the floor of what is explained.
        std::vector<PathStrip> overFloor(const PathStrip &path, std::span<const PathStrip> members,
                                         bool &isRaised) const
        {
            std::vector<PathStrip> result(members.size(), path);
            for (Index at = 0; at < path.frameCount(); ++at)
                for (Index i = 0; i < path.width(); ++i) {
                    const std::vector<Index> bins = binsAt(path.firstCell(at) + i);
                    for (std::size_t k = 0; k < bins.size(); ++k) {
                        float y = members[k].valueAt(at, bins[k]);
                        float floor = 1.0f;
                        m_explanations.read(path.firstFrame + at, bins[k], std::span(&floor, 1));
                        m_explanations.hide(path.firstFrame + at, bins[k], std::span(&y, 1),
                                            std::numeric_limits<float>::quiet_NaN());
                        result[k].y.push_back(y / floor);
                        isRaised = isRaised || floor > 1.0f;
                    }
                }
            return result;
        }

        PathStrip together(PathStrip strip, const std::vector<PathStrip> &members) const
        {
            std::vector<float> y(members.size());
            for (std::size_t i = 0; i < members.front().y.size(); ++i) {
                std::ranges::transform(members, y.begin(), [i](const PathStrip &member) { return member.y[i]; });
                strip.y.push_back(familyPower(m_family.present, y));
            }
            return strip;
        }

        /// Raises the floor by a member, in each frame as strong as its peak beside the path.
        void explain(const PathStrip &member)
        {
            ExplainedSignal signal;
            signal.firstFrame = member.firstFrame;
            signal.hides = hiddenCells * m_model.binsPerCell;
            for (Index at = 0; at < member.frameCount(); ++at) {
                Index peak = member.centres[std::size_t(at)];
                for (Index bin = member.firstCell(at); bin < member.firstCell(at) + member.width(); ++bin)
                    if (member.valueAt(at, bin) > member.valueAt(at, peak))
                        peak = bin;
                signal.positions.push_back(double(peak));
                signal.levels.push_back(std::max(0.0f, member.valueAt(at, peak) - 1.0f));
            }
            m_explanations.add(std::move(signal));
        }

        const Analysis &m_analysis;
        const FamilySettings &m_family;
        NormalisedFramesPointer m_lines; ///< all channels of a line as one
        BothWaysModel m_model;
        Explanations m_explanations; ///< of these lines
    };

} // namespace

std::vector<Track> familiesOfTheirOwn(const Analysis &analysis, std::vector<Track> tracks, const RunContext &context)
{
    if (analysis.settings.family.isNone())
        return tracks;
    std::vector<const Track *> order;
    for (const Track &track : tracks)
        order.push_back(&track);
    std::ranges::stable_sort(order, std::greater(), &Track::peakStatistic);
    std::vector<FamilyPiece> pieces;
    for (const Track *track : order)
        addPieces(pieces, *track, Index(std::ceil(ownPowerCells * analysis.frames->geometry().binsPerCell)));
    const std::vector<bool> answers = FamilyQuestion(analysis).answers(pieces, context);
    std::vector<bool> isKept(tracks.size());
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (answers[i])
            isKept[std::size_t(pieces[i].track - tracks.data())] = true;
    std::vector<Track> result;
    for (std::size_t i = 0; i < tracks.size(); ++i)
        if (isKept[i]) {
            result.push_back(std::move(tracks[i]));
            result.back().id = int(result.size());
        }
    return result;
}

} // namespace faintline
