#pragma once

class QComboBox;

namespace faintline {

/// Lists the sample types of raw files by their SigMF names; others can be typed in.
QComboBox *sampleTypeBox();

} // namespace faintline
