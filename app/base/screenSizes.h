#pragma once

namespace faintline {

/// Width of a window in pixels from which panels stand in two columns. In a narrower one they share one column, which
/// leaves the pictures their width.
inline constexpr int twoColumnsFrom = 1500;

/// Width from which panels are beside the pictures at first; a narrower window of little height begins without them.
inline constexpr int oneColumnFrom = 800;

/// Height from which a column has panels one above the other; in a lower window they share one place.
inline constexpr int twoRowsFrom = 640;

/// Height from which a column has a list of events with an explanation below it.
inline constexpr int threeRowsFrom = 900;

/// Height from which the overview of the recording is shown.
inline constexpr int overviewFrom = 480;

} // namespace faintline
