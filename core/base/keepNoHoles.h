#pragma once

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace faintline {

/// Arrays of so many bytes and more go back to the system as they are let go, for as long as the program runs. By itself
/// the C library raises that limit to 32 MiB, and what lies between the arrays that are kept grows to a third of all
/// memory, and goes on growing.
inline void keepNoHoles(int bytes)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, bytes);
#else
    (void)bytes;
#endif
}

} // namespace faintline
