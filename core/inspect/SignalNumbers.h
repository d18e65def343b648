#pragma once

#include "inspect/Review.h"

#include <memory>
#include <string>
#include <vector>

namespace faintline {

/// The numbers by which a person knows the signals of a recording. They stay with them, by their paths as reviews do,
/// when the detector runs again with another threshold or other settings. Part of a session; no detection depends on
/// them.
class SignalNumbers
{
public:
    /// The analysis with its tracks renumbered: signals that are known keep their numbers, the others get the next free
    /// ones, in their order. The first analysis keeps its own; a first estimate is neither renumbered nor remembered.
    /// Cost: tracks × known signals.
    std::shared_ptr<const Analysis> number(std::shared_ptr<const Analysis> analysis);

    /// Whether no analysis had to be renumbered so far.
    bool areUsual() const { return m_areUsual; }

    bool operator==(const SignalNumbers &) const = default;

    /// A list of {"number", "path"}.
    friend Json toJson(const SignalNumbers &numbers);
    /// Throws Error naming `where`, or Json::exception for values of the wrong kind.
    static SignalNumbers fromJson(const Json &json, const std::string &where);

private:
    struct Known {
        int number = 0;
        SignalPath path; ///< as last seen
        bool operator==(const Known &) const = default;
    };

    std::vector<Known> m_known;
    bool m_areUsual = true;
};

} // namespace faintline
