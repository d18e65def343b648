#include "base/files/standardStreams.h"

#include <cstdio>
#include <initializer_list>

#include <fcntl.h>
#include <unistd.h>

namespace faintline {

void openStandardStreams()
{
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(descriptor, F_GETFD) < 0) // open() takes the lowest number that is free, which is this one
            (void)::open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

bool flushStandardOutput()
{
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

} // namespace faintline
