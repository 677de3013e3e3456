#include "tests/support/slurm_cluster.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/support/eventually.h"

namespace osteomill::testing {

namespace {

constexpr std::array programs{"/usr/sbin/munged", "/usr/sbin/mungekey", "/usr/sbin/slurmctld",
                              "/usr/sbin/slurmd", "/usr/bin/sbatch",    "/usr/bin/squeue",
                              "/usr/bin/scancel", "/usr/bin/sinfo"};

/// Two ports that nobody listens at now.
std::array<int, 2> free_ports() {
    std::array<int, 2> sockets{};
    std::array<int, 2> ports{};
    for (std::size_t i = 0; i < sockets.size(); ++i) {
        sockets[i] = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        auto* const at = reinterpret_cast<sockaddr*>(&address);
        if (::bind(sockets[i], at, size) != 0 || ::getsockname(sockets[i], at, &size) != 0)
            throw std::runtime_error("no free port");
        ports[i] = ntohs(address.sin_port);
    }
    for (const int socket : sockets) ::close(socket);
    return ports;
}

std::string configuration(const std::filesystem::path& folder) {
    std::array<char, 256> name{};
    ::gethostname(name.data(), name.size() - 1);
    const std::string host = std::string(name.data()).substr(0, std::string(name.data()).find('.'));
    const auto [controller_port, node_port] = free_ports();
    return fmt::format(
        "ClusterName=test\nSlurmctldHost={0}(127.0.0.1)\nSlurmctldPort={2}\nSlurmdPort={3}\n"
        "SlurmUser=root\nSlurmdUser=root\nAuthType=auth/munge\nAuthInfo=socket={1}/munge.socket\n"
        "CredType=cred/munge\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\n"
        "SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=1\n"
        "SelectType=select/cons_tres\nSelectTypeParameters=CR_CPU\nMpiDefault=none\nSwitchType=switch/none\n"
        "JobAcctGatherType=jobacct_gather/none\nAccountingStorageType=accounting_storage/none\n"
        "ReturnToService=2\nSlurmdParameters=config_overrides\nKillWait=1\n"
        "StateSaveLocation={1}/state\nSlurmdSpoolDir={1}/spool\n"
        "SlurmctldPidFile={1}/slurmctld.pid\nSlurmdPidFile={1}/slurmd.pid\n"
        "SlurmctldLogFile={1}/slurmctld.log\nSlurmdLogFile={1}/slurmd.log\n"
        "NodeName={0} NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN\n"
        "PartitionName=all Nodes={0} Default=YES State=UP\n",
        host, folder.string(), controller_port, node_port);
}

}  // namespace

std::string SlurmCluster::why_not() {
    for (const char* const program : programs)
        if (!std::filesystem::exists(program))
            return std::string(program) +
                   " is not installed (packages munge, slurmctld, slurmd, slurm-client)";
    return ::geteuid() == 0 ? "" : "Slurm's daemons start tasks as others: this test runs as root";
}

SlurmCluster::SlurmCluster(std::filesystem::path folder) : folder_(std::move(folder)) {
    for (const char* const name : {"state", "spool"}) std::filesystem::create_directories(folder_ / name);
    std::ofstream(folder_ / "slurm.conf") << configuration(folder_);
    const std::string at = folder_.string();
    run_program({"/usr/sbin/mungekey", "--create", "--keyfile", at + "/munge.key"});
    const auto start = [&](const std::string& program, const std::string& options) {
        // Their own words go to files: nobody reads them here.
        daemons_.push_back(std::make_unique<ChildProcess>(
            std::vector<std::string>{"/bin/sh", "-c",
                                     fmt::format("SLURM_CONF={0}/slurm.conf exec {1} {2} >>{0}/said.log 2>&1",
                                                 at, program, options)}));
    };
    start("/usr/sbin/munged",
          fmt::format("--foreground --force --key-file {0}/munge.key --socket {0}/munge.socket --pid-file "
                      "{0}/munged.pid --seed-file {0}/munged.seed --log-file {0}/munged.log",
                      at));
    start("/usr/sbin/slurmctld", "-D");
    start("/usr/sbin/slurmd", "-D");
    if (!eventually([&] { return run({"/usr/bin/sinfo", "-h", "-o", "%T"}).out == "idle\n"; }))
        throw std::runtime_error("Slurm's node does not take work; see " + at);
}

SlurmCluster::~SlurmCluster() {
    run({"/usr/bin/scancel", "--user=root"});
    eventually([&] { return run({"/usr/bin/squeue", "-h"}).out.empty(); });
    for (auto daemon = daemons_.rbegin(); daemon != daemons_.rend(); ++daemon) {
        (*daemon)->send_signal(SIGTERM);
        (*daemon)->wait();
    }
}

Finished SlurmCluster::run(const std::vector<std::string>& command) const {
    std::vector<std::string> all{"/usr/bin/env", "SLURM_CONF=" + (folder_ / "slurm.conf").string()};
    all.insert(all.end(), command.begin(), command.end());
    return run_program(all);
}

std::string SlurmCluster::submit(const std::vector<std::string>& variables,
                                 const std::vector<std::string>& words) const {
    std::vector<std::string> command = variables;
    command.insert(command.end(), {"/usr/bin/sbatch", "--parsable"});
    command.insert(command.end(), words.begin(), words.end());
    const Finished finished = run(command);
    if (finished.status != 0) throw std::runtime_error(finished.err);
    return finished.out.substr(0, finished.out.find('\n'));
}

std::vector<std::string> SlurmCluster::tasks(const std::string& job) const {
    std::istringstream lines(run({"/usr/bin/squeue", "-h", "-r", "-o", "%i", "--jobs=" + job}).out);
    std::vector<std::string> found;
    for (std::string line; std::getline(lines, line);) found.push_back(line);
    return found;
}

void SlurmCluster::cancel(const std::string& task) const {
    run({"/usr/bin/scancel", task});
}

}  // namespace osteomill::testing
