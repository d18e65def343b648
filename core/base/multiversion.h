#pragma once

/// Compiles a hot loop once per instruction set and picks one when the program starts.
///
/// Contraction into fused multiply-add is off for the whole core, so every version gives the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)                  \
    && !defined(__SANITIZE_THREAD__) && !defined(FAINTLINE_ONE_VERSION)
#define FAINTLINE_MULTIVERSION __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FAINTLINE_MULTIVERSION
#endif
