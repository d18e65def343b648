#pragma once

#include <cstddef>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace faintline {

/// Allocator for arrays of many planes of which an inner loop reads a piece each; with pages of 4 KiB every piece would
/// cost a TLB miss. Arrays of a few MiB or more ask the system for pages of 2 MiB, which it may decline.
template <class T>
struct HugePageAllocator {
    using value_type = T;

    static constexpr std::size_t pageBytes = std::size_t{1} << 21;
    static constexpr std::size_t worthwhile = 2 * pageBytes;

    HugePageAllocator() = default;
    template <class Other>
    HugePageAllocator(const HugePageAllocator<Other> &)
    {
    }

    T *allocate(std::size_t n)
    {
        const std::size_t bytes = n * sizeof(T);
        void *memory = ::operator new(bytes, alignment(bytes));
#ifdef __linux__
        if (bytes >= worthwhile)
            ::madvise(memory, bytes / pageBytes * pageBytes, MADV_HUGEPAGE);
#endif
        return static_cast<T *>(memory);
    }
    void deallocate(T *memory, std::size_t n)
    {
        ::operator delete(memory, alignment(n * sizeof(T)));
    }

    template <class Other>
    bool operator==(const HugePageAllocator<Other> &) const
    {
        return true;
    }

private:
    static std::align_val_t alignment(std::size_t bytes)
    {
        return std::align_val_t{bytes >= worthwhile ? pageBytes : std::size_t{64}};
    }
};

template <class T>
using LargeVector = std::vector<T, HugePageAllocator<T>>;

} // namespace faintline
