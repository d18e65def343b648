#include "app/features/sequential/SequentialPanel.h"

#include "app/base/writeAndReport.h"
#include "app/document/Document.h"
#include "app/features/sequential/SequentialControls.h"
#include "app/features/sequential/TrajectoryPage.h"
#include "app/features/sequential/sequentialBars.h"
#include "app/features/sequential/sequentialSentences.h"
#include "exchange/sequentialCsv.h"
#include "exchange/writeChart.h"
#include "widgets/plot/BarPlot.h"
#include "widgets/plot/CellPicture.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/plot/WalkPlot.h"

#include <QComboBox>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QSlider>
#include <QSplitter>
#include <QTabWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    QLabel *sentenceLabel()
    {
        auto *label = new QLabel;
        label->setTextFormat(Qt::PlainText);
        label->setWordWrap(true);
        label->setContentsMargins(8, 2, 8, 4);
        label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
        return label;
    }

    QSplitter *sideBySide(QWidget *left, QWidget *right, int leftShare, int rightShare)
    {
        auto *splitter = new QSplitter(Qt::Horizontal);
        splitter->setChildrenCollapsible(false);
        splitter->addWidget(left);
        splitter->addWidget(right);
        splitter->setStretchFactor(0, leftShare);
        splitter->setStretchFactor(1, rightShare);
        return splitter;
    }

    /// Views stacked with little space between them.
    QWidget *column(std::initializer_list<QWidget *> widgets)
    {
        auto *page = new QWidget;
        auto *layout = new QVBoxLayout(page);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setSpacing(0);
        for (QWidget *widget : widgets)
            layout->addWidget(widget, qobject_cast<QLabel *>(widget) ? 0 : 1);
        return page;
    }

} // namespace

SequentialPanel::SequentialPanel(Document &document, SequentialTests &tests, QWidget *parent)
    : Panel(parent), m_document(document), m_tests(tests), m_controls(new SequentialControls(tests)),
      m_tabs(new QTabWidget), m_walk(new WalkPlot), m_stopping(new BarPlot), m_trajectory(new TrajectoryPage(tests)),
      m_views(document, tests, *m_trajectory, this), m_asn(new ChartPlot), m_variation(new ChartPlot),
      m_curvesText(sentenceLabel()), m_prior(new ChartPlot), m_priorText(sentenceLabel()), m_sectors(new BarPlot),
      m_sectorsText(sentenceLabel()), m_runText(new QLabel), m_stageText(new QLabel),
      m_slider(new QSlider(Qt::Horizontal))
{
    m_tabs->setDocumentMode(true);
    m_tabs->setMinimumWidth(280); // charts that are not visible must not widen the window
    m_tabs->addTab(buildWalks(), tr("Walks"));
    m_views.add(&m_trajectory->posterior(), tr("Posterior and trajectory"),
                [this] { return m_trajectory->posteriorNumbers(); });
    m_views.add(&m_trajectory->scan(), tr("Scan"), [this] { return m_trajectory->scanNumbers(); });
    m_tabs->addTab(m_trajectory, tr("Trajectory and scan"));
    m_tabs->addTab(buildCurves(), tr("Stages against SNR"));
    m_tabs->addTab(buildPrior(), tr("Against the prior"));
    m_tabs->addTab(buildSectors(), tr("Sectors"));
    auto *saveMenu = new QMenu(this);
    m_views.addActionsTo(*saveMenu);
    auto *saveButton = new QToolButton;
    saveButton->setText(tr("Save"));
    saveButton->setToolTip(tr("Save a view as PNG, SVG or PDF, or its numbers as CSV"));
    saveButton->setMenu(saveMenu);
    saveButton->setPopupMode(QToolButton::InstantPopup);
    saveButton->setAutoRaise(true);
    m_tabs->setCornerWidget(saveButton);

    auto *right = new QVBoxLayout;
    right->setSpacing(0);
    right->addWidget(m_tabs, 1);
    right->addWidget(buildRunRow());
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_controls);
    layout->addLayout(right, 1);
    for (QComboBox *list : m_tabs->findChildren<QComboBox *>())
        list->installEventFilter(this);
    connectTests();
    connect(&document, &Document::analysisChanged, this, &SequentialPanel::followDocument);
    connect(&document, &Document::opened, this, &SequentialPanel::followDocument);
    followDocument();
    restart();
}

FieldForm<ScanTest> &SequentialPanel::form()
{
    return m_controls->form();
}

// ---- building -------------------------------------------------------------------------------------------------------

QWidget *SequentialPanel::buildWalks()
{
    m_walk->setEmptySentence(tr("Press Run to plot ln Λ of each trial until it decides."));
    m_stopping->setEmptySentence(tr("The stages at which tests stop are counted here."));
    m_stopping->setTitles(tr("stages taken"), tr("tests"));
    m_stopping->setAccessibleName(tr("Number of tests that stopped after each stage"));
    m_views.add(m_walk, tr("Walks of ln Λ"), [this] { return walksCsv(m_tests.walks(), m_tests.isOfScans()); });
    m_views.add(m_stopping, tr("Stopping times"), [this] { return walksCsv(m_tests.walks(), m_tests.isOfScans()); });
    connect(m_walk, &WalkPlot::walkActivated, &m_tests, &SequentialTests::select);
    connect(m_walk, &MarkedPlot::activated, this, [this](double x) { m_tests.setStage(std::lround(x)); });
    connect(m_stopping, &BarPlot::barActivated, this, &SequentialPanel::selectStoppedAt);
    return sideBySide(m_walk, m_stopping, 3, 2);
}

QWidget *SequentialPanel::buildCurves()
{
    for (ChartPlot *plot : {m_asn, m_variation, m_prior})
        plot->setEmptySentence(tr("Press Run to plot the curve."));
    m_views.add(m_asn, tr("Stages against SNR"), [this] { return chartCsv(m_asn->chart()); });
    m_views.add(m_variation, tr("Coefficient of variation"), [this] { return chartCsv(m_variation->chart()); });
    return m_curvesPage = column({sideBySide(m_asn, m_variation, 3, 2), m_curvesText});
}

QWidget *SequentialPanel::buildPrior()
{
    m_views.add(m_prior, tr("Stages against the prior"), [this] { return chartCsv(m_prior->chart()); });
    return m_priorPage = column({m_prior, m_priorText});
}

QWidget *SequentialPanel::buildSectors()
{
    m_sectors->setEmptySentence(tr("The dwell time on each sector appears here."));
    m_sectors->setTitles(tr("sector"), tr("dwell, mean stages per look"));
    m_sectors->setAccessibleName(tr("Dwell time on each sector"));
    m_views.add(m_sectors, tr("Sectors"), [this] {
        return m_tests.sectorRounds() ? sectorsCsv(m_tests.test(), *m_tests.sectorRounds()) : std::string();
    });
    return m_sectorsPage = column({m_sectors, m_sectorsText});
}

QWidget *SequentialPanel::buildRunRow()
{
    m_runText->setTextFormat(Qt::PlainText);
    m_runText->setWordWrap(true);
    m_runText->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_slider->setFixedWidth(150);
    m_slider->setAccessibleName(tr("Stage"));
    m_slider->setToolTip(tr("Stage shown (J, L)"));
    connect(m_slider, &QSlider::valueChanged, this, [this](int stage) { m_tests.setStage(stage); });
    auto *row = new QWidget;
    auto *layout = new QHBoxLayout(row);
    layout->setContentsMargins(8, 3, 8, 4);
    layout->addWidget(m_runText, 1);
    layout->addWidget(m_stageText);
    layout->addWidget(m_slider);
    return row;
}

void SequentialPanel::connectTests()
{
    connect(m_controls, &StartColumn::startRequested, this, &SequentialPanel::run);
    connect(m_controls, &SequentialControls::onSelectionRequested, this, &SequentialPanel::startOnSelection);
    connect(&m_tests, &SequentialTests::restarted, this, &SequentialPanel::restart);
    connect(&m_tests, &SequentialTests::walksChanged, this, &SequentialPanel::showWalks);
    connect(&m_tests, &SequentialTests::fixedSizeChanged, this, &SequentialPanel::showWalks);
    connect(&m_tests, &SequentialTests::selectionChanged, this, &SequentialPanel::showSelection);
    connect(&m_tests, &SequentialTests::stageChanged, this, &SequentialPanel::showStage);
    connect(&m_tests, &SequentialTests::inspectionChanged, this, [this] { m_runText->setText(runSentence(m_tests)); });
    connect(&m_tests, &SequentialTests::curvesChanged, this, &SequentialPanel::showCurves);
    connect(&m_tests, &SequentialTests::sectorRoundsChanged, this, &SequentialPanel::showSectors);
    connect(&m_tests, &SequentialTests::failed, this, &SequentialPanel::failed);
    connect(&m_views, &SequentialViews::failed, this, &SequentialPanel::failed);
    connect(&m_views, &SequentialViews::written, this, &SequentialPanel::written);
}

// ---- starting -------------------------------------------------------------------------------------------------------

void SequentialPanel::run()
{
    start(form().value());
}

void SequentialPanel::start(const ScanTest &test)
{
    form().setValue(test);
    try {
        m_tests.start(test);
    } catch (const Error &error) {
        form().showError(error);
        emit failed(error);
    }
}

void SequentialPanel::startOnSelection()
{
    const auto &analysis = m_document.analysis();
    if (!analysis)
        return;
    const Viewport::Box &visible = m_document.viewport().visible();
    const Axis &time = analysis->time();
    const Axis &frequency = analysis->grid().axes.back();
    SequentialTests::Selection selection;
    selection.name = m_document.sourceName();
    selection.frames = analysis->frames;
    selection.model = analysis->settings.model;
    selection.firstFrame = time.nearest(visible.time.low + 0.5 * time.step);
    selection.frameCount = time.nearest(visible.time.high - 0.5 * time.step) - selection.firstFrame + 1;
    selection.firstCell = frequency.nearest(visible.frequency.low + 0.5 * frequency.step);
    selection.cellCount = frequency.nearest(visible.frequency.high - 0.5 * frequency.step) - selection.firstCell + 1;
    actOrReport(*this, [&] { m_tests.start(selection, form().value().sprt); });
}

void SequentialPanel::restart()
{
    m_trajectory->clear();
    const QString none = tr("Curves and sectors are simulated. Press Run to plot them.");
    for (ChartPlot *plot : {m_asn, m_variation, m_prior})
        plot->setEmptySentence(m_tests.isOfScans() ? tr("Press Run to plot the curve.") : none);
    m_sectors->setEmptySentence(m_tests.isOfScans() ? tr("The dwell time on each sector appears here.") : none);
    showWalks();
    showSelection();
    showStage();
    showCurves();
    showSectors();
}

void SequentialPanel::followDocument()
{
    const auto analysis = m_document.lineAnalysis();
    m_controls->setOnSelectionEnabled(analysis && analysis->settings.model.motion == Motion::Slopes);
}

// ---- showing --------------------------------------------------------------------------------------------------------

void SequentialPanel::showWalks()
{
    std::vector<WalkPlot::Walk> walks;
    for (const auto &[run, result] : m_tests.walks())
        walks.push_back({result.lnLambda, result.decision,
                         m_tests.isOfScans() ? std::optional(run.hasTarget) : std::nullopt, result.isForced});
    m_walk->setWalks(std::move(walks));
    m_walk->setTest(m_tests.test().sprt, m_tests.fixedSize());
    m_walk->setSelected(m_tests.selected());
    showStopping();
}

void SequentialPanel::showStopping()
{
    std::vector<BarPlot::Series> series = stoppingBars(m_tests);
    const Index longest = std::ssize(series.front().values);
    m_stopping->setBars(std::move(series), 1);
    std::vector<MarkedPlot::Mark> marks;
    if (m_tests.fixedSize() && *m_tests.fixedSize() <= longest)
        marks.push_back({double(*m_tests.fixedSize()), true, tr("fixed size: about %1").arg(*m_tests.fixedSize())});
    m_stopping->setMarks(std::move(marks));
    m_stopping->setEmptySentence(m_tests.isOfScans() ? tr("The stages at which tests stop are counted here.")
                                                     : recordingNote(m_tests));
}

void SequentialPanel::selectStoppedAt(int stage)
{
    const auto count = int(m_tests.walks().size());
    for (int step = 1; step <= count; ++step) {
        const int walk = (std::max(0, m_tests.selected()) + step) % count;
        if (m_tests.walks()[std::size_t(walk)].second.stages == stage)
            return m_tests.select(walk);
    }
}

void SequentialPanel::showSelection()
{
    m_walk->setSelected(m_tests.selected());
    const bool hasRun = m_tests.selected() >= 0;
    const Index stages = hasRun ? m_tests.walks()[std::size_t(m_tests.selected())].second.stages : 1;
    m_stopping->setSelected(hasRun ? int(stages) : -1);
    const QSignalBlocker blocker(m_slider);
    m_slider->setRange(1, int(stages));
    m_slider->setEnabled(hasRun && stages > 1);
    m_runText->setText(runSentence(m_tests));
}

void SequentialPanel::showStage()
{
    const bool hasRun = m_tests.selected() >= 0;
    const auto stage = double(m_tests.stage());
    m_walk->setCursor(hasRun ? std::optional(stage) : std::nullopt);
    const QSignalBlocker blocker(m_slider);
    m_slider->setValue(int(m_tests.stage()));
    m_stageText->setText(hasRun ? tr("stage %1 of %2").arg(m_tests.stage()).arg(m_slider->maximum()) : QString());
}

void SequentialPanel::showCurves()
{
    m_asn->setChart(stagesChart(m_tests.points()));
    m_variation->setChart(variationChart(m_tests.points()));
    m_prior->setChart(m_tests.prior() ? priorChart(*m_tests.prior()) : Chart());
    m_curvesText->setText(curvesSentence(m_tests));
    m_priorText->setText(priorSentence(m_tests));
}

void SequentialPanel::showSectors()
{
    m_sectors->setBars(sectorBars(m_tests), 1, true);
    std::vector<MarkedPlot::Mark> marks;
    if (m_tests.fixedSize()) {
        marks.push_back({double(*m_tests.fixedSize()), false,
                         tr("a test of fixed size: about %1").arg(*m_tests.fixedSize()), true});
        m_sectors->setLeastHeight(double(*m_tests.fixedSize()));
    } else {
        m_sectors->setLeastHeight(0.0);
    }
    m_sectors->setMarks(std::move(marks));
    m_sectorsText->setText(sectorsSentence(m_tests));
}

// ---- keys -----------------------------------------------------------------------------------------------------------

namespace {

    /// J: -1, L: 1, other events: 0.
    int stepOf(const QEvent &event)
    {
        if (event.type() != QEvent::KeyPress && event.type() != QEvent::ShortcutOverride)
            return 0;
        const auto &key = static_cast<const QKeyEvent &>(event);
        if (key.modifiers() != Qt::NoModifier)
            return 0;
        return key.key() == Qt::Key_L ? 1 : key.key() == Qt::Key_J ? -1 : 0;
    }

} // namespace

/// Within the panel, J and L step through stages rather than the recording's frames.
bool SequentialPanel::event(QEvent *event)
{
    if (event->type() != QEvent::ShortcutOverride || stepOf(*event) == 0)
        return QWidget::event(event);
    event->accept();
    return true;
}

void SequentialPanel::keyPressEvent(QKeyEvent *event)
{
    if (const int step = stepOf(*event); step != 0)
        return m_tests.setStage(m_tests.stage() + step);
    QWidget::keyPressEvent(event);
}

/// A list that has the focus would search for an entry of that letter.
bool SequentialPanel::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() != QEvent::KeyPress || stepOf(*event) == 0)
        return QWidget::eventFilter(watched, event);
    m_tests.setStage(m_tests.stage() + stepOf(*event));
    return true;
}

} // namespace faintline
