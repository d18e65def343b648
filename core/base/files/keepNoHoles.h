#pragma once

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace faintline {

/// Arrays of at least `bytes` bytes return their memory to the system when freed, for the rest of the run. By default
/// the C library raises this threshold to 32 MiB, and the holes between live arrays grow to a third of all memory and
/// beyond.
inline void keepNoHoles(int bytes)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, bytes);
#else
    (void)bytes;
#endif
}

/// Returns the free pages between live small objects to the system. Takes about a millisecond.
inline void returnHoles()
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace faintline
