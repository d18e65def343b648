#pragma once

#include "app/base/JobRunner.h"
#include "evaluate/experiments/campaignCurve.h"
#include "reproduce/reproduce.h"

#include <QObject>
#include <QString>
#include <QTimer>

#include <memory>
#include <optional>
#include <vector>

namespace faintline {

/// The experiments of this window: waiting, running and completed ones; one at a time runs on a worker.
///
/// A campaign grows while it runs: each finished run is added immediately, and `changed` reports it a few times per
/// second. Cancelled campaigns keep their runs. Results depend only on the experiment.
class Experiments : public QObject
{
    Q_OBJECT

public:
    enum class State { Waiting, Running, Done, Cancelled, Failed };

    struct Entry {
        int id = 0;
        QString name;
        State state = State::Waiting;
        double progress = 0.0;
        QString doing;   ///< while it runs
        QString failure; ///< why it failed
        std::optional<Campaign> campaign;
        RecordingPointer recording;           ///< into which lines are injected
        std::shared_ptr<const Trials> trials; ///< once prepared
        std::optional<Reproducible> reproducible;
        std::shared_ptr<const Reproduction> reproduction; ///< once done
        std::optional<std::vector<CurvePoint>> imported;  ///< points of a curve file, without trials
        int runsDone() const { return campaign ? int(campaign->outcomes.size()) : 0; }
        bool isOpen() const { return state == State::Waiting || state == State::Running; }
    };

    explicit Experiments(QObject *parent = nullptr);

    /// Appends a campaign to the queue, with the recording if it is open already. Returns its id.
    int start(const QString &name, const Experiment &experiment, RecordingPointer recording = {});
    int start(const Reproducible &reproducible, const ReproduceOptions &options);
    /// Adds results from elsewhere: runs of a campaign, or the points of a curve.
    int add(const QString &name, Campaign campaign);
    int add(const QString &name, std::vector<CurvePoint> curve);

    void cancel(int id);
    void remove(int id);

    const std::vector<Entry> &entries() const { return m_entries; }
    const Entry *entry(int id) const;
    bool isBusy() const { return m_running != 0; }

signals:
    void added(int id);
    void changed(int id); ///< its runs, state or progress
    void removed(int id);
    void busyChanged(bool isBusy);

private:
    Entry *find(int id);
    int append(Entry entry);
    void startNext();
    void startCampaign(const Entry &entry);
    void startReproduction(const Entry &entry);
    void addOutcome(int id, RunOutcome outcome);
    void end(State state, const QString &failure = {});
    void announce();

    std::vector<Entry> m_entries;
    std::vector<ReproduceOptions> m_options; ///< by id - 1
    int m_lastId = 0;
    int m_running = 0; ///< id; 0: nothing
    QTimer m_announcer;
    JobRunner m_runner{this}; ///< last, so that its jobs end first
};

} // namespace faintline
