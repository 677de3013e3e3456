// A web page of one text, at /metrics of an address that only this machine reaches: for Prometheus, or curl.
//
// On a thread of its own; one visitor at a time, for two seconds at most. Who asks for it by a name that is
// not this machine's is refused (host_name.h).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/net/listen_address.h"

namespace osteomill {

class MetricsServer {
  public:
    /// Listens. `text` is called on the page's thread, at each visit, until the page is destroyed. `names`:
    /// by which it may be asked for, beside localhost and addresses. Throws std::runtime_error, in one line,
    /// if the address cannot be had.
    MetricsServer(const ListenAddress& where, std::function<std::string()> text,
                  std::vector<std::string> names = {});
    ~MetricsServer();
    MetricsServer(const MetricsServer&) = delete;
    MetricsServer& operator=(const MetricsServer&) = delete;

    std::uint16_t port() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace osteomill
