#pragma once

#include "app/welcome/Card.h"
#include "base/RunContext.h"
#include "evaluate/sequential/ScanTest.h"

#include <optional>
#include <utility>
#include <vector>

class QLabel;

namespace faintline {

class CellPicture;
class WalkPlot;

/// Button of the radar scenario: a scan with its target, and sequential tests up to their decisions.
class ScanCard : public Card
{
    Q_OBJECT

public:
    /// Content of the card.
    struct Result {
        ScanTest test;
        std::vector<std::pair<ScanRun, SprtResult>> walks;
        ScanRun run; ///< run whose scan is shown
        Index stage = 1;
        std::vector<float> db; ///< of that scan, range × Doppler
    };

    explicit ScanCard(QWidget *parent = nullptr);

    /// Computes a few walks for each hypothesis and the first scan of the first target. Throws Error, Cancelled.
    static Result compute(const RunContext &context);
    void setResult(const Result &result);
    bool hasResult() const { return m_hasResult; }

private:
    bool m_hasResult = false;
    CellPicture *m_scan;
    WalkPlot *m_walks;
    QLabel *m_found;
};

} // namespace faintline
