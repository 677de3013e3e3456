// The layout of FIVRS's recordings (Munawar et al., volumetric_drilling), old and v3, for the analysis
// programs that were written for them. docs/hdf5.md lists the differences from theirs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <unordered_map>
#include <vector>

#include "analysis/hdf5/hdf5_file.h"
#include "common/recording/playhead.h"

namespace osteomill {

class FivrsRecording {
  public:
    /// `playhead`: at the recording's first bone. `began_s`: since 1970, of its first packet. `with_v3`: also
    /// writes fivrs_v3_file(file).
    FivrsRecording(const std::filesystem::path& file, const Playhead& playhead, double began_s, bool with_v3);
    /// Behind each state frame.
    void add(const Playhead& playhead);
    void close(const Playhead& playhead, bool is_complete);

  private:
    void write_metadata(const Grid& grid);
    void begin_v3();
    void add_row(const Playhead& playhead);
    void add_force(double time_s, const glm::dvec3& force_n, const std::optional<glm::dvec3>& torque_n_mm,
                   const ToolPose& burr);
    void note_removed(const Playhead& playhead);
    void write_removed(const std::vector<Tissue>& tissues);

    Hdf5File file_;
    std::optional<Hdf5File> v3_;
    Hdf5Table<double> numbers_{file_};
    std::optional<Hdf5Table<double>> poses_;  // for v3
    const double began_s_;
    const Bone at_start_;
    std::vector<double> row_times_s_;
    std::optional<std::size_t> burr_;
    double last_force_s_ = 0.0;
    /// Voxels that are removed now, by their number (i fastest), and the row in which they became so.
    std::unordered_map<std::uint64_t, std::size_t> removed_;
};

}  // namespace osteomill
