#include "fuzz/fuzz.h"

#include "base/Error.h"
#include "base/oneLine.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace faintline::fuzz {

namespace {

    const std::filesystem::path &folder()
    {
        static const std::filesystem::path path =
            std::filesystem::temp_directory_path() / ("faintline-fuzz-" + std::to_string(::getpid()));
        return path;
    }

} // namespace

void feed(const Parser &parser, const std::string &text)
{
    constexpr double mostSeconds = 10.0;
    std::filesystem::create_directories(folder());
    const Input input{text, (folder() / (std::string("input") + parser.ending)).string()};
    std::ofstream(input.path, std::ios::binary) << text;
    const std::clock_t begin = std::clock();
    try {
        parser.read(input);
    } catch (const Error &error) {
        if (oneLine(error.what()).empty())
            std::abort(); // a refusal says something
    }
    if (double(std::clock() - begin) > mostSeconds * CLOCKS_PER_SEC) {
        std::fprintf(stderr, "%s takes more than %g s of a processor\n", parser.name, mostSeconds);
        std::abort();
    }
}

void cleanUp()
{
    std::error_code ignored;
    std::filesystem::remove_all(folder(), ignored);
}

} // namespace faintline::fuzz
