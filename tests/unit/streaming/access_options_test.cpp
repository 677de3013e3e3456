#include "haptic_server/streaming/access_options.h"

#include <gmock/gmock.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "common/program/command_options.h"
#include "common/text/words.h"

namespace osteomill {
namespace {

Access access(const std::string& command_line, const std::string& where) {
    CommandOptions app("", "", "");
    const AccessOptions options(app);
    const std::vector<std::string> words = words_of(command_line);
    std::vector<const char*> arguments{"program"};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    app.parse_or_text(static_cast<int>(arguments.size()), arguments.data());
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
