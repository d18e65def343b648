#pragma once

namespace faintline {

/// Several lambdas as one, for std::visit: the one that fits is called.
template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>; // clang 14 does not find it by itself

} // namespace faintline
