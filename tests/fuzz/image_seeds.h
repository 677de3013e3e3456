// Seeds of the readers of image headers: sound files, and attacks.
#pragma once

#include <filesystem>

namespace osteomill::fuzz {

/// Writes nrrd_header/, meta_image_header/, nifti_header/ and dicom_header/ into the folder.
void write_image_seeds(const std::filesystem::path& folder);

}  // namespace osteomill::fuzz
