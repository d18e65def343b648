#pragma once

#include "app/control/Experiments.h"
#include "app/document/Document.h"

#include <QString>

namespace faintline {

/// Captions of exported charts: a description of the source in one paragraph.

/// The recording and the settings that differ from the defaults: "night.wav; spectrogram.windowSeconds = 0.5 s; …".
QString captionOf(const Document &document);

/// The experiment's name, its runs and its numbers: "Lines of 30 s; 200 runs; seed = 1; …".
QString captionOf(const Experiments::Entry &entry);

/// Any JSON: "scene.snrDb = 3; runs.trials = 200"; lists of objects are numbered.
QString captionOf(const Json &json);

} // namespace faintline
