#pragma once

#include "track/HmmTracker.h"

#include <map>
#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// The other models of a bank, which follow each track beside its own and take over where they explain it better.
///
/// A target changes its model from one frame to the next with a small probability p, as with interacting multiple
/// models (Blom & Bar-Shalom 1988; p = 0.05 is usual). The best path of model j through a track's window is then
///
///   u_j(t, n) = λ + ln K_j + max( max_m [ln P_j(n|m) + u_j(t-1, m)],  max_m [ln P_j(n|m) + u_i(t-1, m)] + ln p )
///
/// where i is the model that follows the track. For each of the last 16 frames and each other model there is one rival,
/// which holds the paths that changed to it in that frame. This is exact as long as a change pays off within 16 frames.
/// When max u_j > max u_i, model j takes over, and model i becomes a rival from then on. A rival continues the track's
/// level as well, less the cost of the change. Cost: that of 16 trackers per track and other model.
class RivalModels
{
public:
    RivalModels() = default;
    /// `models`: those of the bank; they must outlive this.
    explicit RivalModels(std::span<const std::unique_ptr<TrackerModel>> models) : m_models(models) {}

    /// Takes the frame that `tracker` has just taken. Changes the tracker's model if another one is better. Returns
    /// whether the track goes on. lnK: of each model.
    bool update(HmmTracker &tracker, bool goesOn, Index frame, std::span<const float> lambda,
                std::span<const double> lnK);

    /// Removes the rivals of all tracks that do not exist any more.
    void keepOnly(std::span<const HmmTracker> trackers);

    std::map<int, std::vector<HmmTracker>> state() const; ///< without their past
    void setState(const std::map<int, std::vector<HmmTracker>> &state);

private:
    std::span<const std::unique_ptr<TrackerModel>> m_models;
    std::map<int, std::vector<HmmTracker>> m_rivals; ///< by the number of the track
};

} // namespace faintline
