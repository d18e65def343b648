#include "app/features/sequential/sequentialSentences.h"

#include "app/base/tr.h"
#include "app/features/sequential/SequentialTests.h"
#include "plan/lineSequentialModel.h"
#include "widgets/base/quantities.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    QString percent(double share)
    {
        return numberText(100.0 * share, std::abs(share) < 0.1 ? 1 : 0) + QStringLiteral(" %");
    }

    QString decisionText(const SprtResult &result)
    {
        switch (result.decision) {
        case SprtDecision::H1:
            return result.isForced ? tr("target accepted at the cut-off") : tr("a target accepted");
        case SprtDecision::H0:
            return result.isForced ? tr("noise accepted at the cut-off") : tr("noise only accepted");
        case SprtDecision::Undecided:
            break;
        }
        return tr("undecided");
    }

    QString trajectorySentence(const SequentialTests &tests)
    {
        const auto &inspection = tests.inspection();
        if (!inspection || inspection->truth.empty() || inspection->test.result.trajectory.empty())
            return {};
        Index worst = 0;
        Index last = 0;
        for (std::size_t stage = 0; stage < inspection->test.result.trajectory.size(); ++stage) {
            last = 0;
            for (std::size_t axis = 0; axis < 3; ++axis)
                last = std::max(
                    last, std::abs(inspection->test.result.trajectory[stage][axis] - inspection->truth[stage][axis]));
            worst = std::max(worst, last);
        }
        if (worst == 0)
            return tr(" Its trajectory is correct at every stage.");
        return tr(" Its trajectory is off by %1 at the last stage and by at most %2 cells.").arg(last).arg(worst);
    }

    QString recordingSentence(const SequentialTests &tests)
    {
        const SequentialTests::Selection &selection = tests.selection();
        const SprtResult &result = tests.walks().front().second;
        const Axis &time = selection.frames->time();
        QString text = tr("Line present since the first visible frame, in %1 bins: %2 after %3 of %4 frames (%5), ln Λ "
                          "= %6.")
                           .arg(selection.cellCount)
                           .arg(decisionText(result))
                           .arg(result.stages)
                           .arg(selection.frameCount)
                           .arg(secondsText(double(result.stages) * time.step, time.step),
                                numberText(result.lnLambda.empty() ? 0.0 : result.lnLambda.back(), 1));
        if (result.decision == SprtDecision::H0)
            text += tr(" This decision is final and does not cover lines that start later. Begin the view later to "
                       "test again.");
        return text;
    }

} // namespace

QString runSentence(const SequentialTests &tests)
{
    if (tests.selected() < 0)
        return {};
    if (!tests.isOfScans())
        return recordingSentence(tests);
    const auto &[run, result] = tests.walks()[std::size_t(tests.selected())];
    return tr("Run %1 %2: %3 after %4, ln Λ = %5.")
               .arg(run.number + 1)
               .arg(run.hasTarget ? tr("with a target") : tr("of noise only"), decisionText(result),
                    result.stages == 1 ? tr("one stage") : tr("%1 stages").arg(result.stages),
                    numberText(result.lnLambda.back(), 1))
           + trajectorySentence(tests);
}

QString recordingNote(const SequentialTests &tests)
{
    QString text = tr("A single test stops once, so nothing is counted.\nIt tests for a line present since the first "
                      "visible frame. “No target” is final: a line that starts later is not considered.");
    if (const Index every = tests.selection().frames ? framesApart(*tests.selection().frames) : 1; every > 1)
        text += tr("\nWindows overlap but stages must be independent, so the test uses one frame in %1. This makes α "
                   "and β hold.")
                    .arg(every);
    text += tr("\nα and β assume a correct background and lines that move as the model says.");
    return text;
}

QString curvesSentence(const SequentialTests &tests)
{
    const auto &points = tests.points();
    const auto atDesign =
        std::find_if(points.begin(), points.end(), [](const ScanPoint &p) { return p.snrDb == p.designSnrDb; });
    if (atDesign == points.end())
        return {};
    const ScanPoint &p = tests.test().designFollows ? points.back() : *atDesign;
    const auto range = [](double low, double high) {
        return tr("%1 … %2").arg(numberText(low, 1), numberText(high, 1));
    };
    QString text =
        tr("At %1 dB: %2 stages on noise, bounds (8b) %3; %4 with a target, bounds (8a) %5. The bounds "
           "neglect the overshoot of ln Λ")
            .arg(numberText(p.snrDb, 0), numberText(p.h0.stages.value, 1), range(p.bounds.h0Low, p.bounds.h0High),
                 numberText(p.h1.stages.value, 1), range(p.bounds.h1Low, p.bounds.h1High));
    QStringList above;
    if (p.h0.stages.value > p.bounds.h0High)
        above << tr("%1 on noise").arg(percent(p.h0.stages.value / p.bounds.h0High - 1.0));
    if (p.h1.stages.value > p.bounds.h1High)
        above << tr("%1 with a target").arg(percent(p.h1.stages.value / p.bounds.h1High - 1.0));
    text += above.isEmpty() ? tr("; the simulated tests stay below the upper bounds.")
                            : tr("; the simulated tests exceed the upper bounds by %1.").arg(above.join(tr(", ")));
    if (tests.test().sprt.cutOffStage > 0)
        text += tr(" They also neglect the cut-off.");
    return text;
}

QString priorSentence(const SequentialTests &tests)
{
    if (!tests.prior())
        return {};
    const PriorCurve &curve = *tests.prior();
    const QString what = tr("A line of %1 cells at %2 dB, from a known trajectory (left) to an unknown one (right), "
                            "without a cut-off.")
                             .arg(curve.cells)
                             .arg(numberText(tests.test().designSnrDb, 0));
    const std::optional<Overshoot> over = overshoot(curve);
    if (!over)
        return what;
    const QString how =
        over->h0 >= 0.0 && over->h1 >= 0.0
            ? tr(" At the right end the stages exceed the “upper bounds” by %1 on noise and %2 with a target")
            : tr(" At the right end the stages differ from the upper bounds by %1 on noise and %2 with a target");
    return what + how.arg(percent(over->h0), percent(over->h1)) + tr(": the bounds neglect the overshoot of ln Λ.");
}

QString sectorsSentence(const SequentialTests &tests)
{
    if (!tests.sectorRounds())
        return {};
    const SectorRounds &rounds = *tests.sectorRounds();
    int looksAtTargets = 0;
    int found = 0;
    int falseAlarms = 0;
    for (const SectorVisit &visit : rounds.visits) {
        const bool isAccepted = visit.result.decision == SprtDecision::H1;
        const bool isTarget = holdsTarget(tests.test(), visit.sector);
        looksAtTargets += isTarget ? 1 : 0;
        found += isTarget && isAccepted ? 1 : 0;
        falseAlarms += !isTarget && isAccepted ? 1 : 0;
    }
    const int looks = int(rounds.visits.size());
    const QString seen = tr(" %1 of %2 looks at sectors with a target find it; %3 of %4 looks at empty sectors end in "
                            "a false alarm.")
                             .arg(found)
                             .arg(looksAtTargets)
                             .arg(falseAlarms)
                             .arg(looks - looksAtTargets);
    if (!tests.isFixedSizeKnown())
        return tr("%1 looks take %2 stages.").arg(looks).arg(rounds.stages) + seen;
    if (!tests.fixedSize())
        return tr("%1 looks take %2 stages; a test of fixed size would need more than 40 for each.")
                   .arg(looks)
                   .arg(rounds.stages)
               + seen;
    return tr("%1 looks take %2 stages; tests of fixed size with the same errors, of about %3 stages each, would take "
              "%4: %5.")
               .arg(looks)
               .arg(rounds.stages)
               .arg(*tests.fixedSize())
               .arg(rounds.fixedStages)
               .arg(rounds.saving() >= 0.0 ? tr("%1 saved").arg(percent(rounds.saving()))
                                           : tr("%1 lost").arg(percent(-rounds.saving())))
           + seen;
}

} // namespace faintline
