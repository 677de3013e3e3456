// Options of haptic_server for the device that moves the tool.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/files/distinct_files.h"
#include "haptic_server/session/device_table.h"

namespace CLI {
class App;
}

namespace osteomill {

struct DeviceChoice {
    const DeviceEntry* entry = &devices().front();
    PrepareDevice prepare = entry->checked(TypedOptions());
    std::vector<NamedFile> files_read{};  ///< by the typed option
    bool lists_devices = false;           ///< and does nothing else
};

class DeviceOptions {
  public:
    /// Adds the options. Outlives the parsing.
    void declare(CLI::App& app);
    /// After parsing. Throws std::invalid_argument with one line for options that do not go together.
    DeviceChoice checked() const;

  private:
    std::string device_ = devices().front().name;
    std::map<std::string, std::string> texts_;  // by flag; empty: not typed
    bool lists_devices_ = false;
};

}  // namespace osteomill
