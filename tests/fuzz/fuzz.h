#pragma once

#include <string>
#include <vector>

namespace faintline::fuzz {

/// The input, as text and as a file whose name has the parser's ending.
struct Input {
    std::string text;
    std::string path;
};

struct Parser {
    const char *name;
    const char *ending;
    void (*read)(const Input &);
};

/// Those of this program: core.cpp's or window.cpp's.
const std::vector<Parser> &parsers();

} // namespace faintline::fuzz
