#pragma once

#include "base/Error.h"

#include <string>

namespace faintline::test {

/// The message of the Error a call throws; empty where it throws none.
template <class Call>
std::string errorOf(Call call)
{
    try {
        call();
    } catch (const Error &error) {
        return error.what();
    }
    return {};
}

inline bool contains(const std::string &text, const std::string &part)
{
    return text.find(part) != std::string::npos;
}

} // namespace faintline::test
