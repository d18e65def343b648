#include "bindings/eventArray.h"

#include "analyse/columns.h"
#include "bindings/arrays.h"

#include <type_traits>

namespace faintline::python {

namespace py = pybind11;

namespace {

    /// The cells of a column, all of which are a T.
    template <class T, class Row>
    py::array valuesOf(const TableColumn<Row> &column, const std::vector<Row> &rows)
    {
        std::vector<T> values;
        for (const Row &row : rows)
            values.push_back(std::get<T>(column.value(row)));
        if constexpr (std::is_same_v<T, std::string>) {
            return textColumn(values);
        } else {
            py::array_t<T> array(static_cast<py::ssize_t>(values.size()));
            std::copy(values.begin(), values.end(), array.mutable_data());
            return array;
        }
    }

    template <class Row>
    py::array tableOf(const std::vector<TableColumn<Row>> &columns, const std::vector<Row> &rows)
    {
        std::vector<Column> arrays;
        for (const TableColumn<Row> &column : columns)
            arrays.push_back(
                {column.name, std::visit([&]<class T>(const T &) { return valuesOf<T>(column, rows); }, column.kind)});
        return tableOf(arrays);
    }

} // namespace

py::array eventArray(const Analysis &analysis)
{
    return tableOf(eventColumns(analysis.grid(), OptionalColumns::of(analysis)), events(analysis));
}

py::array areaArray(const Analysis &analysis)
{
    return tableOf(areaColumns(), areaEvents(analysis));
}

} // namespace faintline::python
