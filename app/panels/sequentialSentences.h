#pragma once

#include <QString>

namespace faintline {

class SequentialTests;

/// What the views of sequential tests say below themselves. Nothing where there is nothing to say yet.

/// How the selected run ended and how well its trajectory is known; of a recording, what was decided after how many
/// frames.
QString runSentence(const SequentialTests &tests);

/// Why there is no histogram of one test, what it can say and what it assumes.
QString recordingNote(const SequentialTests &tests);

/// Mean stages at the SNR the test is designed for, against Wald's bounds (8a) and (8b).
QString curvesSentence(const SequentialTests &tests);

/// By how much the stages exceed the bounds where nothing is known of the trajectory.
QString priorSentence(const SequentialTests &tests);

/// What a survey of the sectors found, and what it saves against tests of fixed size.
QString sectorsSentence(const SequentialTests &tests);

} // namespace faintline
