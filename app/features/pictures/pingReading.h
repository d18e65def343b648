#pragma once

#include "plan/Analysis.h"
#include "widgets/pings/PingMarks.h"

#include <QString>

namespace faintline {

class OutputLayers;
class PingMap;

/// What the read-out of a ping is taken from.
struct PingPictures {
    const Analysis &analysis;
    const PingMap &input;
    const PingMap &output;
    const OutputLayers &layers;
    const PingMarks &marks;
    const FramePlane &plane;
};

/// "ping 3/24 · 80 s · 3500 m · 90° · y 4.1 dB · D 12.0 nat · …" for the cell at a place; on more axes, with the
/// positions on the others, at which D is largest or which are cut: "(elevation 4°, Doppler 20 m/s)".
QString pingReading(const PingPictures &pictures, Index ping, const PingMarks::Place &place);

} // namespace faintline
