// Recordings in Python.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "analysis/hdf5/recording_hdf5.h"
#include "analysis/replay/recording_summary.h"
#include "analysis/report/metrics_csv_json.h"
#include "analysis/report/session_metrics.h"
#include "common/recording/playhead.h"
#include "python/module/arrays.h"
#include "python/module/bindings.h"
#include "python/module/python_bone.h"
#include "python/module/released_lock.h"
#include "python/module/repeated_session.h"
#include "python/module/tick_columns.h"

namespace osteomill::python {

/// A value, or three, for each state.
struct StateColumns {
    std::vector<double> time_s, session_time_s;
    std::vector<double> hand_mm, burr_mm, axis, force_n;
    std::vector<double> depth_mm, removed_mm3;
    std::vector<std::uint8_t> burr, spindle_on;
};

/// All ticks of a recording that can be read.
std::vector<TickSample> ticks_of(const std::filesystem::path& file);

class OpenedRecording {
  public:
    /// Throws RecordingError if it holds no bone.
    explicit OpenedRecording(std::filesystem::path file)
        : file_(std::move(file)), playhead_(std::in_place, file_) {}

    const std::filesystem::path& file() const { return file_; }

    // One thread at a time: the caller of these holds `busy`.
    std::mutex& busy() { return busy_; }

    /// Reads the recording through, the first time.
    const StateColumns& columns() { return read(), columns_; }
    const RecordingSummary& summary() { return read(), *summary_; }

    /// The bone after the last frame that is no later than `time_s`, seconds since the recording began. Goes
    /// on from the last requested time, or begins anew if that is later. Throws RecordingError for a fault
    /// before that time.
    const Bone& bone_at(double time_s);

  private:
    void read();

    std::filesystem::path file_;
    std::mutex busy_;
    std::optional<Playhead> playhead_;
    StateColumns columns_;
    std::optional<RecordingSummary> summary_;
};

namespace {

using SharedRecording = std::shared_ptr<OpenedRecording>;

py::object from_json(const std::string& text) {
    return py::module_::import("json").attr("loads")(text);
}

/// A property that is a copy of a column, (N,) or (N, 3).
template <typename Value>
auto column(std::vector<Value> StateColumns::*values, int width = 1) {
    return [values, width](const SharedRecording& recording) {
        const std::unique_lock<std::mutex> held = waited(recording->busy());
        std::vector<Value> copy;
        {
            const ReleasedLock released;
            copy = recording->columns().*values;
        }
        const auto n = static_cast<py::ssize_t>(copy.size()) / width;
        return array_of(std::move(copy),
                        width == 1 ? std::vector<py::ssize_t>{n} : std::vector<py::ssize_t>{n, width});
    };
}

PythonBone bone_at(const SharedRecording& recording, double time_s) {
    if (!(time_s >= 0.0))
        throw std::invalid_argument(fmt::format("time_s: takes seconds from 0 on, not {}", time_s));
    const ReleasedLock released;
    const std::unique_lock<std::mutex> held(recording->busy());
    return PythonBone(Bone(recording->bone_at(time_s)));
}

py::object metrics(const SharedRecording& recording) {
    std::string text;
    {
        const ReleasedLock released;
        const SessionTrace trace = read_trace(recording->file(), [](double) {});
        text = metrics_json(trace, metric_rows(session_metrics(trace)));
    }
    return from_json(text)["metrics"];
}

py::object rating(const SharedRecording& recording) {
    std::string text;
    {
        const ReleasedLock released;
        const RatingResult found = session_metrics(read_trace(recording->file(), [](double) {})).rating;
        if (!found.items.empty())
            text = rating_json(found).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    }
    return text.empty() ? py::none() : from_json(text);
}

py::object info(const SharedRecording& recording) {
    std::string text;
    {
        const ReleasedLock released;
        const std::unique_lock<std::mutex> held(recording->busy());
        // Names may come from a hostile file.
        text = to_json(recording->summary())
                   .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    }
    return from_json(text);
}

void to_hdf5(const SharedRecording& recording, const std::filesystem::path& file, const std::string& layout) {
    const auto* const name = std::ranges::find(hdf5_layout_names, layout);
    if (name == hdf5_layout_names.end())
        throw std::invalid_argument(
            fmt::format("layout: takes {}, not '{}'", fmt::join(hdf5_layout_names, ", "), layout));
    const ReleasedLock released;
    const std::string error = write_hdf5(
        recording->file(), file, static_cast<Hdf5Layout>(name - hdf5_layout_names.begin()), [](double) {});
    if (!error.empty()) throw std::runtime_error(error);
}

/// Every tick, read on request and not kept.
py::dict ticks(const SharedRecording& recording) {
    std::vector<TickSample> all;
    {
        const ReleasedLock released;
        all = ticks_of(recording->file());
    }
    const auto n = static_cast<py::ssize_t>(all.size());
    const auto vector = [&](const auto& of) {
        std::vector<double> column;
        column.reserve(3 * all.size());
        for (const TickSample& tick : all) {
            const glm::dvec3 v = of(tick);
            column.insert(column.end(), {v.x, v.y, v.z});
        }
        return array_of(std::move(column), {n, 3});
    };
    const auto number = [&]<typename Value>(Value, const auto& of) {
        std::vector<Value> column;
        column.reserve(all.size());
        for (const TickSample& tick : all) column.push_back(static_cast<Value>(of(tick)));
        return array_of(std::move(column), {n});
    };
    using T = const TickSample&;
    py::dict columns;
    columns["time_s"] = number(0.0, [](T tick) { return tick.time_s; });
    columns["hand_mm"] = vector([](T tick) { return tick.hand_mm; });
    columns["burr_mm"] = vector([](T tick) { return tick.burr_mm; });
    columns["axis"] = vector([](T tick) { return tick.spindle_axis; });
    columns["force_n"] = vector([](T tick) { return tick.force_n; });
    columns["torque_nmm"] = vector([](T tick) { return tick.shank_torque_n_mm.value_or(glm::dvec3(0.0)); });
    columns["depth_mm"] = number(0.0, [](T tick) { return tick.depth_mm; });
    columns["removed_mm3"] = number(0.0, [](T tick) { return tick.removed_mm3; });
    columns["spindle_on"] =
        number(std::uint8_t{}, [](T tick) { return tick.spindle_on; }).attr("view")("bool");
    columns["pedal"] = number(std::uint8_t{}, [](T tick) {
                           return tick.input ? tick.input->pedal == TickInput::Pedal::down : tick.spindle_on;
                       }).attr("view")("bool");
    columns["fault"] = number(std::uint8_t{}, [](T tick) { return tick.fault; });
    columns["burr"] = number(std::uint8_t{}, [](T tick) { return tick.burr; });
    return columns;
}

py::object repeated(const std::filesystem::path& file) {
    const RepeatedSession result = [&file] {
        const ReleasedLock released;
        return repeat_session(file, [](double) {
            const py::gil_scoped_acquire acquired;
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        });
    }();
    return py::make_tuple(result.is_equal, result.line(), result.ticks, result.tick, result.time_s);
}

}  // namespace

void bind_recording(py::module_& module) {
    module.def("_repeat", &repeated, py::arg("file"), "Backs osteomill.repeat.");
    py::class_<OpenedRecording, SharedRecording>(
        module, "Recording", R"(A recording of a session: its states, and its bone at any instant.

It is read through when the first array is requested. Arrays have a row a state, thirty a second; they are copies, in
patient LPS.)")
        .def(py::init([](std::filesystem::path file) {
                 return std::make_shared<OpenedRecording>(std::move(file));
             }),
             py::arg("file"),
             "Opens a file of haptic_server --record, --report (session.pcap) or Session(record=...). "
             "RuntimeError: it is none.")
        .def_property_readonly(
            "file", [](const SharedRecording& recording) { return recording->file(); },
            "The file that was opened.")
        .def_property_readonly("time_s", column(&StateColumns::time_s),
                               "Seconds since the recording began: (N,).")
        .def_property_readonly("session_time_s", column(&StateColumns::session_time_s),
                               "Time of the session: (N,).")
        .def_property_readonly("hand_mm", column(&StateColumns::hand_mm, 3), "Where the hand is: (N, 3).")
        .def_property_readonly("burr_mm", column(&StateColumns::burr_mm, 3), "Centre of the burr: (N, 3).")
        .def_property_readonly("axis", column(&StateColumns::axis, 3),
                               "Direction of the spindle from tip to shank: (N, 3), unit.")
        .def_property_readonly("force_n", column(&StateColumns::force_n, 3), "On the hand: (N, 3).")
        .def_property_readonly("depth_mm", column(&StateColumns::depth_mm), "As Step.depth_mm: (N,).")
        .def_property_readonly("removed_mm3", column(&StateColumns::removed_mm3),
                               "Bone removed so far: (N,).")
        .def_property_readonly("burr", column(&StateColumns::burr), "Number of the burr: uint8 (N,).")
        .def_property_readonly(
            "spindle_on",
            [](const SharedRecording& recording) {
                return column(&StateColumns::spindle_on)(recording).attr("view")("bool");
            },
            "bool (N,).")
        .def("bone_at", &bone_at, py::arg("time_s"),
             "The bone after the last frame that is no later than `time_s`, seconds since the recording "
             "began. Ascending times cost "
             "what lies between them. RuntimeError: the file is damaged before that.")
        .def("metrics", &metrics,
             "The metrics of docs/metrics.md, by key, as metrics.json has them: a number or None; those of "
             "tissues, burrs or structures "
             "under KEY_of, by name.")
        .def("rating", &rating,
             "The outcome of the case's rating, as metrics.json has it: points, most_points, undos, "
             "undone_mm3, and items with name, points, is_reached (None: not decided), when, source and "
             "values. None: the case has no rating, or the recording is not complete.")
        .def("to_hdf5", &to_hdf5, py::arg("file"), py::arg("layout") = "osteomill",
             "Writes all of it into an HDF5 file (docs/hdf5.md); layout: \"osteomill\", \"fivrs\" or "
             "\"fivrs-v3\". A torn recording is written as far as it can be read. RuntimeError: it cannot be "
             "written, or is "
             "damaged; ValueError: no such layout.")
        .def_property_readonly("ticks", &ticks,
                               "Every tick of the session, a millisecond each, as a dict of arrays of the "
                               "names of Session.rollout: time_s, "
                               "depth_mm, removed_mm3 (the total), spindle_on, pedal, fault, burr (N,); "
                               "hand_mm, burr_mm, axis, force_n, "
                               "torque_nmm (N, 3). Read from the file whenever it is asked. Hand, axis and "
                               "pedal, fed to rollout, give the "
                               "same bone and forces to the bit; the first row is the tick that a session "
                               "begins with. Empty where the "
                               "recording holds none.")
        .def(
            "info", &info,
            "The contents of packet_replay --json: duration_s, frames, removed_mm3 by tissue, bone_checksum, "
            "error and more.")
        .def("__enter__", [](const SharedRecording& recording) { return recording; })
        .def("__exit__", [](const SharedRecording&, const py::args&) {})
        .def("__repr__", [](const SharedRecording& recording) {
            return fmt::format("<Recording {}>", recording->file().string());
        });
}

namespace {

void add(StateColumns& columns, const Playhead& playhead) {
    const ToolState& tool = *playhead.tool();
    columns.time_s.push_back(playhead.time_s());
    columns.session_time_s.push_back(tool.time_s);
    push(columns.hand_mm, tool.hand_position_mm);
    push(columns.burr_mm, tool.burr_position_mm);
    push(columns.axis, tool.spindle_axis);
    push(columns.force_n, tool.force_n);
    columns.depth_mm.push_back(tool.depth_mm.value_or(0.0));
    columns.removed_mm3.push_back(tool.removed_mm3);
    columns.burr.push_back(static_cast<std::uint8_t>(tool.burr));
    columns.spindle_on.push_back(tool.spindle_on ? 1 : 0);
}

}  // namespace

std::vector<TickSample> ticks_of(const std::filesystem::path& file) {
    std::vector<TickSample> all;
    Playhead playhead(file);
    play_to_end(
        playhead, [](double) {},
        [&](Playhead::Step step) {
            if (step != Playhead::Step::state) return;
            all.insert(all.end(), playhead.ticks().begin(), playhead.ticks().end());
        });
    return all;
}

void OpenedRecording::read() {
    if (summary_) return;
    StateColumns columns;
    summary_ = summarise(file_, [&](const Playhead& playhead) { add(columns, playhead); });
    columns_ = std::move(columns);
}

const Bone& OpenedRecording::bone_at(double time_s) {
    if (playhead_->time_s() > time_s) playhead_.emplace(file_);
    for (;;) {
        const Playhead::Step step = playhead_->step(time_s);
        if (step == Playhead::Step::nothing_due || step == Playhead::Step::end) return playhead_->bone();
    }
}

}  // namespace osteomill::python
