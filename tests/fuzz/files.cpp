// Feeds files to each parser of its table: `faintline-parsers FILE|FOLDER…`. A test runs it with what the fuzzers begin
// with and what they once broke a parser with, whatever the compiler.

#include "fuzz/fuzz.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace faintline;
using faintline::fuzz::Parser;

namespace {

std::vector<std::filesystem::path> filesOf(int count, char **names)
{
    std::vector<std::filesystem::path> files;
    for (int i = 1; i < count; ++i) {
        if (!std::filesystem::is_directory(names[i])) {
            files.emplace_back(names[i]);
            continue;
        }
        for (const auto &entry : std::filesystem::recursive_directory_iterator(names[i]))
            if (entry.is_regular_file())
                files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string contentOf(const std::filesystem::path &path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

int main(int count, char **names)
{
    const std::vector<std::filesystem::path> files = filesOf(count, names);
    if (files.empty()) {
        std::fprintf(stderr, "error: no files\n");
        return 2;
    }
    int status = 0;
    for (const std::filesystem::path &file : files) {
        const std::string content = contentOf(file);
        std::printf("%s\n", file.c_str());
        for (const Parser &parser : fuzz::parsers()) {
            std::printf("    %s\n", parser.name); // the last one, where the program breaks down
            std::fflush(stdout);
            try {
                fuzz::feed(parser, content);
            } catch (const std::exception &error) {
                std::printf("error: %s, %s: %s\n", file.c_str(), parser.name, error.what());
                status = 1;
            }
        }
    }
    fuzz::cleanUp();
    return status;
}
