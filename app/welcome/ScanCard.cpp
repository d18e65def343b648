#include "app/welcome/ScanCard.h"

#include "app/document/scanScenario.h"
#include "widgets/base/Theme.h"
#include "widgets/plot/CellPicture.h"
#include "widgets/plot/WalkPlot.h"

#include <QLabel>
#include <QVBoxLayout>

namespace faintline {

namespace {

    constexpr int scanHeight = 112; // with captions as high as the other cards' pictures
    constexpr int walksShown = 12;  // per hypothesis

    /// Range and Doppler of the target in the displayed scan.
    std::vector<QPointF> truthOn(const ScanCard::Result &result)
    {
        const ScanCell cell = truthOf(result.test, result.run)[std::size_t(result.stage - 1)];
        return {QPointF(double(cell[2]), double(cell[3]))};
    }

    void makePicture(MarkedPlot &plot)
    {
        plot.setFixedHeight(scanHeight);
        plot.setBare(true);
        plot.setFocusPolicy(Qt::NoFocus);
        plot.setAttribute(Qt::WA_TransparentForMouseEvents);
    }

} // namespace

ScanCard::ScanCard(QWidget *parent)
    : Card(tr("A radar that looks until it can decide"),
           tr("The test leaves an empty sector as soon as it can decide, and follows a target that changes cells from "
              "scan to scan."),
           parent),
      m_scan(new CellPicture), m_walks(new WalkPlot), m_found(caption(tr("Simulating …"), Theme::font(12)))
{
    makePicture(*m_scan);
    makePicture(*m_walks);

    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(14, 12, 14, 12);
    layout->setSpacing(4);
    layout->addWidget(caption(text(), Theme::boldFont(15)));
    layout->addWidget(caption(tr("One scan, target circled"), Theme::font(12)));
    layout->addWidget(m_scan);
    layout->addWidget(caption(tr("The evidence, scan by scan"), Theme::font(12)));
    layout->addWidget(m_walks);
    layout->addWidget(m_found);
    layout->addWidget(caption(accessibleDescription(), Theme::font()));
    layout->addStretch();
}

ScanCard::Result ScanCard::compute(const RunContext &context)
{
    Result result;
    result.test = readScanTest(radarScenarioPath());
    const SequentialModel model = scanModel(result.test.scene, result.test.designSnrDb);
    for (int number = 0; number < walksShown; ++number)
        for (const bool hasTarget : {false, true}) {
            context.checkpoint(double(number) / walksShown, "walks");
            const ScanRun run{hasTarget, number};
            result.walks.emplace_back(run, walkScan(result.test, model, run));
        }
    const auto &[first, found] = result.walks[1];
    result.run = first;
    result.stage = found.stages;
    result.db = rangeDopplerDb(result.test, first, found.stages - 1);
    return result;
}

void ScanCard::setResult(const Result &result)
{
    m_hasResult = true;
    std::vector<WalkPlot::Walk> walks;
    double onTargets = 0.0;
    int accepted = 0;
    for (const auto &[run, test] : result.walks) {
        walks.push_back({test.lnLambda, test.decision, run.hasTarget, test.isForced});
        onTargets += run.hasTarget ? double(test.stages) : 0.0;
        accepted += run.hasTarget && test.decision == SprtDecision::H1 ? 1 : 0;
    }
    m_walks->setTest(result.test.sprt, {});
    m_walks->setWalks(std::move(walks));
    m_walks->setMarks({});
    const ScanScene &scene = result.test.scene;
    // As wide as the card; range increases to the right.
    m_scan->setPicture({"range", "cell", 0.0, 1.0, scene.rangeCells, false},
                       {"Doppler", "cell", 0.0, 1.0, scene.dopplerCells, false}, result.db, {0.0, scene.snrDb + 6.0},
                       tr("dB"));
    m_scan->setPaths({{{}, CellPicture::Path::Kind::Rings, Theme::colours(*this).truth, truthOn(result)}});
    m_found->setText(tr("%1 of %2 targets found, in %3 scans each")
                         .arg(accepted)
                         .arg(walksShown)
                         .arg(onTargets / walksShown, 0, 'f', 1));
}

} // namespace faintline
