#include "plan/makeDetector.h"

#include "base/Overloaded.h"
#include "detect/SumDetector.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    Index framesOf(double windows, const FrameGeometry &geometry)
    {
        return Index(std::lround(windows * geometry.framesPerWindow));
    }

} // namespace

const std::vector<Field<SmdSettings>> &SmdSettings::fields()
{
    using S = SmdSettings;
    static const std::vector<Field<S>> table{
        field(&S::reset, "reset", S::resetNames,
              "Choice of K: calibrated on noise for a 50 % reset probability, fixed, regulated to 50 %, or Parsons' "
              "mean law.")
            .labelled("Reset rule")
            .advised("Use calibrated for recordings. Regulation to 50 % follows noise that differs from the model, but "
                     "a strong signal lowers K for all cells. Sources: Billon 2005, section 3; Parsons, equation 8."),
        field(&S::lnK, "lnK", "nat", -100.0, 100.0, "ln K if it is fixed.")
            .labelled("ln K")
            .advanced()
            .advised("Raise it to add evidence over more frames; lower it to forget sooner. Above the calibrated value "
                     "the score of noise grows, and paths begin before their signal."),
    };
    return table;
}

const std::vector<Field<EnergySettings>> &EnergySettings::fields()
{
    static const std::vector<Field<EnergySettings>> none;
    return none;
}

const std::vector<Field<ShiryaevRobertsSettings>> &ShiryaevRobertsSettings::fields()
{
    using S = ShiryaevRobertsSettings;
    static const std::vector<Field<S>> table{
        field(&S::lnK, "lnK", "nat", -100.0, 0.0,
              "Rate at which old evidence fades; 0 is the classical procedure, "
              "which is not stationary on noise.")
            .labelled("ln K")
            .advised("Raise it to add evidence over more frames; lower it to forget sooner."),
    };
    return table;
}

DetectorSettings detectorOfKind(std::size_t index)
{
    return [index]<std::size_t... I>(std::index_sequence<I...>)
    {
        DetectorSettings settings;
        ((I == index ? void(settings.emplace<I>()) : void()), ...);
        return settings;
    }
    (std::make_index_sequence<std::variant_size_v<DetectorSettings>>());
}

Index framesPerDecision(const DetectorSettings &settings, const FrameGeometry &geometry)
{
    const auto *blocks = std::get_if<BlockViterbiSettings>(&settings);
    return blocks ? std::max<Index>(1, framesOf(blocks->durationWindows, geometry)) : 1;
}

std::unique_ptr<Detector> makeDetector(const DetectorSettings &settings, const MarkovModel &model, const Grid &grid,
                                       const FrameGeometry &geometry, const ResetRule &rule)
{
    using Made = std::unique_ptr<Detector>;
    const auto integrator = [&](IntegratorSettings::Shape shape, Index frames) {
        return std::make_unique<Integrator>(grid.size(), shape, frames);
    };
    return std::visit(
        Overloaded{
            [&](const SmdSettings &) -> Made { return std::make_unique<Smd>(model, rule); },
            [&](const PofNSettings &s) -> Made { return std::make_unique<PofN>(grid, s, geometry.binsPerCell); },
            [&](const IntegratorSettings &s) -> Made {
                return integrator(s.shape, framesOf(s.durationWindows, geometry));
            },
            [&](const EnergySettings &) -> Made { return integrator(IntegratorSettings::Shape::Boxcar, 1); },
            [&](const BlockViterbiSettings &s) -> Made {
                return std::make_unique<BlockViterbi>(model, framesOf(s.durationWindows, geometry),
                                                      geometry.blockPhase);
            },
            [&](const ShiryaevRobertsSettings &s) -> Made {
                return std::make_unique<SumDetector>(model, ResetRule{ResetLaw::Fixed, s.lnK});
            },
        },
        settings);
}

} // namespace faintline
