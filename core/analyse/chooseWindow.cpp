#include "analyse/chooseWindow.h"

#include "analyse/constants.h"
#include "analyse/runAnalysis.h"
#include "plan/Analysis.h"
#include "refine/TrackCurve.h"
#include "refine/otherWindows.h"
#include "refine/ownNoiseLaw.h"
#include "refine/secondLook.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace faintline {

namespace {

    ModelSettings withLaw(ModelSettings model, const ModelSettings &law)
    {
        model.lowestSlope = law.lowestSlope;
        model.highestSlope = law.highestSlope;
        model.slopesPerBin = law.slopesPerBin;
        model.slopeChange = law.slopeChange;
        return model;
    }

    double resolutionHz(const Analysis &analysis)
    {
        return analysis.recording->info().sampleRateHz / analysis.frames->geometry().windowSamples;
    }

    double windowSecondsOf(const Analysis &analysis)
    {
        const double asked = analysis.settings.spectrogram.windowSeconds;
        return asked > 0.0 ? asked : 1.0 / resolutionHz(analysis);
    }

    /// An analysis with tracks only, for comparison with other windows and as a start after a change of the threshold.
    std::shared_ptr<const Analysis> tracksOnly(const Analysis &analysis)
    {
        auto result = std::make_shared<Analysis>();
        static_cast<AnalysisPlan &>(*result) = analysis;
        result->tracks = analysis.tracks;
        result->lnK = analysis.lnK;
        result->unsubtracted = analysis.unsubtracted;
        return result;
    }

    /// Tracks alone, with the parts of another run.
    RunRequest trialRequest(CalibrationDepth calibration, const Analysis *previous = nullptr)
    {
        return AnalysisRequest{.previous = previous, .calibration = calibration, .depth = AnalysisDepth::Trial};
    }

    class WindowSearch
    {
    public:
        WindowSearch(RecordingPointer recording, const AnalysisSettings &asked, CalibrationDepth calibrationDepth,
                     AnalysisDepth depth, RunContext context)
            : m_recording(std::move(recording)), m_asked(asked), m_calibrationDepth(calibrationDepth), m_depth(depth),
              m_context(std::move(context))
        {
        }

        /// Trial of the chosen window; without pictures if it is not T0.
        std::shared_ptr<Analysis> run(const Analysis *previous, const PictureSink &pictures)
        {
            RunRequest request = AnalysisRequest{.previous = previous, .pictures = pictures};
            request.calibration = m_calibrationDepth;
            request.depth = m_depth;
            request.isTrial = true;
            std::shared_ptr<Analysis> automatic = runOnRecording(m_recording, m_asked, request, nextPart());
            m_windowSeconds = windowSecondsOf(*automatic);
            m_cells = double(automatic->grid().size()) * automatic->grid().axes.back().step * m_windowSeconds;
            m_frames = double(automatic->time().count);
            note(m_asked, *automatic);
            if (std::shared_ptr<Analysis> best = shorter(*automatic))
                return best;
            return longer(std::move(automatic));
        }

        /// Results for the other windows, without pictures: those next to T0 and to the chosen one at least, and where
        /// there are signals half the chosen one, which sees one that moves by two cells there 1.5 dB better than it and
        /// a quarter of it do.
        std::vector<std::shared_ptr<const Analysis>> others(const Analysis &chosen)
        {
            const double own = windowSecondsOf(chosen) / m_windowSeconds;
            for (const double step : {1.0 / windowRatio, windowRatio, own / windowRatio, own * windowRatio})
                ask(step);
            if (std::ranges::any_of(m_analyses, [](const auto &analysis) { return isSure(*analysis); }))
                ask(0.5 * own);
            std::vector<std::shared_ptr<const Analysis>> result = m_analyses;
            result.erase(result.begin() + Index(numberOf(windowSecondsOf(chosen))));
            return result;
        }

        WindowChoice choice(const Analysis &chosen) const
        {
            return {m_asked, m_trials, numberOf(m_windowSeconds), numberOf(windowSecondsOf(chosen))};
        }

    private:
        std::size_t numberOf(double windowSeconds) const
        {
            return std::size_t(std::count_if(m_trials.begin(), m_trials.end(), [&](const WindowTrial &trial) {
                return trial.windowSeconds < windowSeconds;
            }));
        }

        /// Any trial may be the last one, so each takes half of the remaining progress.
        RunContext nextPart()
        {
            const double from = std::exchange(m_done, m_done + 0.5 * (1.0 - m_done));
            return m_context.part(from, m_done);
        }

        /// The shortest window that still follows a sufficient share of what the next shorter one follows; null if that
        /// is T0, or none.
        std::shared_ptr<Analysis> shorter(const Analysis &automatic)
        {
            std::shared_ptr<Analysis> best;
            for (double step = 1.0 / windowRatio;
                 m_cells * step >= narrowestBandCells && m_trials.size() < windowTrialLimit; step /= windowRatio) {
                auto trial = tried(step, laws::glide());
                const double kept = shareKept(*trial, best ? *best : automatic);
                m_trials.front().kept = kept;
                if (std::isnan(kept)) // nothing to compare
                    break;
                if (kept >= lostEnergyShare)
                    return best;
                best = std::move(trial);
            }
            return nullptr;
        }

        void ask(double step)
        {
            if (!isTried(step) && isFeasible(step))
                tried(step, step < 1.0 ? laws::glide() : m_asked.model);
        }

        bool isTried(double step) const
        {
            return std::ranges::any_of(m_trials, [&](const WindowTrial &trial) {
                return std::abs(std::log2(trial.windowSeconds / (step * m_windowSeconds))) < 0.5;
            });
        }

        bool isFeasible(double step) const
        {
            return m_cells * step >= narrowestBandCells && isBorne(step, double(OwnNoiseLaw::fewestFrames));
        }

        /// Whether there are enough frames and memory: an automatic window is bounded for any length of recording.
        bool isBorne(double step, double frames) const
        {
            RecordingInfo endless = m_recording->info();
            endless.sampleCount = std::numeric_limits<Index>::max();
            return m_frames / step >= frames && step * m_windowSeconds <= Spectrogram::automaticWindowSeconds(endless);
        }

        std::shared_ptr<Analysis> longer(std::shared_ptr<Analysis> best)
        {
            for (double step = windowRatio;
                 isBorne(step, fewestTrialFrames) && m_trials.size() < windowTrialLimit && isSure(*best);
                 step *= windowRatio) {
                auto trial = tried(step, m_asked.model);
                const double kept = shareKept(*best, *trial);
                (m_trials.end() - 2)->kept = kept;
                if (!(kept >= keptEnergyShare))
                    break;
                best = std::move(trial);
            }
            return best;
        }

        std::shared_ptr<Analysis> tried(double step, const ModelSettings &law)
        {
            AnalysisSettings settings = m_asked;
            settings.spectrogram.windowSeconds = step * m_windowSeconds;
            settings.model = withLaw(m_asked.model, law);
            auto analysis = runOnRecording(m_recording, settings, trialRequest(m_calibrationDepth), nextPart());
            note(settings, *analysis);
            return analysis;
        }

        void note(const AnalysisSettings &settings, const Analysis &analysis)
        {
            const WindowTrial trial{settings, windowSecondsOf(analysis), std::ssize(analysis.tracks),
                                    std::numeric_limits<double>::quiet_NaN()};
            const auto at = Index(numberOf(trial.windowSeconds));
            m_trials.insert(m_trials.begin() + at, trial);
            m_analyses.insert(m_analyses.begin() + at, tracksOnly(analysis));
        }

        static bool isSure(const Analysis &analysis)
        {
            return std::ranges::any_of(analysis.tracks, [limit = analysis.sureStatistic()](const Track &track) {
                return track.peakStatistic >= limit;
            });
        }

        static double shareKept(const Analysis &shorter, const Analysis &longer)
        {
            const auto onAxes = [](const Analysis &analysis) {
                return TracksOnAxes{analysis.tracks, analysis.time(), analysis.grid().axes.back(),
                                    resolutionHz(analysis)};
            };
            return energyKept(onAxes(shorter), onAxes(longer), shorter.sureStatistic());
        }

        RecordingPointer m_recording;
        const AnalysisSettings &m_asked;
        CalibrationDepth m_calibrationDepth;
        AnalysisDepth m_depth;
        RunContext m_context;
        double m_done = 0.0;
        double m_windowSeconds = 0.0; ///< T0
        double m_cells = 0.0;         ///< at T0
        double m_frames = 0.0;
        std::vector<WindowTrial> m_trials;
        std::vector<std::shared_ptr<const Analysis>> m_analyses; ///< for the trials, without pictures
    };

    /// The settings with the window and law of one of the trials; an open window gives T0 anyway.
    AnalysisSettings ofTrial(const WindowChoice &choice, std::size_t number, const AnalysisSettings &settings)
    {
        return number == choice.automatic ? settings : inWindowOf(choice.trials[number], settings);
    }

    /// Asks the other windows; and ever shorter ones, until the next one would not see better what the last one knew
    /// better. Without such an end, or if one does not have more evidence of most tracks of the last one, these change
    /// nothing: bursts have more energy in every shorter window.
    void askWindows(Analysis &found, WindowChoice &choice, const AnalysisSettings &settings,
                    CalibrationDepth calibration, const RunContext &context)
    {
        AskedWindows asked = withOtherWindows(found, found.others, context);
        found.tracks = asked.tracks;
        Analysis shorter;
        static_cast<AnalysisPlan &>(shorter) = found;
        shorter.areas = found.areas;
        shorter.lnK = found.lnK;
        WindowChoice tried = choice;
        const double bandHz = double(found.grid().axes.back().count) * found.grid().axes.back().step;
        while (asked.isTooLong) {
            WindowTrial next = tried.trials.front();
            next.windowSeconds /= windowRatio;
            if (bandHz * next.windowSeconds < narrowestBandCells)
                return;
            next.settings = inWindowOf(next, next.settings);
            next.kept = std::numeric_limits<double>::quiet_NaN();
            const RunContext part = context.part(1.0, 1.0);
            shorter.others.insert(shorter.others.begin(), runOnRecording(found.recording, inWindowOf(next, settings),
                                                                         trialRequest(calibration), part));
            next.tracks = std::ssize(shorter.others.front()->tracks);
            tried.trials.insert(tried.trials.begin(), next);
            ++tried.automatic;
            ++tried.chosen;
            shorter.tracks = std::move(asked.tracks);
            asked = withOtherWindows(shorter, std::span(shorter.others).first(1), part);
            if (!asked.knowsBetter)
                return;
        }
        found.tracks = std::move(asked.tracks);
        found.others.insert(found.others.begin(), shorter.others.begin(), shorter.others.end());
        choice = std::move(tried);
    }

    /// Whether all settings that affect the choice of a window are equal.
    bool asksForTheSame(const AnalysisSettings &a, const AnalysisSettings &b)
    {
        return a.selection == b.selection && a.spectrogram == b.spectrogram && a.noise == b.noise && a.model == b.model
               && a.detector == b.detector;
    }

    struct Extent {
        double low;
        double high;

        bool meets(const Extent &other, double margin) const
        {
            return low <= other.high + margin && other.low <= high + margin;
        }
    };

    /// A track with when and where it is.
    struct Followed {
        const Track &track;
        TrackCurve curve;
        Extent seconds;
        Extent band;

        Followed(const Track &own, const TracksOnAxes &all)
            : track(own), curve(own, all.time, all.frequency), seconds{curve.start(), curve.end()},
              band{std::ranges::min(curve.hz()), std::ranges::max(curve.hz())}
        {
        }

        /// Range of frequencies within a frame of that time.
        Extent around(double at) const
        {
            const auto [low, high] =
                std::minmax({curve.at(at - curve.step()), curve.at(at), curve.at(at + curve.step())});
            return {low, high};
        }
    };

    std::vector<Followed> allFollowed(const TracksOnAxes &all)
    {
        std::vector<Followed> result;
        for (const Track &track : all.tracks)
            result.emplace_back(track, all);
        return result;
    }

    /// Σ r of all tracks near a path.
    double energyNear(const Followed &path, const std::vector<Followed> &tracks, double marginHz)
    {
        double sum = 0.0;
        for (const Followed &other : tracks) {
            const double marginSeconds = std::max(path.curve.step(), other.curve.step());
            if (!other.seconds.meets(path.seconds, marginSeconds) || !other.band.meets(path.band, marginHz))
                continue;
            for (std::size_t i = 0; i < other.curve.count(); ++i) {
                const double at = other.curve.secondsAt(i);
                const double hz = other.curve.hzAt(i);
                if (path.seconds.meets({at, at}, marginSeconds) && path.around(at).meets({hz, hz}, marginHz))
                    sum += double(other.track.smoothed[i].level);
            }
        }
        return sum;
    }

    double weightedMedian(std::vector<std::pair<double, double>> &valuesAndWeights)
    {
        if (valuesAndWeights.empty())
            return std::numeric_limits<double>::quiet_NaN();
        std::sort(valuesAndWeights.begin(), valuesAndWeights.end());
        double half = 0.0;
        for (const auto &[value, weight] : valuesAndWeights)
            half += 0.5 * weight;
        auto at = valuesAndWeights.begin();
        for (double sum = at->second; sum < half && at + 1 != valuesAndWeights.end(); sum += at->second)
            ++at;
        return at->first;
    }

} // namespace

bool leavesWindowToRecording(const AnalysisSettings &settings)
{
    const ModelSettings &model = settings.model;
    return settings.spectrogram.windowSeconds == 0.0 && settings.track.bothWays && canLookTwice(settings)
           && model.motion == Motion::Slopes && model == withLaw(model, ModelSettings());
}

AnalysisSettings inWindowOf(const WindowTrial &trial, AnalysisSettings settings)
{
    settings.spectrogram.windowSeconds = trial.windowSeconds;
    settings.model = withLaw(settings.model, trial.settings.model);
    return settings;
}

AnalysisSettings inWindowOf(const Analysis &analysis, const AnalysisSettings &settings)
{
    const auto &choice = analysis.choice;
    const bool isOther = choice && choice->chosen != choice->automatic && leavesWindowToRecording(settings);
    return isOther ? inWindowOf(choice->trials[choice->chosen], settings) : settings;
}

std::shared_ptr<const Analysis> runInChosenWindow(const RecordingPointer &recording, const AnalysisSettings &settings,
                                                  const AnalysisRequest &request, const RunContext &whole)
{
    const Analysis *previous = request.previous;
    AnalysisRequest wanted = request;
    wanted.statistic = {};
    wanted.statisticBegins = {};
    const RunContext context = whole.part(0.0, request.statistic ? 0.7 : 1.0);
    const bool isChosen = previous && previous->recording == recording && previous->choice
                          && !previous->calibration->isFirstEstimate
                          && asksForTheSame(previous->choice->asked, settings);
    AnalysisSettings asked = settings;
    asked.subtract.lines = false;                                        // does not affect the choice
    const bool isSearchEnough = !isChosen && asked == settings;          // its runs are those that are wanted
    const double searched = isChosen ? 0.0 : isSearchEnough ? 0.7 : 0.4; // shares of the progress
    const double compared = 0.98;
    const double detected = isChosen ? 0.6 : isSearchEnough ? compared : 0.8;
    WindowChoice choice;
    std::vector<std::shared_ptr<const Analysis>> others;
    std::shared_ptr<Analysis> trial;
    if (isChosen) {
        choice = *previous->choice;
        others = previous->others;
    } else {
        WindowSearch search(recording, asked, wanted.calibration, isSearchEnough ? wanted.depth : AnalysisDepth::Trial,
                            context.part(0.0, searched));
        trial = search.run(previous, wanted.pictures);
        others = search.others(*trial);
        choice = search.choice(*trial);
        wanted.previous = trial.get();
    }
    choice.asked = settings;
    const std::shared_ptr<Analysis> found =
        runOnRecording(recording, ofTrial(choice, choice.chosen, settings), wanted, context.part(searched, detected));
    trial = {};
    const auto count = double(others.size());
    if (!isSearchEnough) // after the pictures, which the user waits for
        for (std::size_t i = 0; i < others.size(); ++i) {
            const std::shared_ptr<const Analysis> tried = others[i];
            const RunContext part = context.part(detected, compared).part(double(i) / count, double(i + 1) / count);
            others[i] = runOnRecording(recording, ofTrial(choice, i < choice.chosen ? i : i + 1, settings),
                                       trialRequest(wanted.calibration, tried.get()), part);
        }
    found->others = std::move(others);
    askWindows(*found, choice, settings, wanted.calibration, context.part(compared, 1.0));
    choice.fromOthers = std::count_if(found->tracks.begin(), found->tracks.end(),
                                      [](const Track &track) { return track.windowSeconds > 0.0; });
    found->choice = std::move(choice);
    if (request.statistic) {
        RunRequest again = trialRequest(request.calibration, found.get());
        again.statistic = request.statistic;
        again.statisticBegins = request.statisticBegins;
        runOnRecording(recording, found->settings, again, whole.part(0.7, 1.0));
    }
    return found;
}

double energyKept(const TracksOnAxes &shorter, const TracksOnAxes &longer, double leastStatistic)
{
    const std::vector<Followed> ofShorter = allFollowed(shorter);
    const std::vector<Followed> ofLonger = allFollowed(longer);
    std::vector<std::pair<double, double>> shares;
    for (const Followed &path : ofShorter) {
        if (path.track.peakStatistic < leastStatistic)
            continue;
        const double kept = energyNear(path, ofLonger, shorter.cellHz);
        if (kept > 0.0)
            shares.emplace_back(kept / energyNear(path, ofShorter, shorter.cellHz), double(path.curve.count()));
    }
    return weightedMedian(shares);
}

} // namespace faintline
