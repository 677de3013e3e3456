#include "studies/bridge/private_network.h"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace osteomill::study {

namespace {

bool succeeds(const std::string& command) {
    return std::system((command + " > /dev/null 2>&1").c_str()) == 0;
}

void run(const std::string& command) {
    if (!succeeds(command)) throw std::runtime_error("failed: " + command);
}

std::string unique_name(const std::string& of_what) {
    static std::atomic<int> made{0};
    return "osteomill-" + of_what + "-" + std::to_string(::getpid()) + "-" + std::to_string(made++);
}

}  // namespace

std::string PrivateNetwork::why_not() {
    if (::geteuid() != 0) return "only root may make network namespaces";
    for (const std::string program : {"ip", "tc"})
        if (!succeeds("command -v " + program)) return program + " is not installed (iproute2)";
    try {
        PrivateNetwork().limit_rate("1mbit");
    } catch (const std::exception& error) {
        return std::string("network namespaces or tc tbf cannot be had here: ") + error.what();
    }
    return "";
}

PrivateNetwork::Namespace::Namespace(const std::string& of_what) : name_(unique_name(of_what)) {
    try {
        run("ip netns add " + name_);
    } catch (const std::runtime_error&) {
        // If it may not be mounted, its place exists already.
        succeeds("ip netns del " + name_);
        throw;
    }
}

PrivateNetwork::Namespace::~Namespace() {
    succeeds("ip netns del " + name_);
}

PrivateNetwork::PrivateNetwork() : server_("server"), client_("client") {
    run("ip -n " + server() + " link add cable type veth peer name cable netns " + client());
    run("ip -n " + server() + " addr add " + server_address + "/30 dev cable");
    run("ip -n " + client() + " addr add 10.213.77.2/30 dev cable");
    for (const std::string& end : {server(), client()}) {
        run("ip -n " + end + " link set lo up");
        run("ip -n " + end + " link set cable up");
    }
}

void PrivateNetwork::limit_rate(const std::string& rate) {
    for (const std::string& end : {server(), client()})
        run("tc -n " + end + " qdisc replace dev cable root tbf rate " + rate + " burst 4kb latency 400ms");
}

void PrivateNetwork::pull_cable() {
    run("ip -n " + client() + " link set cable down");
}

void PrivateNetwork::plug_cable() {
    run("ip -n " + client() + " link set cable up");
}

PrivateNetwork::Stay::Stay(const std::string& name_of_namespace)
    : home_(::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC)) {
    const int there = ::open(("/var/run/netns/" + name_of_namespace).c_str(), O_RDONLY | O_CLOEXEC);
    const bool is_there = home_ >= 0 && there >= 0 && ::setns(there, CLONE_NEWNET) == 0;
    const int reason = errno;
    if (there >= 0) ::close(there);
    if (is_there) return;
    if (home_ >= 0) ::close(home_);
    throw std::system_error(reason, std::generic_category(), "cannot enter " + name_of_namespace);
}

PrivateNetwork::Stay::~Stay() {
    if (::setns(home_, CLONE_NEWNET) != 0) std::abort();  // whatever comes next would be elsewhere
    ::close(home_);
}

}  // namespace osteomill::study
