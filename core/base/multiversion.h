#pragma once

#include <type_traits>

/// Compiles a hot loop for several instruction sets and selects one when the program starts.
///
/// Contraction into fused multiply-add is off for the whole core, so every version gives the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)                  \
    && !defined(__SANITIZE_THREAD__) && !defined(FAINTLINE_ONE_VERSION)
#define FAINTLINE_HAS_VERSIONS
#define FAINTLINE_MULTIVERSION __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FAINTLINE_MULTIVERSION
#endif

namespace faintline {

/// SIMD vector of `bytes` bytes. The unaligned type loads from and stores to any address of a Value.
template <class Value, int bytes>
struct Vector {
    typedef Value Type __attribute__((vector_size(bytes)));
    typedef Value Unaligned __attribute__((vector_size(bytes), aligned(sizeof(Value)), may_alias));
    static constexpr int lanes = bytes / int(sizeof(Value));
};

/// Width of the widest vectors to use, in bytes: 64 with AVX-512, 32 with AVX2, else 16; limited by
/// FAINTLINE_VECTOR_BYTES.
int vectorBytes();

#ifdef FAINTLINE_HAS_VERSIONS

template <class Body>
[[gnu::target("arch=x86-64-v4")]] inline auto withVectorsOf64(const Body &body)
{
    return body(std::integral_constant<int, 64>());
}

template <class Body>
[[gnu::target("arch=x86-64-v3")]] inline auto withVectorsOf32(const Body &body)
{
    return body(std::integral_constant<int, 32>());
}

#endif

/// Calls body(bytes), compiled for each instruction set, with its widest vectors, because the compiler splits wider
/// ones into single values. The body and what it calls are always inlined.
template <class Body>
inline auto withVectors(const Body &body)
{
#ifdef FAINTLINE_HAS_VERSIONS
    static const int widest = vectorBytes();
    if (widest == 64)
        return withVectorsOf64(body);
    if (widest == 32)
        return withVectorsOf32(body);
#endif
    return body(std::integral_constant<int, 16>());
}

} // namespace faintline
