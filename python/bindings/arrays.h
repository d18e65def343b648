#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace faintline::python {

/// A read-only array view of values that `owner` keeps alive, without a copy.
template <class T>
pybind11::array_t<T> viewOf(std::shared_ptr<const void> owner, const T *values,
                            const std::vector<pybind11::ssize_t> &shape)
{
    const auto *kept = new std::shared_ptr<const void>(std::move(owner));
    const pybind11::capsule base(kept, [](void *held) { delete static_cast<std::shared_ptr<const void> *>(held); });
    pybind11::array_t<T> array(shape, values, base);
    array.attr("setflags")(pybind11::arg("write") = false);
    return array;
}

/// The same for a vector, of which it takes ownership.
template <class T>
pybind11::array_t<T> arrayOf(std::vector<T> values, const std::vector<pybind11::ssize_t> &shape)
{
    const auto owner = std::make_shared<const std::vector<T>>(std::move(values));
    return viewOf(owner, owner->data(), shape);
}

/// The same, one-dimensional.
template <class T>
pybind11::array_t<T> arrayOf(std::vector<T> values)
{
    const auto count = static_cast<pybind11::ssize_t>(values.size());
    return arrayOf(std::move(values), {count});
}

/// A column of a table and its name.
struct Column {
    std::string name;
    pybind11::array values;
};

/// Columns of equal length as one structured array, one record per row.
pybind11::array tableOf(const std::vector<Column> &columns);

/// A column of text.
pybind11::array textColumn(const std::vector<std::string> &texts);

} // namespace faintline::python
