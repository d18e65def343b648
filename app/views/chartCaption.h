#pragma once

#include "app/document/Document.h"
#include "app/features/evaluate/Experiments.h"

#include <QString>

namespace faintline {

/// Captions of exported charts: a description of the source in one paragraph, in the window's words.

/// What a chart shows: power before the detector, which neither the detector nor the threshold changes, or its
/// statistic.
enum class CaptionOf { Input, Statistic };

/// The recording and the settings that differ from the defaults and change the chart: "night.wav; Spectrogram: Window
/// length 0.5 s, …; …".
QString captionOf(const Document &document, CaptionOf what);

/// The experiment's name, its runs and its detectors: "Lines; 80 runs done; 200 runs, -4 … 2 dB, …".
QString captionOf(const Experiments::Entry &entry);

} // namespace faintline
