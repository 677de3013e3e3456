// The command line of osteomill_slicer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/net/listen_address.h"
#include "common/net/tls_files.h"
#include "common/program/command_line.h"

namespace osteomill {

struct SlicerOptions {
    ServerAddress server{};
    std::optional<TlsFiles> tls{};  ///< nothing: in the clear
    std::uint16_t port = 18944;     ///< on loopback, for 3D Slicer; 0: a free one
};

/// Throws std::invalid_argument with one line for wrong usage.
ParseResult<SlicerOptions> parse_slicer_command_line(int argc, const char* const* argv,
                                                     const std::string& version);

}  // namespace osteomill
