#pragma once

#include <QString>

class QDoubleSpinBox;
class QSpinBox;

namespace faintline {

// Input widgets of the experiment forms; the tooltip is the accessible name as well.

/// Range, step and format of a number.
struct NumberRange {
    double low;
    double high;
    double step;
    int decimals;
};

QDoubleSpinBox *numberInput(double value, const NumberRange &range, const QString &suffix, const QString &toolTip);
QSpinBox *countInput(int value, int low, int high, const QString &toolTip);

} // namespace faintline
