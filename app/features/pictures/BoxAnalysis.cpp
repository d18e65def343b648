#include "app/features/pictures/BoxAnalysis.h"

#include "app/document/AnalysisController.h"
#include "app/document/Document.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QAction>
#include <QMenu>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    /// A power of ten, at most a tenth of the step.
    double unitOf(double step)
    {
        return std::pow(10.0, std::floor(std::log10(step)) - 1.0);
    }

    /// A multiple of the unit as it is written in decimals.
    double multiple(double count, double unit)
    {
        return unit < 1.0 ? count / std::round(1.0 / unit) : count * std::round(unit);
    }

    double down(double value, double step)
    {
        const double unit = unitOf(step);
        return multiple(std::floor(value / unit), unit);
    }

    double up(double value, double step)
    {
        const double unit = unitOf(step);
        return multiple(std::ceil(value / unit), unit);
    }

    std::pair<double, double> membersOf(const FamilySettings &family, double lowHz, double highHz)
    {
        if (family.isNone())
            return {lowHz, highHz};
        const std::vector<double> ofLow = memberFrequencies(family, lowHz);
        const std::vector<double> ofHigh = memberFrequencies(family, highHz);
        return {*std::min_element(ofLow.begin(), ofLow.end()), *std::max_element(ofHigh.begin(), ofHigh.end())};
    }

} // namespace

AnalysisSettings inBox(AnalysisSettings settings, const Viewport::Box &box, double frameSeconds, double binHz)
{
    SelectionSettings &selection = settings.selection;
    selection.fromSeconds = std::max(0.0, down(box.time.low, frameSeconds));
    selection.toSeconds = up(box.time.high, frameSeconds);
    // The box of a family lies on the family's own axis; the band must contain its members.
    const auto [lowest, highest] = membersOf(settings.family, box.frequency.low, box.frequency.high);
    selection.lowHz = down(lowest, binHz);
    selection.highHz = up(highest, binHz);
    return settings;
}

BoxAnalysis::BoxAnalysis(Document &document, AnalysisController &controller, const std::vector<WaterfallView *> &views,
                         QObject *parent)
    : QObject(parent), m_document(document), m_controller(controller),
      m_box(new QAction(tr("Analyse this bo&x"), this)), m_visible(new QAction(tr("Analyse what I s&ee"), this)),
      m_all(new QAction(tr("Analyse the &whole recording"), this))
{
    m_box->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_Return));
    m_box->setToolTip(tr("Restrict the analysis to the time and band of the measured box (M)"));
    m_visible->setShortcut(QKeySequence(Qt::ALT | Qt::Key_Return));
    m_visible->setToolTip(tr("Restrict the analysis to the time and band that the pictures show"));
    m_all->setShortcut(QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_Return));
    m_all->setToolTip(tr("Analyse all times and frequencies again"));
    connect(m_box, &QAction::triggered, this, &BoxAnalysis::analyseBox);
    connect(m_visible, &QAction::triggered, this, &BoxAnalysis::analyseVisible);
    connect(m_all, &QAction::triggered, this, &BoxAnalysis::analyseAll);
    for (WaterfallView *view : views)
        connect(view, &WaterfallView::contextMenuRequested, this, [this](QMenu *menu, double, double) {
            menu->addSeparator();
            menu->addActions(actions());
        });
    connect(&document.viewport(), &Viewport::selectionChanged, this, &BoxAnalysis::enable);
    connect(&document.viewport(), &Viewport::spanChanged, this, &BoxAnalysis::enable);
    connect(&document, &Document::opened, this, &BoxAnalysis::enable);
    connect(&document, &Document::settingsChanged, this, &BoxAnalysis::enable);
    connect(&document, &Document::analysisChanged, this, &BoxAnalysis::enable);
    enable();
}

void BoxAnalysis::analyseBox()
{
    const auto box = m_document.box();
    const auto &analysis = m_document.analysis();
    if (!box || !analysis)
        return;
    const AnalysisSettings after =
        inBox(m_document.settings(), *box, analysis->time().step, analysis->grid().axes.front().step);
    m_document.viewport().clearSelection();
    m_controller.setSettings(after, tr("Analyse a box"));
}

/// A side beyond which there is nothing more to see keeps its setting.
void BoxAnalysis::analyseVisible()
{
    const auto analysis = m_document.lineAnalysis();
    if (!analysis)
        return;
    const auto &[time, frequency] = m_document.viewport().visible();
    const Viewport::Box full = m_document.viewport().full();
    AnalysisSettings after = inBox(m_document.settings(), m_document.viewport().visible(), analysis->time().step,
                                   analysis->grid().axes.front().step);
    const SelectionSettings &before = m_document.settings().selection;
    if (time.low == full.time.low)
        after.selection.fromSeconds = before.fromSeconds;
    if (time.high == full.time.high)
        after.selection.toSeconds = before.toSeconds;
    if (frequency.low == full.frequency.low)
        after.selection.lowHz = before.lowHz;
    if (frequency.high == full.frequency.high)
        after.selection.highHz = before.highHz;
    m_controller.setSettings(after, tr("Analyse what is visible"));
}

void BoxAnalysis::analyseAll()
{
    AnalysisSettings after = m_document.settings();
    after.selection = {.channel = after.selection.channel, .channels = after.selection.channels};
    m_controller.setSettings(after, tr("Analyse the whole recording"));
}

void BoxAnalysis::enable()
{
    const SelectionSettings &selection = m_document.settings().selection;
    m_box->setEnabled(m_document.recording() && m_document.analysis() && m_document.viewport().selection());
    m_visible->setEnabled(m_document.recording() && m_document.lineAnalysis() && !m_document.viewport().showsAll());
    const SelectionSettings all{.channel = selection.channel, .channels = selection.channels};
    m_all->setEnabled(m_document.recording() && selection != all);
}

} // namespace faintline
