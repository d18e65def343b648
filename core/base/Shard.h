#pragma once

#include <string>

namespace faintline {

/// Part `index` of `count` of a computation on numbered items: those with number ≡ index (mod count). Indices 0 and
/// count denote the same part.
struct Shard {
    int index = 0;
    int count = 1;

    bool isWhole() const { return count == 1; }
    /// "2/8"; empty for the whole.
    std::string name() const
    {
        return isWhole() ? std::string() : std::to_string(index % count) + "/" + std::to_string(count);
    }
};

} // namespace faintline
