#include "app/document/RecordingCheck.h"

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

RecordingCheck::RecordingCheck(const Document &document, QObject *parent)
    : QObject(parent), m_document(document),
      m_look(
          this, [this] { return m_look.questionIf(m_document.isCurrent(), {}, m_document.analysis()); },
          [](const auto &analysis, const RunContext &context) {
              return Look{checkNoiseLaw(*analysis, context), advise(*analysis, context)};
          },
          &RecordingCheck::changed)
{
    connect(&m_counter, &JobRunner::progressed, this, &RecordingCheck::countProgressed);
    connect(&m_counter, &JobRunner::busyChanged, this, &RecordingCheck::changed);
    connect(&m_counter, &JobRunner::failed, this, [this](const Error &error) {
        m_failure = error;
        emit changed();
    });
    connect(&document, &Document::opened, this, [this] { m_correction.reset(); });
    for (const auto outdated : {&Document::opened, &Document::settingsChanged, &Document::analysisChanged}) {
        m_look.askAt(document, outdated);
        connect(&document, outdated, this, &RecordingCheck::forgetCount);
    }
}

void RecordingCheck::forgetCount()
{
    stopCount();
    m_count.reset();
    m_failure.reset();
    emit changed();
}

const NoiseLawCheck *RecordingCheck::law() const
{
    const Look *look = m_look.answerAbout(m_document.analysis());
    return look && look->law ? &*look->law : nullptr;
}

std::vector<Advice> RecordingCheck::advice() const
{
    const Look *look = m_look.answerAbout(m_document.analysis());
    return look ? look->advice : std::vector<Advice>();
}

void RecordingCheck::startCount()
{
    if (!m_document.recording() || !m_document.analysis() || !m_document.isCurrent())
        return;
    m_count.reset();
    m_failure.reset();
    m_counter.start([this, analysis = m_document.analysis()](const RunContext &context) -> JobRunner::Delivery {
        const SurrogateCount counted =
            countOnSurrogates(analysis->recording, analysis->settings, runsFor(*analysis), context);
        return [this, counted] { setCount(counted); };
    });
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

} // namespace faintline
