#pragma once

#include <QString>

class QDoubleSpinBox;
class QSpinBox;

namespace faintline {

// Inputs of the forms of experiments; the tool tip is the accessible name as well.

QDoubleSpinBox *numberInput(double value, double low, double high, double step, int decimals, const QString &suffix,
                            const QString &toolTip);
QSpinBox *countInput(int value, int low, int high, const QString &toolTip);

} // namespace faintline
