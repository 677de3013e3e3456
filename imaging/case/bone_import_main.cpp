// bone_import: a scan in, a bone file out.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/files/distinct_files.h"
#include "common/program/available_memory.h"
#include "common/program/command_options.h"
#include "common/program/run_program.h"
#include "common/scene/tissue_tables.h"
#include "imaging/case/case_folder.h"
#include "imaging/case/scan_preview.h"
#include "imaging/formats/picture_stack.h"
#include "imaging/import_bone.h"
#include "imaging/segmentation/bone_of_labels.h"
#include "imaging/segmentation/segmentation.h"
#include "imaging/segmentation/segmentation_file.h"

namespace osteomill {

namespace {

/// Thrown after a signal has asked for the end.
struct Stopped : std::runtime_error {
    Stopped() : std::runtime_error("stopped; nothing was written") {}
};

struct ImportCommand {
    ImportOptions options;
    CaseParts parts;
    std::optional<std::filesystem::path> case_folder;
    std::optional<std::filesystem::path> preview;
};

/// Texts of options with a form of their own; a bad one leads to std::invalid_argument with the reason.
struct Texts {
    std::string region;
    std::vector<std::string> labels;
    std::vector<std::string> segmentations;
    std::vector<std::string> materials;
    std::vector<std::string> protect;
    std::vector<std::string> pass;
    std::string stack_spacing;
    std::string rescale;
    std::string intensity_window;
};

constexpr double preview_spacing_mm = 0.5;

/// The scan, or the bone of labels if there is no scan.
void import(const ImportOptions& options, const BegunCase& begun, const ImportSurroundings& surroundings,
            bool is_to_look_at) {
    if (begun.labels == 0) return import_bone(options, surroundings);
    import_bone(options, scan_of_labels(begun, surroundings.messages, is_to_look_at), surroundings);
}

/// A new folder beside a file, removed by the destructor.
class ScratchFolder {
  public:
    explicit ScratchFolder(const std::filesystem::path& file) : path_(file.string() + ".XXXXXX") {
        if (::mkdtemp(path_.data()) == nullptr)
            throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(errno));
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::filesystem::path path() const { return path_; }

  private:
    std::string path_;
};

/// The whole scan, coarse, by way of a file that is removed afterwards.
void preview(ImportOptions options, const BegunCase& begun, const std::filesystem::path& picture,
             const ImportSurroundings& surroundings) {
    const std::optional<ScanRegion> region = std::exchange(options.region, std::nullopt);
    options.threshold_hu.reset();
    if (picture.has_parent_path()) std::filesystem::create_directories(picture.parent_path());
    const ScratchFolder scratch(picture);
    options.output = scratch.path() / "coarse.nrrd";
    import(options, begun, surroundings, true);
    const CtVolume ct = whole_ct(options.output);
    surroundings.messages << summary_of(ct);
    if (picture.extension() == ".raw")
        write_preview_voxels(ct, begun.segmentations, picture);
    else
        write_preview(ct, region, picture);
    for (const auto& segmentation : begun.segmentations)
        for (const Segment& segment : segmentation->segments)
            surroundings.messages << "segment " << segment.name << '\n';
    surroundings.messages << "preview: " << picture.string() << '\n';
}

/// The line about a made file, with the next command if `option` is the server's option for it.
std::string made(const std::string& what, const std::string& path, const std::string& option) {
    const std::string shown = printable(path);
    std::string line = what + ": " + shown;
    if (!option.empty()) line += "; next: haptic_server --device client " + option + " '" + shown + "'";
    return line + '\n';
}

void add_options(CommandOptions& app, ImportCommand& command, Texts& texts) {
    ImportOptions& options = command.options;
    app.add_option("INPUT", options.input,
                   "DICOM folder, a NRRD, NIfTI or MetaImage file, or a folder of PNG or TIFF pictures");
    const CommandOption output =
        app.add_option("OUTPUT.nrrd", options.output, "bone file to write (int16 HU, patient LPS, gzip)");
    app.add_option("--case", command.case_folder,
                   "folder to make a case in, instead: case.toml, bone.nrrd and the segmentation")
        .type_name("DIR")
        .excludes(output);
    app.add_option(
           "--preview", command.preview,
           "instead of a bone: say what the scan covers and its HU, and draw three slices of it, at "
           "0.5 mm unless --spacing-mm says otherwise, with the --region; VOXELS.raw: all slices, a byte "
           "of grey for each voxel, then one of its segment")
        .type_name("PICTURE.png")
        .excludes(output)
        .excludes("--case");
    app.add_texts("--labels", texts.labels,
                  "in place of INPUT, with --case: bone is made of the segments of a label map that are bone "
                  "by their names, or by --material; a folder: all label maps in it, or a stack of pictures; "
                  "again for each further file")
        .type_name("FILE");
    app.add_texts(
           "--material", texts.materials,
           "what a segment is made of (scenes/materials.toml), such as \"Tooth 36=enamel\"; NAME=soft: "
           "no bone; again for each further one")
        .type_name("NAME=MATERIAL");
    app.add_option(
           "--stack-spacing", texts.stack_spacing,
           "x,y,z in mm: of pixels and slices, where INPUT or labels are a stack of PNG or TIFF pictures")
        .type_name("X,Y,Z");
    app.add_texts("--segmentation", texts.segmentations,
                  "with --case: tissues, as 3D Slicer writes them (.seg.nrrd), or a label map (NRRD, "
                  "NIfTI); again for each further file; with --preview their names are said")
        .type_name("FILE");
    app.add_option(
           "--colours", command.parts.colours,
           "names and colours of a label map's labels: a colour table of 3D Slicer (.ctbl) or ITK-SNAP")
        .type_name("FILE");
    app.add_texts(
           "--protect", texts.protect,
           "with --segmentation: a segment that must not be touched, and its own --warn-mm; again for each "
           "further one")
        .type_name("NAME[=MM]");
    app.add_option("--warn-mm", command.parts.warn_mm, "of the protected: warn of a burr that is nearer")
        .check(within(0.0, most_warn_mm))
        .shows_default();
    app.add_option("--target", command.parts.target, "with --segmentation: the segment that is to be removed")
        .type_name("NAME");
    app.add_option("--description", command.parts.description,
                   "with --case: a sentence about it for the start page; one about its bone unless given")
        .type_name("TEXT");
    app.add_texts(
           "--pass", texts.pass,
           "with --case: a mark that a session must reach to pass: time_s, plan_excess_mm3, "
           "structure_touches or peak_force_n at most, plan_removed_share (0 to 1) at least; again for "
           "each further one")
        .type_name("METRIC=NUMBER");
    app.add_option("--spacing-mm", options.spacing_mm,
                   "edge of a voxel of the result; a case of a large region that says nothing is coarser")
        .shows_default()
        .check(within(0.01, 10.0));
    app.add_option("--threshold-hu", options.threshold_hu,
                   "bone is at and above this: kept in the file for haptic_server; HU further than 2 voxels "
                   "from bone "
                   "become -1000")
        .check(within(-1024.0, 10000.0));
    app.add_flag("--keep-soft-tissue", options.keeps_soft_tissue,
                 "with --threshold-hu: HU far from bone stay, so that a carved bone can be laid beside the "
                 "scan; the file is some 3 to 10 times as large");
    app.add_flag(
        "--leave-out-specks", options.leaves_out_specks,
        "with --threshold-hu or --labels: parts of bone of less than 2 mm3 that touch nothing else become "
        "air; without, they are counted");
    app.add_option("--region", texts.region, "x0,y0,z0,x1,y1,z1 in mm of patient LPS: import only this box");
    app.add_option("--series", options.choice.series_uid,
                   "UID of the DICOM series to take (default: the largest)");
    const CommandOption rescale =
        app.add_option("--rescale", texts.rescale,
                       "SLOPE,INTERCEPT: HU = SLOPE * value + INTERCEPT, for files that carry none (after "
                       "the file's own, if it has one)");
    app.add_option(
           "--intensity-window", texts.intensity_window,
           "LOW,HIGH, for images without HU (MRI, 8-bit): LOW becomes 0 HU, HIGH 2000 HU, linear between, "
           "clamped outside")
        .excludes(rescale);
}

void require_distinct_files(const ImportCommand& command) {
    std::vector<NamedFile> files;
    const auto add_image = [&files](const char* option, const std::filesystem::path& image) {
        for (const auto& file : files_of_image(image)) files.push_back({option, file, false});
    };
    if (command.parts.labels.empty()) add_image("INPUT", command.options.input);
    for (const auto& labels : command.parts.labels) add_image("--labels", labels);
    for (const auto& segmentation : command.parts.segmentations) add_image("--segmentation", segmentation);
    if (command.parts.colours) files.push_back({"--colours", *command.parts.colours, false});
    if (command.preview) {
        files.push_back({"--preview", *command.preview});
    } else if (command.case_folder) {
        for (const auto& file : files_of_case(*command.case_folder)) files.push_back({"--case", file});
    } else {
        files.push_back({"OUTPUT", command.options.output});
    }
    require_distinct(files);
}

/// The case of labels, which have no CT numbers.
void parse_labels(const CommandOptions& app, const Texts& texts, ImportCommand& command) {
    ImportOptions& options = command.options;
    if (!options.input.empty() && !options.output.empty())
        throw std::invalid_argument("--labels: stands in place of INPUT");
    if (!options.input.empty())
        throw std::invalid_argument("--labels: makes a case: give --case DIR in place of '" +
                                    options.input.string() + "' (labels stand in place of INPUT)");
    for (const char* option :
         {"--threshold-hu", "--keep-soft-tissue", "--series", "--rescale", "--intensity-window"})
        if (app.count(option) > 0)
            throw std::invalid_argument(std::string(option) + ": goes with a scan, not with --labels");
    command.parts.labels.assign(texts.labels.begin(), texts.labels.end());
    options.input = texts.labels.front();
    options.threshold_hu = threshold_of_labels_hu;
    options.follows_contours = false;
}

/// "NAME=MATERIAL"; a name may hold "=", a material may not.
void parse_materials(const Texts& texts, CaseParts& parts) {
    for (const std::string& text : texts.materials) {
        const std::size_t at = text.rfind('=');
        if (at == std::string::npos || at == 0)
            throw std::invalid_argument("--material '" + text + "': give NAME=MATERIAL");
        parts.materials[text.substr(0, at)] = text.substr(at + 1);
    }
}

/// "NAME" or "NAME=MM"; a name may hold "=", and may end like a number if MM follows.
void parse_protected(const Texts& texts, CaseParts& parts) {
    for (const std::string& text : texts.protect) {
        const std::size_t at = text.rfind('=');
        double mm = 0.0;
        const char* const end = text.data() + text.size();
        const bool has_mm = at != std::string::npos && at > 0 && at + 1 < text.size() &&
                            std::from_chars(text.data() + at + 1, end, mm).ptr == end;
        if (has_mm && !(mm >= 0.0 && mm <= most_warn_mm))
            throw std::invalid_argument(
                fmt::format("--protect '{}': warns from 0 to {} mm on", text, most_warn_mm));
        parts.is_protected.push_back(has_mm ? text.substr(0, at) : text);
        if (has_mm) parts.warns_from_mm[text.substr(0, at)] = mm;
    }
}

/// "METRIC=NUMBER"; it also checks that a mark of this metric can be missed.
void parse_pass_marks(const Texts& texts, CaseParts& parts) {
    for (const std::string& text : texts.pass) {
        const std::string metric = text.substr(0, text.find('='));
        const PassMarkKind* const kind = pass_mark_kind(metric);
        if (kind == nullptr) {
            std::vector<std::string> metrics;
            for (const PassMarkKind& one : pass_mark_kinds) metrics.emplace_back(one.metric);
            throw std::invalid_argument(fmt::format("--pass '{}': give METRIC=NUMBER; metrics are {}", text,
                                                    fmt::join(metrics, ", ")));
        }
        double mark = 0.0;
        const char* const end = text.data() + text.size();
        const bool is_number = metric.size() < text.size() &&
                               std::from_chars(text.data() + metric.size() + 1, end, mark).ptr == end;
        if (!is_number || !(mark >= kind->low && mark <= kind->high))
            throw std::invalid_argument(
                fmt::format("--pass '{}': give a number from {} to {}", text, kind->low, kind->high));
        if (metric.starts_with("plan_") && !parts.target)
            throw std::invalid_argument(
                fmt::format("--pass '{}': needs a --target to measure against", text));
        if (metric == "rating_share")
            throw std::invalid_argument(
                fmt::format("--pass '{}': needs a [[rating]], which is written into case.toml", text));
        if (metric == "structure_touches" && parts.is_protected.empty())
            throw std::invalid_argument(
                fmt::format("--pass '{}': needs a segment that is to --protect", text));
        parts.pass[metric] = mark;
    }
}

void parse_texts(const CommandOptions& app, const Texts& texts, ImportCommand& command) {
    ImportOptions& options = command.options;
    if (options.keeps_soft_tissue && !options.threshold_hu)
        throw std::invalid_argument("--keep-soft-tissue: goes with --threshold-hu; without, all HU are kept");
    if (options.leaves_out_specks && !options.threshold_hu && texts.labels.empty())
        throw std::invalid_argument(
            "--leave-out-specks: goes with --threshold-hu; without, nothing says what is bone");
    if (app.count("--region") > 0) options.region = parse_region(texts.region);
    if (app.count("--rescale") > 0) options.to_hu = parse_rescale(texts.rescale);
    if (app.count("--intensity-window") > 0) options.to_hu = parse_intensity_window(texts.intensity_window);
    const bool has_segments = !texts.segmentations.empty() || !texts.labels.empty();
    if (!command.case_folder && !command.preview && has_segments)
        throw std::invalid_argument(std::string(texts.labels.empty() ? "--segmentation" : "--labels") +
                                    ": goes with --case or --preview");
    for (const char* option : {"--colours", "--protect", "--warn-mm", "--target", "--material"})
        if (!has_segments && app.count(option) > 0)
            throw std::invalid_argument(std::string(option) + ": goes with --segmentation or --labels");
    if (!texts.labels.empty())
        parse_labels(app, texts, command);
    else if (options.input.empty())
        throw std::invalid_argument("give INPUT, or --labels FILE (see --help)");
    parse_materials(texts, command.parts);
    parse_protected(texts, command.parts);
    for (const char* option : {"--description", "--pass"})
        if (!command.case_folder && app.count(option) > 0)
            throw std::invalid_argument(std::string(option) + ": goes with --case");
    parse_pass_marks(texts, command.parts);
    if (!texts.stack_spacing.empty())
        options.choice.stack_spacing_mm = command.parts.stack_spacing_mm =
            parse_stack_spacing(texts.stack_spacing);
    command.parts.segmentations.assign(texts.segmentations.begin(), texts.segmentations.end());
    if (command.preview) {
        if (app.count("--spacing-mm") == 0) options.spacing_mm = preview_spacing_mm;
        return;
    }
    if (!command.case_folder && options.output.empty())
        throw std::invalid_argument("give OUTPUT.nrrd, --case DIR or --preview PICTURE.png (see --help)");
    if (command.case_folder) {
        options.output = bone_of_case(*command.case_folder);
        options.may_be_coarser = app.count("--spacing-mm") == 0;
    }
    if (options.output.extension() != ".nrrd")
        throw std::invalid_argument("OUTPUT '" + options.output.string() + "': its name must end in .nrrd");
}

ParseResult<ImportCommand> parse(int argc, const char* const* argv) {
    ImportCommand command;
    Texts texts;
    CommandOptions app("Makes a bone file of a CT scan: isotropic, in patient LPS, in HU.", "bone_import",
                       OSTEOMILL_VERSION);
    add_options(app, command, texts);
    if (auto text = app.parse_or_text(argc, argv)) return {std::nullopt, *std::move(text)};
    parse_texts(app, texts, command);
    require_distinct_files(command);
    return {std::move(command), {}};
}

void run(const ImportCommand& command, const ProgramOutput& output) {
    const std::atomic<bool>& is_stopped = stop_on_signals();
    LineStreamBuffer buffer(*output.err);
    std::ostream messages(&buffer);
    messages << std::unitbuf;
    const ImportSurroundings surroundings{.messages = messages,
                                          .is_terminal = output.err->is_terminal(),
                                          .available_memory_bytes = available_memory_bytes(),
                                          .go_on = [&] {
                                              if (is_stopped) throw Stopped();
                                          }};
    // Every check comes before an hour of work.
    const BegunCase begun = read_case_parts(command.parts);
    std::optional<UnfinishedCase> unfinished;
    if (command.case_folder) {
        unfinished.emplace(*command.case_folder);
        begin_case(*command.case_folder);
    }
    if (command.preview)
        preview(command.options, begun, *command.preview, surroundings);
    else
        import(command.options, begun, surroundings, false);
    if (command.case_folder) {
        finish_case(*command.case_folder, begun, messages, surroundings.go_on);
        unfinished->finish();
        messages << made("case", command.case_folder->string(), "--case");
    } else if (!command.preview) {
        // Without a threshold nothing tells which voxels are bone.
        messages << made("bone", command.options.output.string(),
                         command.options.threshold_hu ? "--bone" : "");
    }
}

}  // namespace

}  // namespace osteomill

int bone_import_main(int argc, char** argv) {
    return osteomill::run_program(
        "bone_import", [&] { return osteomill::parse(argc, argv); }, osteomill::run);
}
