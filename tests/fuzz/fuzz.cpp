// One program that feeds bytes to any of its parsers: `FAINTLINE_FUZZ=NAME faintline-fuzz CORPUS`. tests/fuzz.sh runs
// all.

#include "fuzz/fuzz.h"

#include "base/Error.h"
#include "base/oneLine.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace faintline;
using faintline::fuzz::Input;
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

} // namespace

extern "C" int LLVMFuzzerInitialize(int *, char ***)
{
    chosen(); // says what there is before the library says anything
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t size)
{
    static const Parser &parser = chosen();
    static const std::string path = "/dev/shm/faintline-fuzz-" + std::to_string(::getpid()) + "/input" + parser.ending;
    static const bool isThere = std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    (void)isThere;
    const Input input{std::string(reinterpret_cast<const char *>(bytes), size), path};
    std::ofstream(path, std::ios::binary) << input.text;
    try {
        parser.read(input);
    } catch (const Error &error) {
        if (oneLine(error.what()).empty())
            std::abort(); // a refusal says something
    }
    return 0; // any other exception is a finding
}
