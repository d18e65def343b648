#pragma once

namespace faintline::test {

// GCC defines macros of its own; the __has_feature that Qt defines for it is always 0.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FAINTLINE_IS_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FAINTLINE_IS_SANITIZED
#endif
#endif

#ifdef FAINTLINE_IS_SANITIZED
constexpr bool isSanitized = true; ///< sanitizers change memory use and speed
#else
constexpr bool isSanitized = false;
#endif

/// Factor on the time that a test may wait.
constexpr int slowdown = isSanitized ? 10 : 1;

} // namespace faintline::test
