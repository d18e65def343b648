#include "app/features/events/Comparer.h"

#include "evaluate/comparison/differencePicture.h"
#include "evaluate/experiments/measureCost.h"

#include <utility>

namespace faintline {

Comparer::Comparer(Document &document, QObject *parent) : QObject(parent), m_document(document)
{
    connect(&document, &Document::opened, this, [this] {
        m_runner.cancel();
        m_result.reset();
        m_cost.reset();
        m_keptSource.reset();
        emit changed();
    });
    connect(&document, &Document::analysisChanged, this, &Comparer::compare);
    connect(&m_runner, &JobRunner::progressed, this, &Comparer::progressed);
    connect(&m_runner, &JobRunner::failed, this, &Comparer::failed);
}

void Comparer::keep()
{
    if (!m_document.analysis())
        return;
    m_kept = m_document.analysis();
    m_keptSource = m_document.source();
    m_cost.reset();
    emit keptChanged();
    compare();
}

bool Comparer::isOfWhatIsOpen() const
{
    return m_kept && m_keptSource == m_document.source();
}

void Comparer::computeHere()
{
    if (!m_kept || !m_document.analysis())
        return;
    m_runner.start([this, opened = m_document.openedSource(), settings = m_kept->settings,
                    previous = m_document.analysis()](const RunContext &context) -> JobRunner::Delivery {
        auto analysis = analyse(opened, settings, {.previous = previous.get()}, context);
        return [this, analysis = std::move(analysis), source = opened.source] {
            m_kept = analysis;
            m_keptSource = source;
            m_cost.reset();
            emit keptChanged();
            compare();
        };
    });
}

AnalysisSettings Comparer::exchange()
{
    const AnalysisSettings before = m_kept->settings;
    keep();
    return before;
}

void Comparer::setActive(bool isActive)
{
    if (std::exchange(m_isActive, isActive) != isActive)
        compare();
}

void Comparer::compare()
{
    const auto &b = m_document.analysis();
    if (!m_isActive || !isOfWhatIsOpen() || !b)
        return;
    if (m_result && m_result->a == m_kept && m_result->b == b)
        return;
    m_runner.start([this, a = m_kept, b](const RunContext &context) -> JobRunner::Delivery {
        Result result{a, b, compareAnalyses(*a, *b), differencePicture(*a, *b, context),
                      settingDifferences(a->settings, b->settings)};
        return [this, result = std::move(result)] {
            m_result = result;
            emit changed();
            measure();
        };
    });
}

void Comparer::measure()
{
    if (!m_isMeasuringCost)
        return;
    m_meter.start(
        [this, a = m_result->a, b = m_result->b, known = m_cost](const RunContext &context) -> JobRunner::Delivery {
            const Cost cost{known ? known->a : measureCost(*a, context), measureCost(*b, context)};
            return [this, cost] {
                m_cost = cost;
                emit costChanged();
            };
        });
}

} // namespace faintline
