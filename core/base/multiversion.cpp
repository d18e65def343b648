#include "base/multiversion.h"

#include <algorithm>
#include <cstdlib>

namespace faintline {

int vectorBytes()
{
    int widest = 16;
#ifdef FAINTLINE_HAS_VERSIONS
    if (__builtin_cpu_supports("x86-64-v3"))
        widest = 32;
    if (__builtin_cpu_supports("x86-64-v4"))
        widest = 64;
#endif
    if (const char *wish = std::getenv("FAINTLINE_VECTOR_BYTES"))
        widest = std::min(widest, std::atoi(wish) >= 64 ? 64 : std::atoi(wish) >= 32 ? 32 : 16);
    return widest;
}

} // namespace faintline
