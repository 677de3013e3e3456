#include "imaging/bone_file/hu_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr const char* own_keys = "osteomill_";

std::optional<double> threshold_of(const std::filesystem::path& path,
                                   const std::map<std::string, std::string>& key_values) {
    const auto found = key_values.find(threshold_key);
    if (found == key_values.end()) return std::nullopt;
    char* end = nullptr;
    const double threshold_hu = std::strtod(found->second.c_str(), &end);
    if (found->second.empty() || *end != '\0' || !std::isfinite(threshold_hu))
        throw ImagingError(path, fmt::format("{}:={} is not a number of HU", threshold_key, found->second));
    return threshold_hu;
}

/// Of what the header means, not of how it is written.
Digest digest_of(const NrrdForm& form) {
    const Grid& grid = form.grid;
    std::string text = fmt::format("{} {} {}, {}, {} {} {}, {}\n", grid.size_voxels.x, grid.size_voxels.y,
                                   grid.size_voxels.z, grid.spacing_mm, grid.origin_mm.x, grid.origin_mm.y,
                                   grid.origin_mm.z, form.bytes_before_voxels);
    for (const auto& [key, value] : form.key_values)
        if (key.starts_with(own_keys) && key != header_digest_key)
            text += fmt::format("{}:={}\n", key, value);
    Digest digest;
    digest.add(std::as_bytes(std::span(text)));
    return digest;
}

}  // namespace

BoneFile::BoneFile(const std::filesystem::path& path) : file_(path, NrrdVoxel::int16) {
    require_digest(*this, header_digest_key, digest_of(form()), "header (sizes, spacing, origin, keys) is");
    threshold_hu_ = threshold_of(path, key_values());
}

const std::string& BoneFile::value(const char* key) const {
    const auto found = key_values().find(key);
    if (found == key_values().end())
        throw ImagingError(path(), fmt::format("key {} is missing, which a carved bone must have", key));
    return found->second;
}

void require_digest(const BoneFile& file, const char* key, const Digest& digest, const std::string& what) {
    const auto saved = file.key_values().find(key);
    if (saved == file.key_values().end() || saved->second == digest.text()) return;
    throw ImagingError(file.path(), fmt::format("its {} damaged: digest {}, not the {} that was saved (if "
                                                "changed on purpose, run bone_import on it)",
                                                what, digest.text(), saved->second));
}

HuReader::HuReader(const BoneFile& file) : HuReader(file, file.data()) {
    data_.skip(file.form().bytes_before_voxels);
}

HuReader::HuReader(const BoneFile& file, NrrdData data)
    : file_(file), data_(std::move(data)), left_(voxel_count(file.grid())) {}

void HuReader::read(std::span<std::int16_t> hu) {
    data_.read_voxels(hu);
    digest_.add(std::as_bytes(hu));
    left_ -= hu.size();
    if (left_ > 0) return;
    data_.finish();
    require_digest(file_, hu_digest_key, digest_, "CT numbers are");
}

void HuReader::read_to_end() {
    constexpr std::uint64_t voxels_at_once = 1u << 20;
    std::vector<std::int16_t> hu(static_cast<std::size_t>(std::min(left_, voxels_at_once)));
    while (left_ > 0) read(std::span(hu).first(static_cast<std::size_t>(std::min(left_, voxels_at_once))));
}

HuSlices slices_of(HuReader& reader, const BoneFile& file) {
    return {.grid = file.grid(),
            .labelled = false,
            .read = [&reader](std::span<std::int16_t> hu, std::span<std::uint8_t>) { reader.read(hu); }};
}

BoneFileWriter::BoneFileWriter(const std::filesystem::path& path, const Grid& grid,
                               std::map<std::string, std::string> key_values,
                               std::uint64_t bytes_before_voxels)
    : form_{.voxel = NrrdVoxel::int16,
            .grid = grid,
            .bytes_before_voxels = bytes_before_voxels,
            .key_values = std::move(key_values)} {
    // Known only at the end; until then there is as much room for them.
    form_.key_values[hu_digest_key] = std::string(Digest::text_length, '0');
    form_.key_values[header_digest_key] = std::string(Digest::text_length, '0');
    writer_.emplace(path, form_);
}

void BoneFileWriter::add(std::span<const std::int16_t> hu) {
    hu_digest_.add(std::as_bytes(hu));
    writer_->add(std::as_bytes(hu));
}

void BoneFileWriter::commit() {
    form_.key_values[hu_digest_key] = hu_digest_.text();
    form_.key_values[header_digest_key] = digest_of(form_).text();
    writer_->commit(form_.key_values);
}

std::string threshold_text(double threshold_hu) {
    return fmt::format("{}", threshold_hu);
}

}  // namespace osteomill
