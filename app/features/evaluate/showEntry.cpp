#include "app/features/evaluate/showEntry.h"

#include "app/base/StartColumn.h"
#include "app/base/tr.h"
#include "app/features/evaluate/experimentWords.h"

namespace faintline {

namespace {

    QString stateWords(const Experiments::Entry &entry)
    {
        const int runs = entry.campaign ? entry.campaign->experiment.runs() : 0;
        const QString done = tr("%1 of %2 runs").arg(entry.runsDone()).arg(runs);
        switch (entry.state) {
        case Experiments::State::Waiting:
            return tr("waiting for the previous one");
        case Experiments::State::Running:
            return entry.doing.isEmpty() ? done : done + QStringLiteral(" · ") + entry.doing;
        case Experiments::State::Done:
            return entry.imported ? tr("imported without trials") : tr("done, %1").arg(done);
        case Experiments::State::Cancelled:
            return tr("cancelled after %1").arg(done);
        case Experiments::State::Failed:
            return tr("failed: %1").arg(entry.failure);
        }
        return {};
    }

} // namespace

void showEntry(StartColumn &column, const Experiments::Entry &entry, const std::optional<Experiment> &ofForm)
{
    column.setCancellable(entry.isOpen());
    column.showProgress(entry.progress, stateWords(entry));
    const bool isOther = entry.imported || (entry.campaign && ofForm != entry.campaign->experiment);
    const QString values = entry.campaign ? experimentWords(entry.campaign->experiment) : tr("imported curves");
    column.setNote(isOther ? tr("Shown: %1 (%2). The form below is for a new experiment.").arg(entry.name, values)
                           : QString());
}

} // namespace faintline
