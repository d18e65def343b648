#pragma once

#include "analysis/familyTeeth.h"

#include <QString>

namespace faintline {

// How the members of a family are written.

/// What the frequencies are on whose axis a family is looked for: "Frequency", or of harmonics "Fundamental".
QString frequencyName(const FamilySettings &family);

/// "3×", "+50 Hz".
QString memberText(const FamilySettings &family, double member);

/// The same of a tooth, with its channel where several are added: "3×, channel 1", or "channel 1" without a family.
QString toothText(const FamilySettings &family, const FamilyTooth &tooth);

/// A line for each member of an analysis's family at `hz`, in columns: "3×   171.9 Hz". Of many, the first ones and the
/// last one; none without a family.
QString membersText(const AnalysisPlan &plan, double hz);

} // namespace faintline
