// Check of the name under which a visitor asked for a page (the field Host of HTTP). A page of this machine
// that answered to any name could be read by an untrusted web page whose name was rebound to 127.0.0.1.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace osteomill {

/// Whether a page of this machine is meant: `host` (with or without a port) is an address, "localhost" or a
/// name under it, or one of `others`; upper and lower case are the same. No name, as of a visitor that is no
/// browser, is right too.
bool is_own_host(std::string_view host, std::span<const std::string> others);

}  // namespace osteomill
