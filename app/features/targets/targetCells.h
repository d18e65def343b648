#pragma once

#include "scene/editTargets.h"

#include <QString>

#include <optional>
#include <vector>

namespace faintline {

/// The targets of a ping scene as a table of numbers: a row for each leg, and one for a target without legs. A target's
/// own numbers stand in its first row. Pings are counted from 1, as in the read-out.

enum class TargetColumn {
    Target,
    Snr,
    Fluctuation,
    Range,
    Bearing,
    From,
    Until,
    Leg,
    Pings,
    RangeRate,
    BearingRate,
    Turn
};
constexpr int targetColumnCount = int(TargetColumn::Turn) + 1;

struct TargetRow {
    int target = 0;
    int leg = -1; ///< -1: the target has none

    bool isFirst() const { return leg <= 0; } ///< of its target
    bool operator==(const TargetRow &) const = default;
};

std::vector<TargetRow> targetRows(const PingScene &scene);

/// "SNR (dB)", and the sentence for its tool tip.
QString titleOf(TargetColumn column, RateUnit unit);
QString sentenceOf(TargetColumn column, RateUnit unit);

/// Whether the column is one of a leg's.
bool isOfLeg(TargetColumn column);

/// Whether a number can be typed into this cell. In the row of a target without legs it makes the first leg.
bool isEditable(const TargetRow &row, TargetColumn column);

/// The text of a cell, with at most six digits; "Swerling 1" for a fluctuation; "end" for a duration to the end; empty
/// for a cell without a value.
QString textOf(const PingScene &scene, const TargetRow &row, TargetColumn column, RateUnit unit);

/// The scene with the number that was typed into a cell. Throws Error naming target, leg and column, and what would be
/// accepted.
PingScene withText(const PingScene &scene, const TargetRow &row, TargetColumn column, const QString &text,
                   RateUnit unit);

} // namespace faintline
