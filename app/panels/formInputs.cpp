#include "app/panels/formInputs.h"

#include <QDoubleSpinBox>
#include <QSpinBox>

namespace faintline {

QDoubleSpinBox *numberInput(double value, const NumberRange &range, const QString &suffix, const QString &toolTip)
{
    auto *box = new QDoubleSpinBox;
    box->setRange(range.low, range.high);
    box->setSingleStep(range.step);
    box->setDecimals(range.decimals);
    box->setValue(value);
    box->setSuffix(suffix);
    box->setToolTip(toolTip);
    box->setAccessibleName(toolTip);
    box->setMinimumWidth(40);
    return box;
}

QSpinBox *countInput(int value, int low, int high, const QString &toolTip)
{
    auto *box = new QSpinBox;
    box->setRange(low, high);
    box->setValue(value);
    box->setToolTip(toolTip);
    box->setAccessibleName(toolTip);
    return box;
}

} // namespace faintline
