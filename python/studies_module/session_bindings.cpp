// Recordings as the study of several sessions reads them, and the names and forms of metrics on all pages.
// Errors are RuntimeError in one printable line.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

#include "analysis/report/headlines.h"
#include "analysis/report/page_style.h"
#include "analysis/report/reference_sessions.h"
#include "analysis/report/session_metrics.h"
#include "analysis/report/session_trace.h"
#include "common/files/input_file.h"
#include "common/recording/pcap_file.h"
#include "common/scene/scene_file.h"
#include "common/text/foreign_text.h"
#include "common/words/translation.h"
#include "imaging/bone_file/digest.h"
#include "python/module/loaded_case.h"
#include "python/studies_module/bindings.h"

namespace osteomill::python {

// Properties of a case for studies alone: its scene as text, the kind of a burr.

void bind_scenes(pybind11::module_& module) {
    namespace py = pybind11;
    module.def(
        "scene_text", [](const LoadedCase& loaded) { return write_scene(loaded.settings()); },
        py::arg("case"), "The scene of a case as a scene file has it.");
    module.def(
        "is_ball", [](const Burr& burr) { return burr.is_ball(); }, py::arg("burr"));
    module.def(
        "chips_alone",
        [](Burr burr) {
            burr.edge_coefficients_n_per_mm = glm::dvec3(0.0);
            return burr;
        },
        py::arg("burr"), "The burr without the force of its edges, as the model `published` takes it.");
}

namespace py = pybind11;

namespace {

std::string digest_of_recording(const std::filesystem::path& file) {
    return with_printable_error([&] {
        PacketReader{file};  // a file that is no recording is not read to its end
        const InputFile in(file, {.what = "a recording"});
        Digest digest;
        std::array<std::byte, 1 << 16> bytes{};
        for (std::uint64_t done = 0; done < in.size();) {
            const std::size_t read = in.read_at(done, bytes);
            if (read == 0) break;
            digest.add(std::span(bytes).first(read));
            done += read;
        }
        return digest.text();
    });
}

SessionTrace trace_of(const std::filesystem::path& file) {
    const py::gil_scoped_release released;
    return with_printable_error([&] { return read_trace(file, [](double) {}); });
}

py::dict whose_it_is(const SessionTrace& trace) {
    const SessionInfo& session = trace.session;
    py::dict record;
    record["trainee"] = session.trainee.empty() ? "(no name)" : printable(session.trainee);
    record["case_name"] = printable(session.case_name.empty() ? session.scene_name : session.case_name);
    record["began_unix_ns"] = trace.began_unix_ns;
    return record;
}

/// Names may come from a hostile file.
py::dict read_session(const std::filesystem::path& file) {
    const SessionTrace trace = trace_of(file);
    py::dict record = whose_it_is(trace);
    if (!trace.ends || !trace.error.empty()) {
        record["goes_to_s"] = trace.samples.empty() ? 0.0 : trace.samples.back().time_s;
        record["why_not"] = printable(trace.error);
        return record;
    }
    py::list metrics;
    for (const MetricRow& row : metric_rows(session_metrics(trace)))
        metrics.append(py::make_tuple(row.key, printable(row.of), row.value, row.unit, printable(row.text)));
    record["metrics"] = metrics;
    const StartConditions start = start_conditions(trace);
    py::dict felt;
    for (const auto& [name, value] : start.settings) felt[py::str(printable(name))] = printable(value);
    record["bone_at_start"] = start.bone;
    record["settings"] = felt;
    return record;
}

py::dict groups_of(const std::filesystem::path& file) {
    const auto groups = with_printable_error([&] { return trainee_groups(file); });
    py::dict printed;
    for (const auto& [trainee, found] : groups)
        printed[py::str(printable(trainee))] = py::make_tuple(printable(found.group), found.line);
    return printed;
}

py::list headline_rows() {
    py::list rows;
    for (const Headline& one : headlines)
        rows.append(
            py::make_tuple(one.key, one.text, one.unit, one.scale, text_of(one.better), one.is_count));
    return rows;
}

}  // namespace

void bind_sessions(py::module_& module) {
    module.attr("PAGE_STYLE") = page_style;
    module.def(
        "headlines", &headline_rows,
        "By which metrics people judge a session, the weightiest first: key, text, unit, scale from the "
        "metric's own unit, which is better, whether it is a count.");
    module.def(
        "number_text", [](const std::string& key, double value) { return shown_value(key, value).number; },
        py::arg("key"), py::arg("value"), "A metric's value as every page shows it, in its headline's unit.");
    module.def(
        "local_time_text", &local_time_text, py::arg("unix_ns"), py::arg("language"),
        "By the clock of this machine, as the language writes it; empty where the recording does not say.");
    module.def("with_decimal_sign", &with_decimal_sign, py::arg("text"), py::arg("language"),
               "Every number of a text with the decimal sign of one of languages().");
    module.def("languages", &languages, "Codes of ISO 639-1; en is the first.");
    module.def("words_in", &translation_into, py::arg("language"),
               "Texts of window and report in one of languages(), by the English ones; none in English.");
    module.def("trainee_groups", &groups_of, py::arg("file"),
               "Reads groups.csv: the group, and the line that says so, by the trainee's name.");
    module.def("digest_of_recording", &digest_of_recording, py::arg("file"),
               "Digest of the bytes of a file.");
    module.def(
        "read_session", &read_session, py::arg("file"),
        "Whose a recording is, of what and when; of a whole one its metrics (key, of, value, unit, text), "
        "and "
        "what it began with: the bone's digest and the settings that are felt. Of one without the session's "
        "end: goes_to_s, its last state, and why_not, why no more can be read; empty: it just ends.");
}

}  // namespace osteomill::python
