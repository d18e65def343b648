#include "bindings/arrays.h"

namespace faintline::python {

namespace py = pybind11;

py::array tableOf(const std::vector<Column> &columns)
{
    py::list fields;
    for (const Column &column : columns)
        fields.append(py::make_tuple(column.name, column.values.dtype()));
    py::array table(py::dtype::from_args(fields), std::vector<py::ssize_t>{columns.front().values.shape(0)});
    for (const Column &column : columns)
        table[py::str(column.name)] = column.values;
    return table;
}

py::array textColumn(const std::vector<std::string> &texts)
{
    py::list list;
    for (const std::string &text : texts)
        list.append(text);
    // Of no texts numpy makes numbers.
    return py::module_::import("numpy").attr("array")(list, texts.empty() ? py::object(py::str("U1")) : py::none());
}

} // namespace faintline::python
