#pragma once

#include "scene/PingScene.h"

namespace faintline::test {

/// Six beams all round and a target of 12 dB at 300°, which recedes by a cell a ping.
inline PingScene recedingTarget(int pings, int rangeCells, double rangeMetres, int appearPing = 0)
{
    PingScene scene{.pings = pings, .rangeCells = rangeCells, .beams = 6};
    PingTarget &target = scene.targets.emplace_back();
    target.snrDb = 12.0;
    target.rangeMetres = rangeMetres;
    target.bearingDegrees = 300.0;
    target.appearPing = appearPing;
    target.legs.emplace_back().rangeCellsPerPing = 1.0;
    return scene;
}

} // namespace faintline::test
