#include "app/control/RecordingCheck.h"

#include "app/document/Document.h"
#include "plan/slopeUnit.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double wantedHours = 2.0; ///< of noise, in total
    constexpr int mostRuns = 40;

    /// Number of runs that make up `wantedHours`, from 4 to `mostRuns`.
    int runsFor(const Analysis &analysis)
    {
        const double hours = double(analysis.time().count) * analysis.time().step / 3600.0;
        return std::clamp(int(std::ceil(wantedHours / hours)), 4, mostRuns);
    }

} // namespace

RecordingCheck::RecordingCheck(const Document &document, QObject *parent) : QObject(parent), m_document(document)
{
    connect(&m_countRunner, &JobRunner::progressed, this, &RecordingCheck::countProgressed);
    connect(&m_countRunner, &JobRunner::failed, this, [this](const Error &error) { m_failure = error; });
    for (JobRunner *runner : {&m_lookRunner, &m_countRunner}) {
        connect(runner, &JobRunner::finished, this, &RecordingCheck::end);
        connect(runner, &JobRunner::cancelled, this, &RecordingCheck::end);
        connect(runner, &JobRunner::failed, this, &RecordingCheck::end);
    }
    connect(&document, &Document::opened, this, [this] {
        m_correction.reset();
        forget();
    });
    connect(&document, &Document::settingsChanged, this, &RecordingCheck::forget);
    connect(&document, &Document::analysisChanged, this, &RecordingCheck::look);
}

/// Results for other settings are no longer valid.
void RecordingCheck::forget()
{
    stopCount();
    if (m_lookRunner.isRunning())
        m_lookRunner.cancel();
    m_law.reset();
    m_advice.clear();
    m_count.reset();
    m_failure.reset();
    end();
}

void RecordingCheck::look()
{
    forget();
    m_lookRunner.start([this, analysis = m_document.analysis()](const RunContext &context) -> JobRunner::Delivery {
        const std::optional<NoiseLawCheck> law = checkNoiseLaw(*analysis, context);
        const std::vector<Advice> advice = advise(*analysis, context);
        return [this, law, advice] {
            m_law = law;
            m_advice = advice;
        };
    });
}

void RecordingCheck::startCount()
{
    if (!m_document.recording() || !m_document.analysis() || !m_document.isCurrent())
        return;
    m_count.reset();
    m_failure.reset();
    m_countRunner.start([this, analysis = m_document.analysis()](const RunContext &context) -> JobRunner::Delivery {
        const SurrogateCount counted =
            countOnSurrogates(analysis->recording, analysis->settings, runsFor(*analysis), context);
        return [this, counted] { setCount(counted); };
    });
    emit changed();
}

void RecordingCheck::stopCount()
{
    if (isCounting())
        m_countRunner.cancel();
}

void RecordingCheck::setCount(const SurrogateCount &count)
{
    m_count = count;
    m_correction = corrected();
    emit changed();
}

std::optional<AnalysisSettings> RecordingCheck::corrected() const
{
    if (!m_count || m_count->correction == 0.0)
        return {};
    AnalysisSettings after = m_document.settings();
    after.decide.by = DecideSettings::By::Nats;
    after.decide.thresholdNats = std::round(100.0 * (m_document.analysis()->threshold + m_count->correction)) / 100.0;
    return after;
}

bool RecordingCheck::isCorrected() const
{
    return m_correction && *m_correction == m_document.settings();
}

AnalysisSettings RecordingCheck::remedied(const Advice &advice) const
{
    AnalysisSettings after = advice.settings;
    const SlopeUnit unit = m_document.settings().model.slopeUnit;
    if (m_document.recording())
        after.model = withSlopesIn(unit, after.model, hzPerSecondOfABinAFrame(after, m_document.recording()->info()));
    return after;
}

void RecordingCheck::end()
{
    emit changed();
    if (!isBusy())
        emit settled();
}

} // namespace faintline
