#pragma once

#include <vector>

namespace faintline {

class Document;
class WaterfallView;

/// Measures the area SNR of the measured box (core/inspect/boxLevels.h), from the frames themselves, in the background,
/// and notes it at the box: "area SNR −1.0 dB".
void measureBox(Document &document, const std::vector<WaterfallView *> &views);

} // namespace faintline
