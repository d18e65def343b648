#pragma once

#include "inspect/familyTeeth.h"

#include <QString>

namespace faintline {

// Text for the members of a family.

/// Name of the frequency axis of a family: "Frequency", or "Fundamental" for harmonics.
QString frequencyName(const FamilySettings &family);

/// "3×", "+50 Hz".
QString memberText(const FamilySettings &family, double member);

/// The same for a tooth, with its channel if several are added: "3×, channel 1", or "channel 1" without a family.
QString toothText(const FamilySettings &family, const FamilyTooth &tooth);

/// One line for each member of an analysis's family at `hz`, in columns: "3×   171.9 Hz". If there are many, the first
/// ones and the last one; empty without a family.
QString membersText(const AnalysisPlan &plan, double hz);

} // namespace faintline
