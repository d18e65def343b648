#include "app/features/pictures/Closeup.h"

#include "base/memoryShares.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QEvent>

namespace faintline {

namespace {

    constexpr int closeupPauseMs = 80; ///< a view on its way is not computed
    /// For each of the two; enough for more frames than a screen has rows.
    constexpr std::size_t byteBudget = memoryShares::closeup;

} // namespace

Closeup::Closeup(Document &document, WaterfallView &input, WaterfallView &output, QObject *parent)
    : QObject(parent), m_document(document), m_input(input), m_output(output)
{
    input.canvas()->installEventFilter(this);
    connect(&document, &Document::opened, this, &Closeup::follow);
    connect(&document, &Document::analysisChanged, this, &Closeup::follow);
    connect(&document, &Document::provisionalChanged, this, &Closeup::show);
    connect(&document.viewport(), &Viewport::spanChanged, this, &Closeup::follow);
    connect(&document.viewport(), &Viewport::followingChanged, this, &Closeup::follow);
    connect(&m_runner, &JobRunner::busyChanged, this, [this](bool isBusy) {
        if (!isBusy) // after a failure, the merged rows stay
            emit shown();
    });
}

bool Closeup::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::Resize)
        follow();
    return QObject::eventFilter(watched, event);
}

/// For a live run, only while its picture is paused.
std::shared_ptr<const Analysis> Closeup::current() const
{
    const Viewport &viewport = m_document.viewport();
    return viewport.isFollowing() ? nullptr : m_document.inspectedUntil(viewport.time().high);
}

bool Closeup::showsNewest() const
{
    return m_document.viewport().time().low >= m_document.live().newInput->time().value(-0.5);
}

std::shared_ptr<const PeakPyramid> Closeup::lookedBackAt(const WaterfallView &view) const
{
    if (m_document.viewport().isFollowing() || showsNewest())
        return nullptr;
    return &view == &m_input ? m_inputStretch : m_statisticStretch;
}

/// Nothing where the pictures say all that can be seen.
FrameStretch Closeup::wanted() const
{
    const auto analysis = current();
    if (!analysis || (!m_document.live().isEmpty() && showsNewest()))
        return {};
    const Span &visible = m_document.viewport().time();
    const Axis &time = analysis->time();
    const FrameStretch frames{time.nearest(visible.low), time.nearest(visible.high) + 1};
    const FrameStretch stretch = closeupStretch(*analysis->input, frames, m_input.framesPerPixel(), byteBudget);
    if (stretch.begin < m_document.live().goesBackTo)
        return {};
    if (stretch.isEmpty() || m_analysis != analysis || !m_stretch.contains(frames))
        return stretch;
    const Index cells = analysis->grid().size();
    const auto mergedIn = [cells](const FrameStretch &one) {
        return framesPerRowWithin(byteBudget, one.end - one.begin, cells);
    };
    const Index there = mergedIn(m_stretch);
    const bool isFineEnough = there <= mergedIn(stretch) || double(there) <= m_input.framesPerPixel();
    return isFineEnough ? m_stretch : stretch;
}

void Closeup::follow()
{
    const FrameStretch stretch = wanted();
    if (m_analysis != current() || (stretch.isEmpty() && m_runner.isRunning())) {
        m_runner.cancel();
        forget();
    }
    if (stretch.isEmpty() || (m_analysis && m_stretch == stretch && m_waiting.isEmpty()))
        return;
    m_waiting = stretch;
    const auto job = [this, analysis = current(), stretch](const RunContext &context) -> JobRunner::Delivery {
        m_runner.deliver([this, analysis, stretch] { begin(analysis, stretch); });
        m_runner.deliver([this, input = inputCloseup(*analysis, stretch, byteBudget, context)] {
            m_inputStretch = input;
            show();
        });
        return [this, statistic = statisticCloseup(*analysis, stretch, byteBudget, context)] {
            m_statisticStretch = statistic;
            show();
        };
    };
    m_runner.start(job, closeupPauseMs);
}

void Closeup::begin(const std::shared_ptr<const Analysis> &analysis, const FrameStretch &stretch)
{
    forget();
    m_analysis = analysis;
    m_stretch = stretch;
    for (WaterfallView *view : {&m_input, &m_output})
        if (view->shownPicture() == view->picture())
            view->setCloseup(nullptr); // one that is out of sight takes no memory beside the next
}

void Closeup::forget()
{
    m_waiting = {};
    m_analysis.reset();
    m_stretch = {};
    m_inputStretch.reset();
    m_statisticStretch.reset();
}

void Closeup::show()
{
    if (m_analysis != current())
        return;
    if (m_inputStretch && !m_input.isPlain())
        m_input.setCloseup(m_inputStretch);
    if (m_statisticStretch && !m_document.provisional())
        m_output.setCloseup(m_statisticStretch);
}

} // namespace faintline
