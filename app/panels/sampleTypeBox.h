#pragma once

class QComboBox;

namespace faintline {

/// The types of bare samples, by SigMF's names; others can be typed in.
QComboBox *sampleTypeBox();

} // namespace faintline
