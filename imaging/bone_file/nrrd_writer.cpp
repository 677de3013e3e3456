#include "imaging/bone_file/nrrd_writer.h"

#include <fmt/format.h>

#include <bit>
#include <stdexcept>
#include <string>

#include "imaging/bone_file/digest.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

static_assert(std::endian::native == std::endian::little, "voxels are written as they lie in memory");

/// A line break would end the line.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char letter : text) {
        if (letter == '\n') {
            result += "\\n";
        } else if (letter == '\\') {
            result += "\\\\";
        } else {
            result += letter;
        }
    }
    return result;
}

std::string header_of(const NrrdForm& form) {
    const Grid& grid = form.grid;
    const double h = grid.spacing_mm;
    const bool has_layers = form.layers > 1;
    std::string text = fmt::format(
        "NRRD0005\n"
        "# Complete NRRD file format specification at:\n"
        "# http://teem.sourceforge.net/nrrd/format.html\n"
        "type: {}\n"
        "dimension: {}\n"
        "space: left-posterior-superior\n"
        "sizes: {}{} {} {}\n"
        "space directions: {}({},0,0) (0,{},0) (0,0,{})\n"
        "kinds: {}domain domain domain\n"
        "endian: little\n"
        "encoding: gzip\n"
        "space origin: ({},{},{})\n",
        form.voxel == NrrdVoxel::int16 ? "int16" : "uint8", has_layers ? 4 : 3,
        has_layers ? fmt::format("{} ", form.layers) : "", grid.size_voxels.x, grid.size_voxels.y,
        grid.size_voxels.z, has_layers ? "none " : "", h, h, h, has_layers ? "list " : "", grid.origin_mm.x,
        grid.origin_mm.y, grid.origin_mm.z);
    if (form.bytes_before_voxels > 0) text += fmt::format("byte skip: {}\n", form.bytes_before_voxels);
    for (const auto& [key, value] : form.key_values)
        text += fmt::format("{}:={}\n", escaped(key), escaped(value));
    return text + "\n";
}

AtomicFile begun(const std::filesystem::path& path, const NrrdForm& form) {
    require_valid(form.grid);
    if (path.extension() != ".nrrd") throw ImagingError(path, "the name of a bone file ends in .nrrd");
    remove_abandoned_parts(path);
    return AtomicFile(path);
}

}  // namespace

NrrdWriter::NrrdWriter(const std::filesystem::path& path, const NrrdForm& form)
    : form_(form), file_(begun(path, form)) {
    const std::string header = header_of(form_);
    header_bytes_ = header.size();
    file_.write(std::as_bytes(std::span(header)));
    gzip_.emplace([this](std::span<const std::byte> bytes) {
        data_.add(bytes);
        file_.write(bytes);
    });
}

void NrrdWriter::add(std::span<const std::byte> bytes) {
    added_ += bytes.size();
    gzip_->add(bytes);
}

void NrrdWriter::commit(const std::map<std::string, std::string>& key_values) {
    const std::uint64_t values = voxel_count(form_.grid) * static_cast<std::uint64_t>(form_.layers);
    if (added_ != form_.bytes_before_voxels + values * bytes_of(form_.voxel))
        throw std::logic_error("the bytes of a NRRD are not those that its header promises");
    form_.key_values = key_values;
    gzip_->finish();
    std::string header = header_of(form_);
    if (const auto digest = form_.key_values.find(file_digest_key); digest != form_.key_values.end()) {
        data_.add(std::as_bytes(std::span(header)));
        digest->second = data_.text();
        header = header_of(form_);
    }
    if (header.size() != header_bytes_) throw std::logic_error("a NRRD's header must not change its length");
    file_.rewind();
    file_.write(std::as_bytes(std::span(header)));
    file_.commit();
}

}  // namespace osteomill
