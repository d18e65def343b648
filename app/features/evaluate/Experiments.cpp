#include "app/features/evaluate/Experiments.h"

#include "widgets/base/labelText.h"

#include <algorithm>
#include <utility>

namespace faintline {

namespace {

    constexpr int announceInterval = 150; // ms

    Experiments::Entry doneEntry(const QString &name)
    {
        Experiments::Entry entry;
        entry.name = name;
        entry.state = Experiments::State::Done;
        entry.progress = 1.0;
        return entry;
    }

} // namespace

Experiments::Experiments(QObject *parent) : QObject(parent)
{
    m_announcer.setSingleShot(true);
    m_announcer.setInterval(announceInterval);
    connect(&m_announcer, &QTimer::timeout, this, &Experiments::announce);
    connect(&m_runner, &JobRunner::progressed, this, [this](double fraction, const QString &what) {
        if (Entry *entry = find(m_running)) {
            entry->progress = fraction;
            entry->doing = what;
            if (!m_announcer.isActive())
                m_announcer.start();
        }
    });
    connect(&m_runner, &JobRunner::finished, this, [this] { end(State::Done); });
    connect(&m_runner, &JobRunner::cancelled, this, [this] { end(State::Cancelled); });
    connect(&m_runner, &JobRunner::failed, this,
            [this](const Error &error) { end(State::Failed, messageText(error.what())); });
}

int Experiments::start(const QString &name, const Experiment &experiment, RecordingPointer recording)
{
    Entry entry;
    entry.name = name;
    entry.campaign = Campaign{experiment, {}, {}};
    entry.recording = std::move(recording);
    const int id = append(std::move(entry));
    startNext();
    return id;
}

int Experiments::start(const Reproducible &reproducible, const ReproduceOptions &options)
{
    Entry entry;
    entry.name = QString::fromStdString(reproducible.name) + (options.quick ? tr(" (quick)") : QString());
    entry.reproducible = reproducible;
    const int id = append(std::move(entry));
    m_options.back() = options;
    startNext();
    return id;
}

int Experiments::add(const QString &name, Campaign campaign)
{
    Entry entry = doneEntry(name);
    entry.campaign = std::move(campaign);
    return append(std::move(entry));
}

int Experiments::add(const QString &name, std::vector<CurvePoint> curve)
{
    Entry entry = doneEntry(name);
    entry.imported = std::move(curve);
    return append(std::move(entry));
}

int Experiments::append(Entry entry)
{
    entry.id = ++m_lastId;
    m_entries.push_back(std::move(entry));
    m_options.push_back({});
    emit added(m_lastId);
    return m_lastId;
}

const Experiments::Entry *Experiments::entry(int id) const
{
    const auto found =
        std::find_if(m_entries.begin(), m_entries.end(), [id](const Entry &entry) { return entry.id == id; });
    return found == m_entries.end() ? nullptr : &*found;
}

Experiments::Entry *Experiments::find(int id)
{
    return const_cast<Entry *>(entry(id));
}

void Experiments::cancel(int id)
{
    Entry *entry = find(id);
    if (!entry || !entry->isOpen())
        return;
    if (id == m_running)
        return m_runner.cancel();
    entry->state = State::Cancelled;
    emit changed(id);
}

void Experiments::remove(int id)
{
    cancel(id);
    if (std::erase_if(m_entries, [id](const Entry &entry) { return entry.id == id; }) > 0)
        emit removed(id);
}

void Experiments::startNext()
{
    if (m_running != 0)
        return;
    const auto next = std::find_if(m_entries.begin(), m_entries.end(),
                                   [](const Entry &entry) { return entry.state == State::Waiting; });
    if (next == m_entries.end())
        return;
    next->state = State::Running;
    m_running = next->id;
    next->reproducible ? startReproduction(*next) : startCampaign(*next);
    emit busyChanged(true);
    emit changed(m_running);
}

void Experiments::startCampaign(const Entry &entry)
{
    m_runner.start([this, id = entry.id, campaign = *entry.campaign,
                    recording = entry.recording](const RunContext &context) -> JobRunner::Delivery {
        const RunSink sink = [this, id](const RunOutcome &outcome) {
            QMetaObject::invokeMethod(
                this, [this, id, outcome] { addOutcome(id, outcome); }, Qt::QueuedConnection);
        };
        const RecordingPointer noise = recording ? recording : openRecordingOf(campaign.experiment);
        const std::shared_ptr<const Trials> trials = prepareTrials(campaign.experiment, noise, context.part(0.0, 0.3));
        QMetaObject::invokeMethod(
            this,
            [this, id, trials] {
                if (Entry *prepared = find(id)) {
                    prepared->trials = trials;
                    prepared->campaign->thresholds = trials->thresholds();
                }
            },
            Qt::QueuedConnection);
        trials->run(openRuns(campaign, runsOfShard(campaign.experiment, 0, 1)), context.part(0.3, 1.0), sink);
        return [] {};
    });
}

void Experiments::startReproduction(const Entry &entry)
{
    const ReproduceOptions options = m_options[std::size_t(entry.id - 1)];
    m_runner.start([this, id = entry.id, reproducible = *entry.reproducible,
                    options](const RunContext &context) -> JobRunner::Delivery {
        const auto made = std::make_shared<const Reproduction>(reproducible.run(options, context));
        return [this, id, made] { find(id)->reproduction = made; };
    });
}

/// In order of the runs, so that intermediate results do not depend on the threads' speed.
void Experiments::addOutcome(int id, RunOutcome outcome)
{
    Entry *entry = find(id);
    if (!entry || entry->state != State::Running)
        return;
    std::vector<RunOutcome> &outcomes = entry->campaign->outcomes;
    const auto place = std::upper_bound(outcomes.begin(), outcomes.end(), outcome,
                                        [](const RunOutcome &a, const RunOutcome &b) { return a.run < b.run; });
    outcomes.insert(place, std::move(outcome));
    if (!m_announcer.isActive())
        m_announcer.start();
}

void Experiments::end(State state, const QString &failure)
{
    const int id = std::exchange(m_running, 0);
    m_announcer.stop();
    if (Entry *entry = find(id)) {
        entry->state = state;
        entry->failure = failure;
        entry->doing.clear();
        if (state == State::Done)
            entry->progress = 1.0;
        emit changed(id);
    }
    startNext();
    if (m_running == 0)
        emit busyChanged(false);
}

void Experiments::announce()
{
    if (m_running != 0)
        emit changed(m_running);
}

} // namespace faintline
