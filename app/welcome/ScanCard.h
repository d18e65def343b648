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

/// The radar's scenario as a big button: a scan with its target, and tests that walk until they are sure.
class ScanCard : public Card
{
    Q_OBJECT

public:
    /// What the card shows of its test.
    struct Result {
        ScanTest test;
        std::vector<std::pair<ScanRun, SprtResult>> walks;
        ScanRun run; ///< whose scan is shown
        Index stage = 1;
        std::vector<float> db; ///< of that scan, range × Doppler
    };

    explicit ScanCard(QWidget *parent = nullptr);

    /// A few walks of both hypotheses, and the first scan of the first target. Throws Error, Cancelled.
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
