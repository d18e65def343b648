#include "app/features/pictures/measureBox.h"

#include "app/base/Inquiry.h"
#include "app/base/tr.h"
#include "app/document/Document.h"
#include "inspect/boxLevels.h"
#include "widgets/base/cellsOf.h"
#include "widgets/base/quantities.h"
#include "widgets/waterfall/WaterfallView.h"

namespace faintline {

namespace {

    constexpr int boxPauseMs = 40; ///< while it is dragged

    QString noteOf(const std::shared_ptr<const Analysis> &analysis, const Viewport::Box &selected,
                   const RunContext &context)
    {
        const auto [beginFrame, endFrame] = cellsOf(analysis->time(), selected.time);
        const auto [beginCell, endCell] = cellsOf(analysis->grid().axes.front(), selected.frequency);
        const BoxLevels levels = boxLevels(*analysis, {beginFrame, endFrame, beginCell, endCell}, context);
        const bool saysMean = analysis->input->framesPerRow(0) > 1; // otherwise the picture shows it
        const QString mean = saysMean ? tr("mean %1 dB · ").arg(numberText(levels.meanDb, 1)) : QString();
        const QString area =
            levels.snrDb ? tr("area SNR %1 dB").arg(numberText(*levels.snrDb, 1)) : tr("not above the noise beside it");
        return mean + area + (analysis->unsubtracted ? tr(" · strong lines subtracted") : QString());
    }

} // namespace

void measureBox(Document &document, const std::vector<WaterfallView *> &views)
{
    using Asking = Inquiry<QString, std::shared_ptr<const Analysis>, Viewport::Box>;
    auto *note = new Asking(
        views.front(),
        [&document] {
            const auto box = document.box();
            return Asking::questionIf(box && document.analysis(), {}, document.analysis(),
                                      box.value_or(Viewport::Box()));
        },
        noteOf,
        [views](const QString *text) {
            for (WaterfallView *view : views)
                view->setSelectionNote(text ? *text : QString());
        });
    note->setPause(boxPauseMs);
    note->askAt(document.viewport(), &Viewport::selectionChanged);
    note->askAt(document, &Document::analysisChanged);
}

} // namespace faintline
