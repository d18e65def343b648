#include "plan/AnalysisSettings.h"

#include "base/Error.h"
#include "base/oneLine.h"

namespace faintline {

ModelSettings laws::billon()
{
    ModelSettings model;
    model.lowestSlope = -2.0;
    model.highestSlope = 2.0;
    model.slopesPerBin = 1;
    model.slopeChange = {1.0 / 3.0, 1.0 / 3.0};
    return model;
}

ModelSettings laws::steady()
{
    ModelSettings model;
    model.lowestSlope = model.highestSlope = 0.0;
    model.slopesPerBin = 1;
    model.slopeChange = {1.0};
    return model;
}

ModelSettings laws::glide()
{
    ModelSettings model;
    model.lowestSlope = -4.0;
    model.highestSlope = 4.0;
    model.slopesPerBin = 2;
    model.slopeChange = {0.8, 0.1};
    return model;
}

namespace {

    /// Straight lines of up to 4 Hz/s.
    ModelSettings driftingLaw()
    {
        ModelSettings model;
        model.slopeUnit = SlopeUnit::HzPerSecond;
        model.lowestSlope = -4.0;
        model.highestSlope = 4.0;
        model.slopesPerBin = 4;
        model.slopeChange = {0.98, 0.01};
        return model;
    }

    /// Targets on more than two axes, whose rates on each are small: every rate more is a factor of the states.
    AnalysisSettings radarSettings(AnalysisSettings sonar)
    {
        sonar.model.motion = Motion::Slopes;
        sonar.model.lowestSlope = -1.0;
        sonar.model.highestSlope = 1.0;
        sonar.model.slopeChange = {0.8, 0.1};
        sonar.decide.thresholdNats = 30.0; // more cells, and more paths that leave a track's box
        sonar.decide.linkCells = {2.0, 1.0};
        sonar.decide.inhibitCells = {2.0, 1.0};
        sonar.decide.forgetCells = {4.0, 1.0};
        sonar.track.windowCells = {4.0, 1.0};
        return sonar;
    }

    /// Parsons' chain, with the constants of docs/theory.md, *Active sonar*.
    AnalysisSettings sonarSettings()
    {
        AnalysisSettings sonar;
        sonar.model = laws::billon(); // if slopes are selected instead: two axes of fine ones would have 289 pairs
        sonar.model.motion = Motion::Manoeuvring;
        sonar.model.likelihood = LikelihoodKind::Linear;
        sonar.detector = SmdSettings{SmdSettings::Reset::Mean, 0.0};
        sonar.decide.by = DecideSettings::By::Nats;
        sonar.decide.thresholdNats = 24.0;
        sonar.decide.linkCells = {3.0, 1.0};
        sonar.decide.inhibitCells = {3.0, 1.0};
        sonar.decide.forgetCells = {12.0, 1.0};
        sonar.track.windowCells = {12.0, 1.0};
        sonar.track.decayNats = 0.5;
        sonar.track.ceilingNats = 10.0;
        sonar.track.endNats = 8.0;
        sonar.track.confirmNats = 6.0;
        sonar.track.confirmFrames = 3;
        return sonar;
    }

} // namespace

const std::vector<Preset> &presets()
{
    static const std::vector<Preset> list = [] {
        std::vector<Preset> all;
        all.push_back({"lines",
                       "Lines that drift and wander: slopes of 1/8 bin with inertia, window chosen from the recording.",
                       {}});

        AnalysisSettings billon;
        billon.model = laws::billon();
        billon.spectrogram.window = WindowShape::Rectangular;
        billon.spectrogram.binsPerCell = 4;
        all.push_back(
            {"billon", "Settings of Billon's tables: rectangular window, k_t = 2, k_f = 4, five slopes.", billon});

        AnalysisSettings steady;
        steady.model = laws::steady();
        all.push_back({"steady", "Lines that stay within their bin: one slope, the longest integration.", steady});

        AnalysisSettings strong;
        strong.spectrogram.window = WindowShape::BlackmanHarris;
        all.push_back(
            {"strong", "Faint lines beside very strong ones: a window with side lobes below -92 dB.", strong});

        AnalysisSettings whistles;
        whistles.model = laws::glide();
        AnalysisSettings sonar = sonarSettings();
        all.push_back({"sonar", "Active sonar, targets that turn: Parsons' manoeuvring model.", sonar});
        const AnalysisSettings radar = radarSettings(sonar);
        sonar.model.motion = Motion::NonManoeuvring;
        sonar.decide.thresholdNats = 40.0;
        sonar.track.decayNats = 1.0;
        all.push_back(
            {"sonarSteady", "Active sonar, targets that keep their rates: Parsons' non-manoeuvring model.", sonar});
        sonar.model.motion = Motion::Bank;
        all.push_back({"sonarBank", "Active sonar, both models in parallel at equal false-alarm probability.", sonar});

        all.push_back({"radar",
                       "Radar scans on up to four axes: targets that move by at most one cell per scan on each.",
                       radar});

        AnalysisSettings narrowband;
        narrowband.model = driftingLaw();
        all.push_back({"narrowband",
                       "Drifting narrow-band signals of spacecraft and the like: slopes of up to 4 Hz/s that hardly "
                       "change.",
                       narrowband});

        all.push_back({"whistles",
                       "Fast sweeps such as whistles and calls: slopes of half a bin to four bins per frame.",
                       whistles});
        return all;
    }();
    return list;
}

const Preset &preset(std::string_view name)
{
    const auto found = std::ranges::find(presets(), name, &Preset::name);
    if (found == presets().end())
        throw Error("preset " + std::string(name), "unknown; choose one of " + listed(presets(), &Preset::name));
    return *found;
}

} // namespace faintline
