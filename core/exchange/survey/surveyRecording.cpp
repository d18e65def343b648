#include "exchange/survey/surveyRecording.h"

#include "analyse/chooseWindow.h"
#include "base/files/fileName.h"
#include "base/logmath.h"
#include "base/oneLine.h"
#include "detect/SumDetector.h"
#include "exchange/reviewedText.h"
#include "noise/openFrames.h"
#include "plan/firstSettings.h"
#include "plan/slopeUnit.h"
#include "signal/fileHash.h"
#include "signal/formats/SigmfRecording.h"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>

namespace faintline {

namespace {

    std::vector<std::string> filesOf(const std::string &path, const SurveySettings &settings)
    {
        if (settings.open.rawType.empty() && SigmfRecording::isNamedSo(path))
            try {
                return {SigmfRecording::metaPath(path), SigmfRecording::dataPath(path)};
            } catch (const Error &) { // reported when it is opened
                return {path};
            }
        if (hasEnding(path, ".npy") && std::filesystem::exists(gridPathOf(path)))
            return {path, gridPathOf(path)};
        return {path};
    }

    std::shared_ptr<const Analysis> analyseFrames(const SurveySettings &settings, SurveyRecording &described,
                                                  const RunContext &context)
    {
        const std::string &path = described.file.path;
        if (const auto power = openPower(path)) {
            described.container = power->info().container;
            described.startUnixSeconds = power->info().startUnixSeconds;
        }
        const auto frames = openFrames(path, {settings.analysis.selection, settings.analysis.noise}, context);
        if (!frames->grid().isSpectrum())
            throw Error(path, "contains frames with several axes; a survey requires recordings, or frames with a "
                              "frequency axis only");
        described.durationSeconds = double(frames->time().count) * frames->time().step;
        return analyse(frames, withSlopesInBins(settings.analysis, *frames), context);
    }

    std::shared_ptr<const Analysis> analyseFile(const SurveySettings &settings, SurveyRecording &described,
                                                const RunContext &context)
    {
        const std::string &path = described.file.path;
        if (settings.open.rawType.empty() && holdsFrames(path))
            return analyseFrames(settings, described, context);
        const RecordingPointer recording = openRecording(path, settings.open);
        const RecordingInfo &info = recording->info();
        described.container = info.container;
        described.sampleRateHz = info.sampleRateHz;
        described.durationSeconds = info.durationSeconds();
        if (info.isCentreKnown())
            described.centreHz = info.centreHz;
        described.startUnixSeconds = info.startUnixSeconds;
        return analyseInChosenWindow(recording, withSlopesInBins(withFittedOrder(settings.analysis, info), info),
                                     context, nullptr, {.depth = AnalysisDepth::Tracks});
    }

    void describe(const Analysis &analysis, SurveyRecording &described)
    {
        described.settings = settingsToJson(analysis.settings);
        if (const Spectrogram *spectrogram = analysis.frames->spectrogram())
            described.windowSeconds = spectrogram->windowSeconds();
        described.threshold = analysis.threshold;
        described.unit = statisticUnit(analysis.settings.detector);
        described.lnK = analysis.calibration->lnK;
    }

    std::vector<SurveyPoint> pointsOf(const Analysis &analysis)
    {
        const Axis &axis = analysis.grid().axes.back();
        std::vector<SurveyPoint> points;
        for (const Track &track : analysis.tracks)
            for (const std::size_t i : track.presentPoints()) {
                const double none = std::nan("");
                SurveyPoint point{track.id,
                                  analysis.time().value(double(track.points[i].frame)),
                                  track.positionOf(i, analysis.grid()).back(),
                                  track.points[i].statistic,
                                  none,
                                  none,
                                  none,
                                  none};
                if (!track.smoothed.empty()) {
                    const SmoothedPoint &smoothed = track.smoothed[i];
                    point.low = axis.value(double(smoothed.low));
                    point.high = axis.value(double(smoothed.high));
                    point.presence = double(smoothed.presence);
                    point.snrDb = dbFromRatio(double(smoothed.level));
                }
                points.push_back(point);
            }
        return points;
    }

    SurveyOutcome failed(SurveyOutcome outcome, const std::string &reason)
    {
        outcome.recording.reason = oneLine(reason, longestMessage);
        return outcome;
    }

} // namespace

SurveyFile fileOf(const std::string &path, const SurveySettings &settings)
{
    SurveyFile file{path, 0, 0, {}};
    for (const std::string &one : filesOf(path, settings)) {
        struct stat status = {};
        if (::stat(one.c_str(), &status) != 0)
            continue;
        file.bytes += status.st_size;
        file.modified = std::max(file.modified, std::int64_t(status.st_mtim.tv_sec) * 1'000'000'000
                                                    + std::int64_t(status.st_mtim.tv_nsec));
    }
    return file;
}

std::string hashOf(const SurveyFile &file, const SurveySettings &settings)
{
    std::string hash;
    try {
        for (const std::string &one : filesOf(file.path, settings))
            hash += '+' + fileHash(one);
    } catch (const Error &) {
        return {};
    }
    return hash.substr(std::min<std::size_t>(1, hash.size()));
}

SurveyOutcome surveyRecording(const SurveyFile &file, const SurveySettings &settings, const RunContext &context)
{
    SurveyOutcome outcome;
    SurveyRecording &described = outcome.recording;
    described.file = file;
    try {
        const auto analysis = analyseFile(settings, described, context);
        describe(*analysis, described);
        for (Event &event : events(*analysis)) {
            Annotation box;
            fillBox(*analysis, event, box);
            outcome.events.push_back({std::move(event), std::move(box)});
        }
        outcome.points = pointsOf(*analysis);
        outcome.areas = areaEvents(*analysis);
        return outcome;
    } catch (const Error &error) {
        return failed(outcome, error.where() == file.path ? error.why() : error.what());
    } catch (const std::bad_alloc &) {
        return failed(outcome, "out of memory; choose a shorter part, a narrower band or a shorter window");
    } catch (const Cancelled &) {
        throw;
    } catch (const std::exception &error) {
        return failed(outcome, error.what());
    }
}

} // namespace faintline
