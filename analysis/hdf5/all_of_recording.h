// The layout of our own HDF5 files: every tick, state, event, distance and change of the bone that a
// recording holds, in its own units. docs/hdf5.md has the table.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/hdf5/hdf5_file.h"
#include "common/bone/bone.h"
#include "common/recording/playhead.h"

namespace osteomill {

class AllOfRecording {
  public:
    /// `playhead`: at the recording's first bone. `began_s`: since 1970, of its first packet.
    AllOfRecording(const std::filesystem::path& file, const Playhead& playhead, double began_s);
    /// Behind each state frame.
    void add(const Playhead& playhead);
    void close(const Playhead& playhead, bool is_complete);

  private:
    void begin(const Playhead& playhead, double began_s);
    void begin_tables();
    void write_tissues(const std::vector<Tissue>& tissues);
    void write_burrs(const std::vector<Burr>& burrs);
    void write_structures(const Playhead& playhead);
    void add_tick_columns(TickPart part);
    void add_ticks(const std::vector<TickSample>& ticks);
    void add_changes(const Playhead& playhead);

    Hdf5File file_;
    Hdf5Table<double> numbers_{file_};
    Hdf5Table<std::int64_t> whole_numbers_{file_};
    Hdf5Table<std::uint8_t> bytes_{file_};
    std::vector<std::string> faults_;
    std::vector<std::string> notices_;
    std::vector<std::string> actions_;
    std::vector<std::string> action_texts_;
    std::int64_t states_ = 0;
    bool has_torque_ = false;
    bool has_input_ = false;
};

// A bone in an HDF5 file, as arrays indexed [i, j, k]. Chunks are bricks; those without bone take no space.

/// Writes group/fraction, and group/stiffness and group/tissue if the bone has them, bytes as in the bone,
/// and the grid as attributes of the group. Throws as Hdf5File does.
void write_bone(Hdf5File& file, const std::string& group, const Bone& bone);

}  // namespace osteomill
