// Checks and display of texts from elsewhere, as in all programs. They come as bytes, since they may not be
// UTF-8.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "common/text/address_text.h"
#include "common/text/csv.h"
#include "common/text/foreign_text.h"
#include "python/studies_module/bindings.h"

namespace osteomill::python {

void bind_texts(pybind11::module_& module) {
    namespace py = pybind11;
    module.def(
        "why_not_plain", [](const std::string& text) { return why_not_plain(text); }, py::arg("text"),
        "Why a text is no UTF-8 without control characters; None where it is.");
    module.def(
        "printable", [](const std::string& text) { return printable(text); }, py::arg("text"),
        "The text, each byte of a control character and each that is no UTF-8 as \\xNN.");
    module.def(
        "one_line", [](const std::string& text) { return one_line(text); }, py::arg("text"),
        "The same of its first 200 bytes.");
    module.def(
        "csv_cell", [](const std::string& text) { return csv_cell(text); }, py::arg("text"),
        "A text as a cell of CSV, which a spreadsheet does not compute.");
    module.def(
        "without_passwords", [](const std::string& text) { return without_passwords(printable(text)); },
        py::arg("text"), "The text, printable, with *** for each password of an address.");
    module.def(
        "holds_password", [](const std::string& address) { return holds_password(address); },
        py::arg("address"), "Whether an address of libpq has a password.");
}

}  // namespace osteomill::python
