#include <stdexcept>

#include "studies/bridge/private_network.h"
#include "tests/containers/two_machines.h"

namespace osteomill::testing {

namespace {

class Namespaces final : public TwoMachines {
  public:
    Namespaces(std::filesystem::path folder, std::filesystem::path programs)
        : folder_(std::move(folder)), programs_(std::move(programs)) {}

    std::string kind() const override { return "network namespaces"; }
    std::string folder() const override { return folder_.string(); }
    std::string viewer_address() const override { return "10.213.77.2"; }
    std::string server_for(Machine where) const override {
        return where == Machine::viewer ? study::PrivateNetwork::server_address : "127.0.0.1";
    }
    Command run(Machine where, const std::string& program, const Command& arguments) const override {
        const std::string& machine = where == Machine::viewer ? network_.client() : network_.server();
        Command command{"/usr/bin/env", "ip", "netns", "exec", machine, (programs_ / program).string()};
        command.insert(command.end(), arguments.begin(), arguments.end());
        return command;
    }
    void pull_cable() override { network_.pull_cable(); }
    void plug_cable() override { network_.plug_cable(); }

  private:
    std::filesystem::path folder_;
    std::filesystem::path programs_;
    study::PrivateNetwork network_;
};

}  // namespace

FoundMachines find_machines(const std::filesystem::path& folder, const std::filesystem::path& programs) {
    FoundMachines found;
    try {
        found.machines = make_containers(folder);
        return found;
    } catch (const std::runtime_error& error) {
        found.why_no_containers = error.what();
    }
    found.why_none = study::PrivateNetwork::why_not();
    if (found.why_none.empty()) found.machines = std::make_unique<Namespaces>(folder, programs);
    return found;
}

}  // namespace osteomill::testing
