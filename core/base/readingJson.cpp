#include "base/readingJson.h"

namespace faintline {

std::string complaint(const Json::exception &error)
{
    const std::string text = error.what(); // "[json.exception.type_error.302] type must be string, but is number"
    if (error.id >= 304 && error.id <= 306)
        return "expected an object or a list, found a " + text.substr(text.rfind(' ') + 1);
    const std::size_t end = text.find("] ");
    return end == std::string::npos ? text : text.substr(end + 2);
}

} // namespace faintline
