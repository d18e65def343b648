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

/// Gives it an input. Aborts where the parser refuses without a word, or takes more than 10 s of a processor; any
/// exception but a refusal comes through.
void feed(const Parser &parser, const std::string &text);

/// Removes what feeding has left behind.
void cleanUp();

} // namespace faintline::fuzz
