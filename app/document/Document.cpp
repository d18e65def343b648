#include "app/document/Document.h"

#include "plan/slopeUnit.h"

#include <QUndoCommand>

#include <algorithm>
#include <iterator>
#include <utility>

namespace faintline {

namespace {

    constexpr int editId = 1;

} // namespace

/// The program's only undo command: holds source and settings before and after.
class Document::Edit : public QUndoCommand
{
public:
    Edit(Document &document, State after, const QString &text, QString field)
        : QUndoCommand(text), m_document(document), m_before(document.state()), m_after(std::move(after)),
          m_field(std::move(field)), m_gesture(document.m_isInGesture ? document.m_gesture : 0)
    {
    }

    void undo() override { m_document.apply(m_before); }
    void redo() override { m_document.apply(m_after); }

    int id() const override { return m_field.isEmpty() ? -1 : editId; }

    bool mergeWith(const QUndoCommand *other) override
    {
        const auto &next = static_cast<const Edit &>(*other);
        if (next.m_field != m_field || m_gesture == 0 || next.m_gesture != m_gesture)
            return false;
        m_after = next.m_after;
        setObsolete(m_after.settings == m_before.settings && m_after.annotations == m_before.annotations);
        return true;
    }

private:
    Document &m_document;
    State m_before;
    State m_after;
    QString m_field;
    int m_gesture; ///< 0: none
};

Document::Document(QObject *parent) : QObject(parent)
{
    connect(&m_undoStack, &QUndoStack::cleanChanged, this, &Document::sessionChanged);
}

void Document::setOpened(OpenedSource opened, const AnalysisSettings &settings, const QString &sessionPath,
                         Annotations annotations, SignalNumbers numbers)
{
    m_opened = std::move(opened);
    m_inputFiles.emplace(filesReadFor(m_opened.source.path));
    m_settings = settings;
    m_annotations = std::move(annotations);
    m_numbers = std::move(numbers);
    m_sessionPath = sessionPath;
    m_analysis.reset();
    m_provisional.reset();
    m_live = {};
    m_isLive = false;
    m_liveSoFar.reset();
    m_planSoFar.reset();
    m_events.clear();
    m_viewport.setExtents({}, {});
    m_undoStack.clear();
    emit this->opened();
    emit sessionChanged();
}

void Document::beginGesture()
{
    ++m_gesture;
    m_isInGesture = true;
}

void Document::endGesture()
{
    m_isInGesture = false;
}

void Document::startFrom(const AnalysisSettings &settings)
{
    if (isModified()) { // the user's own changes remain to be undone and to be saved
        edit(settings, tr("start from other settings"), {});
        return;
    }
    m_undoStack.clear();
    if (settings != m_settings)
        apply({m_opened, settings, m_annotations});
}

void Document::edit(const AnalysisSettings &after, const QString &text, const QString &field)
{
    if (after != m_settings)
        m_undoStack.push(new Edit(*this, {m_opened, after, m_annotations}, text, field));
}

void Document::replaceOpened(OpenedSource opened, const QString &text)
{
    m_undoStack.push(new Edit(*this, {std::move(opened), m_settings, m_annotations}, text, {}));
}

void Document::annotate(Annotations after, const QString &text)
{
    if (after != m_annotations)
        m_undoStack.push(new Edit(*this, {m_opened, m_settings, std::move(after)}, text, {}));
}

void Document::setSaved(const QString &sessionPath)
{
    m_sessionPath = sessionPath;
    m_undoStack.setClean();
    emit sessionChanged();
}

void Document::setAnalysis(std::shared_ptr<const Analysis> analysis, std::vector<Event> events, SignalNumbers numbers)
{
    m_analysis = std::move(analysis);
    m_numbers = std::move(numbers);
    if (m_opened.frames) { // they may have been normalised anew
        m_opened.frames = m_analysis->frames;
        m_opened.normalisation = normalisationBy(m_analysis->settings);
    }
    m_provisional.reset();
    m_events = std::move(events);
    m_shownThreshold = m_analysis->threshold;
    emit analysisChanged();
    emit shownThresholdChanged();
    emit shownEventsChanged();
}

Session Document::session(const Json &view, const std::string &hash) const
{
    return {m_opened.source, hash, m_settings, view, m_annotations, m_numbers};
}

void Document::setLive(LiveView view)
{
    const bool isPlanNew = view.plan != m_live.plan;
    const bool areEventsNew = view.events != m_live.events;
    m_live = std::move(view);
    m_isLive = true;
    if (isPlanNew) {
        m_shownThreshold = m_live.plan->threshold;
        emit livePlanChanged();
        emit shownThresholdChanged();
    }
    emit liveChanged();
    if (areEventsNew)
        emit shownEventsChanged();
}

void Document::followNewest()
{
    if (m_isLive)
        m_viewport.setFollowing(true);
}

void Document::endLive()
{
    m_isLive = false;
}

std::shared_ptr<const Analysis> Document::inspectedUntil(double seconds)
{
    if (!m_isLive)
        return lineAnalysis();
    const double frame = m_live.time.position(seconds);
    if (frame + 0.5 < double(m_live.goesBackTo))
        return nullptr;
    const bool isOld =
        m_planSoFar != m_live.plan || !m_liveSoFar
        || (frame + 0.5 > double(m_liveSoFar->time().count) && m_live.time.count > m_liveSoFar->time().count);
    if (isOld) {
        m_liveSoFar = analysisSoFar(m_live);
        m_planSoFar = m_live.plan;
    }
    return m_liveSoFar;
}

const AnalysisPlan *Document::plan() const
{
    return m_analysis ? m_analysis.get() : m_live.plan.get();
}

Span Document::lookedAt() const
{
    const auto &cursor = m_viewport.cursor();
    return frameKind().isSeenSingly && cursor ? Span{cursor->seconds, cursor->seconds} : m_viewport.time();
}

std::vector<Annotation> Document::shownBoxes() const
{
    return isOnePicture() ? m_annotations.boxes : std::vector<Annotation>();
}

std::optional<Viewport::Box> Document::box() const
{
    return isOnePicture() ? m_viewport.selection() : std::nullopt;
}

void Document::setProvisional(std::shared_ptr<const PeakPyramid> statistic)
{
    if (statistic == m_provisional || !m_analysis)
        return;
    m_provisional = std::move(statistic);
    emit provisionalChanged();
}

AnalysisSettings Document::analysedSettings() const
{
    return m_opened.recording ? withSlopesInBins(m_settings, m_opened.recording->info()) : m_settings;
}

AnalysisSettings Document::usedSettings() const
{
    return isCurrent() ? m_analysis->settings : analysedSettings();
}

bool Document::isCurrent() const
{
    return m_analysis && m_analysis->answers(analysedSettings()) && m_analysis->recording == m_opened.recording
           && (!m_opened.frames || m_analysis->frames == m_opened.frames);
}

bool Document::isPreview() const
{
    return m_analysis && (m_shownThreshold != m_analysis->threshold || !isCurrent());
}

void Document::setShownThreshold(double nats)
{
    if (!plan() || nats == m_shownThreshold)
        return;
    const std::ptrdiff_t before = shownCount();
    m_shownThreshold = nats;
    emit shownThresholdChanged();
    if (shownCount() != before)
        emit shownEventsChanged();
}

std::vector<Event> Document::shownEvents() const
{
    if (m_live.events)
        return *m_live.events; // each by the threshold at its time
    std::vector<Event> result;
    std::copy_if(m_events.begin(), m_events.end(), std::back_inserter(result),
                 [this](const Event &event) { return isShown(event); });
    return result;
}

std::ptrdiff_t Document::shownCount() const
{
    return std::count_if(m_events.begin(), m_events.end(), [this](const Event &event) { return isShown(event); });
}

std::vector<Track> Document::shownTracks() const
{
    std::vector<Track> result;
    if (m_analysis)
        std::copy_if(m_analysis->tracks.begin(), m_analysis->tracks.end(), std::back_inserter(result),
                     [this](const Track &track) { return statisticOf(track, *m_analysis) >= m_shownThreshold; });
    return result;
}

const Track *Document::track(int id) const
{
    return m_analysis ? trackOfId(m_analysis->tracks, id) : nullptr;
}

void Document::apply(const State &state)
{
    const bool isReread = state.opened.recording != m_opened.recording || state.opened.frames != m_opened.frames;
    const bool isRerun = isReread || state.settings != m_settings;
    const bool isAnnotated = state.annotations != m_annotations;
    m_opened = state.opened;
    m_settings = state.settings;
    m_annotations = state.annotations;
    if (isRerun || !isAnnotated)
        emit settingsChanged();
    if (isAnnotated)
        emit annotationsChanged();
}

} // namespace faintline
