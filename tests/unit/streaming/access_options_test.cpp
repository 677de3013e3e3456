#include "haptic_server/streaming/access_options.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <stdexcept>

namespace osteomill {
namespace {

Access access(const std::string& command_line, const std::string& where) {
    CLI::App app;
    const AccessOptions options(app);
    app.parse(command_line, false);
    return options.access_to(parse_listen_address(where));
}

TEST(AccessOptions, LetOtherMachinesInOnlyWithTlsOrWhenToldSo) {
    const std::string tls = "--tls-cert a.pem --tls-key a.key --tls-ca ca.pem";
    EXPECT_THAT([] { access("", "0.0.0.0:7010"); },
                ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr("--insecure-network")));
    EXPECT_TRUE(access(tls, "0.0.0.0:7010").tls);
    EXPECT_TRUE(access("--insecure-network", "[::]:7010").insecure_network);
    EXPECT_FALSE(access("", "127.0.0.1:7010").tls);
    EXPECT_TRUE(access(tls, "[::1]:7010").tls);
}

}  // namespace
}  // namespace osteomill
