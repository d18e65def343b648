#pragma once

#include "analyse/analyse.h"
#include "app/document/scenarios.h"
#include "app/document/sourceAt.h"
#include "app/welcome/Card.h"
#include "widgets/base/Viewport.h"

#include <memory>

class QLabel;

namespace faintline {

class OverviewStrip;

/// Button of a scenario: pictures of its input and of its detector's statistic, and a sentence about the result.
class ScenarioCard : public Card
{
    Q_OBJECT

public:
    explicit ScenarioCard(const Scenario &scenario, QWidget *parent = nullptr);

    const Scenario &scenario() const { return m_scenario; }

    /// Shows the simulated source and its analysis.
    void setResult(const OpenedSource &opened, std::shared_ptr<const Analysis> analysis);
    const OpenedSource &opened() const { return m_opened; }
    const std::shared_ptr<const Analysis> &analysis() const { return m_analysis; } ///< null until there is a result

private:
    Scenario m_scenario;
    Viewport m_viewport; ///< the whole extent
    OverviewStrip *m_input;
    OverviewStrip *m_statistic;
    QLabel *m_found;
    OpenedSource m_opened;
    std::shared_ptr<const Analysis> m_analysis;
};

} // namespace faintline
