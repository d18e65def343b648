#pragma once

#include "app/base/Inquiry.h"
#include "inspect/advice.h"
#include "inspect/noiseLaw.h"
#include "inspect/surrogates.h"

namespace faintline {

class Document;

/// Checks whether the open recording satisfies the assumptions of its analysis.
///
/// After each analysis the noise outside its tracks is tested (`checkNoiseLaw`), and advice is computed (`advise`). On
/// request, surrogates of the recording are sent through the whole chain (`countOnSurrogates`). All of this runs on
/// worker threads and is discarded when the settings change.
class RecordingCheck : public QObject
{
    Q_OBJECT

public:
    explicit RecordingCheck(const Document &document, QObject *parent = nullptr);

    const NoiseLawCheck *law() const; ///< null: not known, or not applicable
    std::vector<Advice> advice() const;
    const std::optional<SurrogateCount> &count() const { return m_count; }
    const std::optional<Error> &failure() const { return m_failure; } ///< reason why the count failed

    bool isCounting() const { return m_counter.isRunning(); }

    void startCount();
    void stopCount() { m_counter.cancel(); }
    /// Sets the result of a count.
    void setCount(const SurrogateCount &count);

    /// The settings with the threshold that gives the specified rate on noise like this recording's; nothing if that
    /// was not counted, or if the threshold already gives it.
    std::optional<AnalysisSettings> corrected() const;
    /// Whether the settings are those that `corrected` gave last for the open source.
    bool isCorrected() const;
    /// The settings with an advice's remedy, and slopes in their original unit.
    AnalysisSettings remedied(const Advice &advice) const;

signals:
    void changed(); ///< law, advice or count
    void countProgressed(double fraction, const QString &what);

private:
    struct Look {
        std::optional<NoiseLawCheck> law;
        std::vector<Advice> advice;
    };

    void forgetCount();

    const Document &m_document;
    std::optional<SurrogateCount> m_count;
    std::optional<AnalysisSettings> m_correction; ///< after the last count
    std::optional<Error> m_failure;
    JobRunner m_counter{this}; ///< last, as the next one, so that their jobs end first
    Inquiry<Look, std::shared_ptr<const Analysis>> m_look;
};

} // namespace faintline
