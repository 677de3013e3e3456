// Two network namespaces joined by a cable: a server's and a client's machine on one. Needs root, ip and tc.
#pragma once

#include <string>

namespace osteomill::study {

class PrivateNetwork {
  public:
    static constexpr const char* server_address = "10.213.77.1";

    /// Why there can be none on this machine; empty if there can.
    static std::string why_not();

    /// Throws std::runtime_error with the command that failed.
    PrivateNetwork();

    /// Both ways, such as "64kbit": a token bucket (tc tbf).
    void limit_rate(const std::string& rate);
    void pull_cable();
    void plug_cable();

    /// While it lives, sockets that this thread makes, and threads and programs that it starts, are there.
    class Stay {
      public:
        explicit Stay(const std::string& name_of_namespace);
        ~Stay();
        Stay(const Stay&) = delete;
        Stay& operator=(const Stay&) = delete;

      private:
        int home_;
    };
    const std::string& server() const { return server_.name(); }
    const std::string& client() const { return client_.name(); }

  private:
    /// Is gone with this, also if what comes after cannot be had.
    class Namespace {
      public:
        explicit Namespace(const std::string& of_what);
        ~Namespace();
        Namespace(const Namespace&) = delete;
        Namespace& operator=(const Namespace&) = delete;
        const std::string& name() const { return name_; }

      private:
        std::string name_;
    };

    Namespace server_;
    Namespace client_;
};

}  // namespace osteomill::study
