// Reading and writing of files, as in all programs. Errors are RuntimeError in one printable line.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/files/atomic_file.h"
#include "common/files/distinct_files.h"
#include "common/files/input_file.h"
#include "common/text/csv.h"
#include "common/text/foreign_json.h"
#include "common/text/foreign_text.h"
#include "common/text/words.h"
#include "python/studies_module/bindings.h"

namespace osteomill::python {

namespace py = pybind11;

namespace {

py::bytes read_file(const std::filesystem::path& file) {
    return with_printable_error([&] { return py::bytes(read_text(file, json_kind)); });
}

/// Number and cells of each line that is not empty.
std::vector<std::pair<int, std::vector<py::bytes>>> table_lines(const std::filesystem::path& file) {
    return with_printable_error([&] {
        std::vector<std::pair<int, std::vector<py::bytes>>> found;
        TableLines lines(read_text(file, table_kind), file.string());
        while (lines.next()) {
            const std::vector<std::string> cells = cells_of(lines.line());
            found.emplace_back(lines.number(), std::vector<py::bytes>(cells.begin(), cells.end()));
        }
        return found;
    });
}

void write_file(const std::filesystem::path& file, const std::string& text) {
    with_printable_error([&] { write_atomic_file(file, text, Link::replace); });
}

using Read = std::pair<std::string, std::filesystem::path>;

void require_distinct_files(const std::vector<Read>& read, const std::filesystem::path& folder,
                            const std::vector<std::string>& names) {
    std::vector<NamedFile> files;
    for (const auto& [option, path] : read) files.push_back({option, path, false});
    for (const std::string& name : names) files.push_back({.option = "--out", .path = folder, .names = name});
    with_printable_error([&] { require_distinct(files); });
}

}  // namespace

void bind_files(py::module_& module) {
    module.def("read_file", &read_file, py::arg("file"), "All of a regular file of at most 256 MiB.");
    module.attr("DEEPEST_JSON") = deepest_json;
    module.def(
        "depth_of_json", [](const std::string& text) { return depth_of_json(text); }, py::arg("text"),
        "How deep lists and objects lie in one another.");
    module.def("table_lines", &table_lines, py::arg("file"),
               "Reads a table in CSV, at most 64 MiB: the number of each line that is neither blank nor a "
               "comment, and "
               "its cells, without blanks around them.");
    module.def("write_file", &write_file, py::arg("file"), py::arg("text"),
               "Replaces a file as a whole; of a link, the link.");
    module.def("require_distinct_files", &require_distinct_files, py::arg("read"), py::arg("folder"),
               py::arg("names"),
               "Refuses where one of the files that options name is one that is written into the folder of "
               "--out, under one of these names (fnmatch).");
}

// Checks and display of texts from elsewhere, as in all programs. They come as bytes, since they may not be
// UTF-8.

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
