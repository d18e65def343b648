#include "app/document/AnalysisController.h"

#include "analyse/chooseWindow.h"
#include "app/base/filePath.h"
#include "calibrate/calibrate.h"
#include "evaluate/experiments/scaledInjection.h"
#include "exchange/Session.h"
#include "noise/noiseMean.h"
#include "noise/pings/NormalisedPings.h"
#include "plan/slopeUnit.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    /// Rounds a dragged value to three digits, within the range of the field.
    double rounded(double value, const char *field)
    {
        const FieldInfo &info = settingField(field);
        return std::clamp(QString::number(value, 'g', 3).toDouble(), info.minimum, info.maximum);
    }

    /// The settings that place the threshold at this value.
    DecideSettings decideAt(DecideSettings decide, DecideSettings::By by, double nats, const AnalysisPlan &analysis)
    {
        decide.by = by;
        switch (by) {
        case DecideSettings::By::FalseAlarmsPerHour:
            decide.falseAlarmsPerHour = rounded(analysis.calibration->eventRateAt(nats) * analysis.cellFramesPerHour,
                                                "decide.falseAlarmsPerHour");
            break;
        case DecideSettings::By::PfaPerCell:
            decide.pfaPerCell = rounded(analysis.calibration->exceedanceAt(nats), "decide.pfaPerCell");
            break;
        case DecideSettings::By::Nats:
            decide.thresholdNats = std::round(nats * 100.0) / 100.0;
            break;
        }
        return decide;
    }

    /// What was assumed of ready-made frames, or is wrong with them; empty if nothing was.
    QString doubtAbout(const OpenedSource &opened)
    {
        if (!opened.frames)
            return {};
        if (const std::string guess = pingGuess(*opened.frames); !guess.empty())
            return QString::fromStdString(guess);
        return opened.source.isStack() ? QString::fromStdString(noiseMeanWarning(*opened.frames)) : QString();
    }

    /// Whether noise exceeds a threshold too rarely for the rate to be set.
    bool isBeyondRates(DecideSettings::By by, double nats, const AnalysisPlan &analysis)
    {
        if (by == DecideSettings::By::FalseAlarmsPerHour)
            return analysis.calibration->eventRateAt(nats) * analysis.cellFramesPerHour
                   < settingField("decide.falseAlarmsPerHour").minimum;
        return by == DecideSettings::By::PfaPerCell
               && analysis.calibration->exceedanceAt(nats) < settingField("decide.pfaPerCell").minimum;
    }

} // namespace

AnalysisController::AnalysisController(Document &document, QObject *parent) : QObject(parent), m_document(document)
{
    connect(&m_document, &Document::settingsChanged, this, &AnalysisController::run);
    connect(&m_document.viewport(), &Viewport::spanChanged, this, &AnalysisController::dropPartialPreview);
    connect(&m_document, &Document::opened, this, [this] { m_kept.reset(); });
    connect(&m_runner, &JobRunner::busyChanged, this, [this](bool isBusy) {
        if (isBusy)
            emit busyChanged(true);
    });
    connect(&m_runner, &JobRunner::finished, this, &AnalysisController::end);
    connect(&m_runner, &JobRunner::cancelled, this, &AnalysisController::end);
    connect(&m_runner, &JobRunner::failed, this, [this](const Error &error) {
        emit failed(error);
        end();
    });
}

void AnalysisController::open(const QString &path, const OpenOptions &options, const Adjust &adjust)
{
    open(path, options, adjust, {});
}

/// `annotations`: those of the open recording, if it is opened again.
void AnalysisController::open(const QString &path, const OpenOptions &options, const Adjust &adjust,
                              const Annotations &annotations)
{
    m_isOpening = true;
    m_runner.start([this, path, options, adjust, annotations](const RunContext &context) -> JobRunner::Delivery {
        context.checkpoint(0.0, "opening");
        Opening opening = openNow(path, options, context.part(0.0, 0.9));
        if (adjust)
            adjust(opening.settings);
        if (opening.annotations.isEmpty())
            opening.annotations = annotations;
        return [this, opening = std::move(opening)] { deliver(opening); };
    });
}

void AnalysisController::reopen(const OpenOptions &options)
{
    open(
        m_document.sourcePath(), options, [now = m_document.settings()](AnalysisSettings &settings) { settings = now; },
        m_document.annotations());
}

void AnalysisController::edit(const QString &field, const FieldValue &value, const QString &text)
{
    AnalysisSettings after = m_document.settings();
    settingField(field.toStdString()).set(after, value);
    if (const SlopeUnit unit = after.model.slopeUnit;
        unit != m_document.settings().model.slopeUnit && m_document.recording()) {
        after.model = m_document.settings().model; // the same slopes in the other unit
        after.model = withSlopesIn(unit, after.model, hzPerSecondOfABinAFrame(after, m_document.recording()->info()));
    }
    m_document.edit(after, text, field);
}

void AnalysisController::editNumber(const QString &field, double value)
{
    const bool isWhole = settingField(field.toStdString()).kind == FieldKind::Integer;
    edit(field, isWhole ? FieldValue(int(std::lround(value))) : FieldValue(value),
         tr("Apply a value of "
            "the sweep"));
}

void AnalysisController::setSettings(const AnalysisSettings &settings, const QString &text)
{
    m_document.edit(settings, text);
}

void AnalysisController::inject(const LineSettings &line)
{
    if (!m_document.recording() || m_isOpening || !m_document.takesAnalyses())
        return;
    const OpenedSource opened = m_document.openedSource();
    m_runner.start(
        [this, opened, line, settings = m_document.settings()](const RunContext &context) -> JobRunner::Delivery {
            const Source::Injection injection{scaledInjection(line, opened.recording, settings, context),
                                              settings.selection.channel, opened.source.injections.size() + 1};
            OpenedSource injected = withInjection(opened, injection);
            return [this, injected = std::move(injected)] { m_document.replaceOpened(injected, tr("Inject a line")); };
        });
}

void AnalysisController::setThresholdUnit(DecideSettings::By by)
{
    if (!m_document.plan() || m_document.settings().decide.by == by)
        return;
    AnalysisSettings after = m_document.settings();
    after.decide = decideAt(after.decide, by, m_document.shownThreshold(), *m_document.plan());
    m_document.edit(after, tr("Change the unit of the threshold"));
}

void AnalysisController::run()
{
    if (m_document.takesAnalyses() && !m_isOpening)
        startAnalysis();
}

void AnalysisController::startAnalysis()
{
    m_firstEstimate.reset();
    m_runner.start([this, opened = m_document.openedSource(), settings = m_document.analysedSettings(),
                    previous = m_document.analysis(), visible = m_document.lookedAt(), kept = m_kept,
                    showsFirstEstimates = m_showsFirstEstimates,
                    numbers = m_document.numbers()](const RunContext &context) mutable -> JobRunner::Delivery {
        if (const bool isSame =
                previous
                && (opened.recording ? previous->recording == opened.recording : previous->frames == opened.frames);
            isSame && isWorthAPreview(*previous, inWindowOf(*previous, settings))) {
            const AnalysisSettings previewed = inWindowOf(*previous, settings);
            const Axis &time = previous->time();
            const FrameRange range =
                previewRange(*previous->frames, time.nearest(visible.low), time.nearest(visible.high));
            // What is calibrated already is there as soon as a preview of that much would be.
            if (!range.isEmpty() && (range.isKeepable || !knownCalibration(previewed))) {
                const bool isKept = kept && kept->holds(previous->frames, range.readFirst, range.end);
                std::shared_ptr<const KeptFrames> frames;
                if (range.isKeepable)
                    frames = isKept ? kept
                                    : std::make_shared<const KeptFrames>(previous->frames, range.readFirst,
                                                                         range.end - range.readFirst,
                                                                         context.part(0.0, 0.01));
                const StatisticPreview preview = previewStatistic(
                    *previous, previewed, range, frames ? *frames : *previous->frames, context.part(0.01, 0.02));
                m_runner.deliver([this, settings, preview, frames] { showPreview(settings, preview, frames); });
            }
        }
        // What is displayed is not replaced by a part of the new result.
        PictureSink pictures;
        if (!previous)
            pictures = [this](const PicturesSoFar &sofar) {
                m_runner.deliver([this, sofar] { m_document.showPictures(sofar); });
            };
        const bool isNew = showsFirstEstimates && opened.recording && !knownCalibration(settings);
        const auto calibration = isNew ? CalibrationDepth::FirstEstimate : CalibrationDepth::Refined;
        std::shared_ptr<const Analysis> analysis =
            analyse(opened, settings, {.previous = previous.get(), .pictures = pictures, .calibration = calibration},
                    context.part(0.0, isNew ? 0.3 : 1.0));
        if (analysis->calibration->isFirstEstimate) {
            m_runner.deliver([this, analysis, found = events(*analysis), numbers] {
                m_firstEstimate = analysis->threshold;
                m_document.setAnalysis(analysis, found, numbers);
                restoreView();
            });
            const auto estimate = std::move(analysis);
            analysis = analyse(opened, settings, {.previous = estimate.get()}, context.part(0.3, 1.0));
        }
        analysis = numbers.number(analysis);
        std::vector<Event> found = events(*analysis);
        return [this, analysis = std::move(analysis), found = std::move(found), numbers = std::move(numbers)] {
            m_document.setAnalysis(analysis, found, numbers);
        };
    });
}

void AnalysisController::showPreview(const AnalysisSettings &settings, const StatisticPreview &preview,
                                     std::shared_ptr<const KeptFrames> kept)
{
    m_kept = std::move(kept);
    if (settings == m_document.analysedSettings() && !m_document.isCurrent() && m_runner.isRunning())
        m_document.setProvisional(preview.statistic);
    dropPartialPreview();
}

/// Outside the preview's range, the existing analysis is shown.
void AnalysisController::dropPartialPreview()
{
    const auto &shown = m_document.provisional();
    if (!shown)
        return;
    const Span visible = m_document.lookedAt();
    const Axis &time = shown->time();
    if (visible.low < time.value(-1.5) || visible.high > time.value(double(time.count) + 0.5))
        m_document.setProvisional(nullptr);
}

void AnalysisController::stop()
{
    m_runner.cancel();
}

void AnalysisController::previewThreshold(double nats)
{
    m_document.setShownThreshold(nats);
}

void AnalysisController::commitThreshold(double nats)
{
    if (!m_document.plan())
        return;
    AnalysisSettings after = m_document.settings();
    const AnalysisPlan &analysis = *m_document.plan();
    const auto by = isBeyondRates(after.decide.by, nats, analysis) ? DecideSettings::By::Nats : after.decide.by;
    after.decide = decideAt(after.decide, by, nats, analysis);
    const bool isMoved = after != m_document.settings();
    m_document.setShownThreshold(isMoved ? nats : analysis.threshold);
    m_document.edit(after, tr("Move the threshold"), QStringLiteral("threshold"));
}

void AnalysisController::stepThreshold(int quarterNats)
{
    commitThreshold(m_document.shownThreshold() + 0.25 * quarterNats);
}

void AnalysisController::recover(const QString &path)
{
    m_isOpening = true;
    m_runner.start([this, path](const RunContext &context) -> JobRunner::Delivery {
        context.checkpoint(0.0, "opening");
        Opening opening = openNow(path, {}, context.part(0.0, 0.9));
        opening.sessionPath.clear();
        return [this, opening = std::move(opening)] {
            deliver(opening);
            m_document.undoStack().resetClean();
        };
    });
}

AnalysisController::Opening AnalysisController::openNow(const QString &path, const OpenOptions &options,
                                                        const RunContext &context)
{
    const std::string name = pathBytes(path);
    if (!isSessionPath(name)) {
        OpenedSource opened = openSource(sourceAt(path, options), {}, context);
        const AnalysisSettings settings = firstSettings(opened);
        const QString warning = doubtAbout(opened);
        return {std::move(opened), settings, {}, {}, warning};
    }
    const Session session = sessionAt(path);
    OpenedSource opened = openSource(session.source, normalisationBy(session.settings), context);
    kindOf(opened); // throws for frames that cannot be shown
    return {std::move(opened),
            session.settings,
            viewFromJson(session.view, name),
            session.source.path == name ? QString() : path,
            QString::fromStdString(recordingMismatch(session)),
            session.annotations,
            session.numbers};
}

void AnalysisController::deliver(const Opening &opening)
{
    m_isOpening = false;
    m_pendingView = opening.view;
    m_document.setOpened(opening.opened, opening.settings, opening.sessionPath, opening.annotations, opening.numbers);
    if (!opening.warning.isEmpty())
        emit warned(m_document.sourceName(), opening.warning);
    startAnalysis();
}

void AnalysisController::end()
{
    // A failed or cancelled opening had removed the analysis of the document that is still open.
    if (std::exchange(m_isOpening, false) && !m_document.isEmpty() && !m_document.isCurrent())
        return startAnalysis();
    m_document.setProvisional(nullptr); // its settings could not be analysed
    emit busyChanged(false);
    restoreView();
    if (const auto first = std::exchange(m_firstEstimate, {});
        first && !m_document.analysis()->calibration->isFirstEstimate)
        emit refined(*first);
    emit settled();
}

void AnalysisController::restoreView()
{
    if (m_pendingView && m_document.analysis())
        emit viewRestored(*std::exchange(m_pendingView, {}));
}

} // namespace faintline
