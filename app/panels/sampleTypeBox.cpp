#include "app/panels/sampleTypeBox.h"

#include <QComboBox>
#include <QCoreApplication>

namespace faintline {

QComboBox *sampleTypeBox()
{
    auto *box = new QComboBox;
    for (const char *type : {"ci16_le", "ci8", "cu8", "cf32_le", "cf64_le", "ci16_be", "cf32_be", "ri16_le", "ri8",
                             "ru8", "rf32_le", "rf64_le", "ri16_be", "rf32_be"})
        box->addItem(QString::fromLatin1(type));
    box->setEditable(true);
    box->setToolTip(QCoreApplication::translate(
        "sampleTypeBox", "c or r (I/Q or real), f, i or u (float, signed, unsigned), bits, _le or _be"));
    return box;
}

} // namespace faintline
