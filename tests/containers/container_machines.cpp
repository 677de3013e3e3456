#include <unistd.h>

#include <stdexcept>

#include "common/program/commit.h"
#include "tests/containers/two_machines.h"
#include "tests/support/child_process.h"

namespace osteomill::testing {

namespace {

using namespace std::chrono_literals;

/// The outcome of a command that is found in the PATH.
Finished outcome_of(Command command, std::chrono::seconds deadline = far_too_long) {
    command.insert(command.begin(), "/usr/bin/env");
    return run_program(command, deadline);
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}
std::string last_line(std::string text) {
    while (text.ends_with('\n')) text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

std::string run_or_throw(const Command& command, std::chrono::seconds deadline = far_too_long) {
    const Finished run = outcome_of(command, deadline);
    if (run.status != 0) throw std::runtime_error(command[0] + " " + command[1] + ": " + last_line(run.err));
    return run.out;
}

class Containers final : public TwoMachines {
  public:
    Containers(std::string version, std::filesystem::path folder)
        : version_(std::move(version)), folder_(std::move(folder)) {
        // Addresses of its own: with those of an engine's choice a container may come back under another one.
        run_or_throw({"docker", "network", "create", "--internal", "--subnet", "10.213.78.0/24", name_});
    }
    ~Containers() override {
        outcome_of({"docker", "rm", "--force", name_of(Machine::server), name_of(Machine::viewer),
                    name_of(Machine::beside_server)});
        outcome_of({"docker", "network", "rm", name_});
    }

    std::string kind() const override { return "containers of Docker " + version_; }
    std::string folder() const override { return "/out"; }
    std::string viewer_address() const override { return address_of_viewer; }
    std::string server_for(Machine where) const override {
        return where == Machine::viewer ? address_of_server : "127.0.0.1";
    }
    Command run(Machine where, const std::string& program, const Command& arguments) const override {
        Command command{"/usr/bin/env", "docker",       "run",      "--rm",
                        "--name",       name_of(where), "--volume", folder_.string() + ":/out"};
        // The options of docker/compose.yaml.
        append(command, {"--cap-drop", "ALL", "--security-opt", "no-new-privileges", "--read-only", "--tmpfs",
                         "/tmp"});
        if (where == Machine::beside_server)
            append(command, {"--network", "container:" + name_of(Machine::server)});
        else
            append(command, {"--network", name_, "--ip",
                             where == Machine::server ? address_of_server : address_of_viewer});
        if (program == "haptic_server")
            append(command, {"osteomill-server"});
        else if (program == "packet_replay")
            append(command, {"--entrypoint", program, "osteomill-server"});
        else
            append(command, {"osteomill-client"});
        append(command, arguments);
        return command;
    }
    void pull_cable() override {
        run_or_throw({"docker", "network", "disconnect", name_, name_of(Machine::viewer)});
    }
    void plug_cable() override {
        run_or_throw(
            {"docker", "network", "connect", "--ip", address_of_viewer, name_, name_of(Machine::viewer)});
    }

  private:
    static constexpr const char* address_of_server = "10.213.78.2";
    static constexpr const char* address_of_viewer = "10.213.78.3";

    static void append(Command& command, const Command& more) {
        command.insert(command.end(), more.begin(), more.end());
    }
    std::string name_of(Machine machine) const {
        switch (machine) {
            case Machine::server:
                return name_ + "-server";
            case Machine::viewer:
                return name_ + "-viewer";
            case Machine::beside_server:
                break;
        }
        return name_ + "-beside";
    }

    std::string version_;
    std::filesystem::path folder_;
    std::string name_ = "osteomill-test-" + std::to_string(::getpid());
};

}  // namespace

std::unique_ptr<TwoMachines> make_containers(const std::filesystem::path& folder) {
    const Finished version = outcome_of({"docker", "version", "--format", "{{.Server.Version}}"});
    if (version.status != 0) throw std::runtime_error("no Docker runs: " + last_line(version.err));
    for (const char* const image : {"osteomill-server", "osteomill-client"}) {
        const std::string commit = first_line(
            run_or_throw({"docker", "image", "inspect", "--format",
                          "{{index .Config.Labels \"org.opencontainers.image.revision\"}}", image}));
        if (!commit.starts_with(built_from_commit()))
            throw std::runtime_error(
                std::string(image) + " is of commit " + commit +
                "; scripts/package.sh and docker/build_images.sh make one of this commit");
    }
    return std::make_unique<Containers>(first_line(version.out), folder);
}

}  // namespace osteomill::testing
