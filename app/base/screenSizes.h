#pragma once

namespace faintline {

/// Width of a window in pixels from which panels stand in two columns. In a narrower one they share one column, which
/// leaves the pictures their width.
inline constexpr int twoColumnsFrom = 1500;

} // namespace faintline
