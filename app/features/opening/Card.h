#pragma once

#include "app/features/opening/scenarios.h"

#include <QAbstractButton>

namespace faintline {

/// Large button of the start page for a recording or a scene: its picture, and what it shows. Highlighted with the
/// focus or under the mouse; its parts ignore mouse events.
class Card : public QAbstractButton
{
    Q_OBJECT

public:
    explicit Card(const Scenario &scenario, QWidget *parent = nullptr);

    const Scenario &scenario() const { return m_scenario; }

    QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    Scenario m_scenario;
};

} // namespace faintline
