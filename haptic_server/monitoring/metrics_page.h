// A web page of one text, at /metrics of an address that only this machine reaches: for Prometheus, or curl.
//
// On a thread of its own; one visitor at a time, for two seconds at most.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/net/listen_address.h"

namespace osteomill {

class MetricsPage {
  public:
    /// Listens. `text` is called on the page's thread, at each visit, until the page is destroyed. Throws
    /// std::runtime_error, in one line, if the address cannot be had.
    MetricsPage(const ListenAddress& where, std::function<std::string()> text);
    ~MetricsPage();
    MetricsPage(const MetricsPage&) = delete;
    MetricsPage& operator=(const MetricsPage&) = delete;

    std::uint16_t port() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace osteomill
