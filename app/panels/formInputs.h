#pragma once

#include <QString>

class QDoubleSpinBox;
class QSpinBox;

namespace faintline {

// Inputs of the forms of experiments; the tool tip is the accessible name as well.

/// What a number may be, and how it is stepped and written.
struct NumberRange {
    double low;
    double high;
    double step;
    int decimals;
};

QDoubleSpinBox *numberInput(double value, const NumberRange &range, const QString &suffix, const QString &toolTip);
QSpinBox *countInput(int value, int low, int high, const QString &toolTip);

} // namespace faintline
