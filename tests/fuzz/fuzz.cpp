// One program that feeds bytes to any of its parsers: `FAINTLINE_FUZZ=NAME faintline-fuzz CORPUS`. It ends after
// FAINTLINE_FUZZ_SECONDS of a processor, if that is set, so that a busy machine makes it no less thorough.
// tests/fuzz.sh runs all.

#include "fuzz/fuzz.h"

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

using namespace faintline;
using faintline::fuzz::Parser;

namespace {

const Parser &chosen()
{
    const char *name = std::getenv("FAINTLINE_FUZZ");
    for (const Parser &parser : fuzz::parsers())
        if (name && std::string(name) == parser.name)
            return parser;
    for (const Parser &parser : fuzz::parsers())
        std::printf("%s\n", parser.name);
    std::fflush(stdout);
    std::_Exit(name && std::string(name) == "LIST" ? 0 : 2); // the library takes an exit for a finding
}

bool isOver()
{
    static const char *seconds = std::getenv("FAINTLINE_FUZZ_SECONDS");
    static const double most = seconds ? std::atof(seconds) : 0.0;
    return most > 0.0 && double(std::clock()) > most * CLOCKS_PER_SEC;
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int *, char ***)
{
    chosen(); // says what there is before the library says anything
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t size)
{
    static const Parser &parser = chosen();
    fuzz::feed(parser, std::string(reinterpret_cast<const char *>(bytes), size)); // an exception is a finding
    if (isOver())
        std::raise(SIGUSR1); // the library says what it counted, and ends
    return 0;
}
