#include "bindings/bind.h"

#include "base/Error.h"
#include "base/oneLine.h"

namespace faintline::python {

namespace py = pybind11;

namespace {

    void raise(const Error &error)
    {
        const py::object type = py::module_::import("faintline._error").attr("Error");
        const py::object instance = type(oneLine(error.where(), longestMessage), oneLine(error.why(), longestMessage),
                                         error.kind() == Error::Kind::Mistake, error.field());
        PyErr_SetObject(type.ptr(), instance.ptr());
    }

} // namespace

void bindErrors(py::module_ &)
{
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown)
                std::rethrow_exception(thrown);
        } catch (const Error &error) {
            raise(error);
        } catch (const Cancelled &) {
            PyErr_SetNone(PyExc_KeyboardInterrupt);
        }
    });
}

} // namespace faintline::python
