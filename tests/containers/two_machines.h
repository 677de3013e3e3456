// Two machines on a private network whose cable can be pulled: two containers or, if no engine runs, two
// network namespaces.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace osteomill::testing {

using Command = std::vector<std::string>;

/// The machine on which a program runs.
enum class Machine {
    server,
    viewer,        ///< at the other end of the cable
    beside_server  ///< on the server's machine: no cable between them
};

class TwoMachines {
  public:
    virtual ~TwoMachines() = default;

    /// A description of the machines, for people.
    virtual std::string kind() const = 0;
    /// The command that runs `program` (a file name) with `arguments` on a machine.
    virtual Command run(Machine where, const std::string& program, const Command& arguments) const = 0;
    /// The host of the server, as a program on that machine knows it.
    virtual std::string server_for(Machine where) const = 0;
    /// The address of the viewer's machine, as the server sees it.
    virtual std::string viewer_address() const = 0;
    /// The folder that was given, as programs on the machines know it.
    virtual std::string folder() const = 0;
    virtual void pull_cable() = 0;
    virtual void plug_cable() = 0;
};

struct FoundMachines {
    std::unique_ptr<TwoMachines> machines;  ///< null if there can be none
    std::string why_no_containers;          ///< empty if they are containers
    std::string why_none;                   ///< empty if there are machines
};

/// `folder` is for files that go in and out; any user must be able to write there. `programs`: the folder in
/// which namespaces find them.
FoundMachines find_machines(const std::filesystem::path& folder, const std::filesystem::path& programs);

/// Two containers of the images that docker/build_images.sh makes of this commit's packages; throws
/// std::runtime_error with one line if there can be none.
std::unique_ptr<TwoMachines> make_containers(const std::filesystem::path& folder);

}  // namespace osteomill::testing
