#include "app/panels/formInputs.h"

#include <QDoubleSpinBox>
#include <QSpinBox>

namespace faintline {

QDoubleSpinBox *numberInput(double value, double low, double high, double step, int decimals, const QString &suffix,
                            const QString &toolTip)
{
    auto *box = new QDoubleSpinBox;
    box->setRange(low, high);
    box->setSingleStep(step);
    box->setDecimals(decimals);
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
