#pragma once

#include <QString>

namespace faintline {

class SequentialTests;

/// Sentences below the views of sequential tests. Empty if there is nothing to report yet.

/// How the selected run ended and how well its trajectory is known; for a recording, the decision and the number of
/// frames it took.
QString runSentence(const SequentialTests &tests);

/// Why there is no histogram for a single test, what the test can tell and what it assumes.
QString recordingNote(const SequentialTests &tests);

/// Mean number of stages at the design SNR, compared with Wald's bounds (8a) and (8b).
QString curvesSentence(const SequentialTests &tests);

/// By how much the stages exceed the bounds if nothing is known about the trajectory.
QString priorSentence(const SequentialTests &tests);

/// Result of the rounds over the sectors, and its saving compared with fixed-size tests.
QString sectorsSentence(const SequentialTests &tests);

} // namespace faintline
