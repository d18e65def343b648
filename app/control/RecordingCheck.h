#pragma once

#include "analysis/advice.h"
#include "analysis/noiseLaw.h"
#include "analysis/surrogates.h"
#include "app/base/JobRunner.h"

#include <QObject>

#include <optional>
#include <vector>

namespace faintline {

class Document;

/// Whether the recording that is open is what its analysis takes it for.
///
/// After each analysis the noise outside its tracks is looked at (`checkNoiseLaw`), and what a user should know
/// (`advise`). On request, surrogates of the recording are sent through the whole chain (`countOnSurrogates`). All of
/// it runs on worker threads and is forgotten as soon as the settings change.
class RecordingCheck : public QObject
{
    Q_OBJECT

public:
    explicit RecordingCheck(const Document &document, QObject *parent = nullptr);

    const std::optional<NoiseLawCheck> &law() const { return m_law; }
    const std::vector<Advice> &advice() const { return m_advice; }
    const std::optional<SurrogateCount> &count() const { return m_count; }
    const std::optional<Error> &failure() const { return m_failure; } ///< of the count

    bool isBusy() const { return isCounting() || m_lookRunner.isRunning(); }
    bool isCounting() const { return m_countRunner.isRunning(); }

    void startCount();
    void stopCount();
    /// What a count came to.
    void setCount(const SurrogateCount &count);

    /// The settings with the threshold that gives the specified rate on noise like this recording's; nothing where
    /// that was not counted, or where the threshold gives it already.
    std::optional<AnalysisSettings> corrected() const;
    /// The settings with an advice's remedy, slopes in the unit they are given in.
    AnalysisSettings remedied(const Advice &advice) const;

signals:
    void changed(); ///< law, advice or count
    void countProgressed(double fraction, const QString &what);
    /// Nothing is being counted or looked at any more.
    void settled();

private:
    void forget();
    void look();
    void end();

    const Document &m_document;
    std::optional<NoiseLawCheck> m_law;
    std::vector<Advice> m_advice;
    std::optional<SurrogateCount> m_count;
    std::optional<Error> m_failure;
    JobRunner m_lookRunner;
    JobRunner m_countRunner; ///< last, so that its jobs end first
};

} // namespace faintline
