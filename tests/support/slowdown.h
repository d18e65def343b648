#pragma once

namespace faintline::test {

// GCC has macros of its own; Qt defines __has_feature for it, which knows nothing.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FAINTLINE_IS_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FAINTLINE_IS_SANITIZED
#endif
#endif

#ifdef FAINTLINE_IS_SANITIZED
constexpr bool isSanitized = true; ///< memory is another then, and time
#else
constexpr bool isSanitized = false;
#endif

/// How many times as long as usual a test may have to wait.
constexpr int slowdown = isSanitized ? 10 : 1;

} // namespace faintline::test
