#include "common/net/tls_options.h"

#include <gmock/gmock.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "common/program/command_options.h"
#include "common/text/words.h"

namespace osteomill {
namespace {

std::optional<TlsFiles> parse(const std::string& command_line) {
    CommandOptions app("", "", "");
    const TlsOptions options(app);
    const std::vector<std::string> words = words_of(command_line);
    std::vector<const char*> arguments{"program"};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    app.parse_or_text(static_cast<int>(arguments.size()), arguments.data());
    return options.files();
}

TEST(TlsOptions, AreAllThreeOrNone) {
    EXPECT_FALSE(parse(""));
    const auto files = parse("--tls-cert a.pem --tls-key a.key --tls-ca ca.pem");
    ASSERT_TRUE(files);
    EXPECT_EQ(files->certificate, "a.pem");
    EXPECT_EQ(files->key, "a.key");
    EXPECT_EQ(files->ca, "ca.pem");
    EXPECT_EQ(files->crl, "");
    EXPECT_EQ(parse("--tls-cert a.pem --tls-key a.key --tls-ca ca.pem --tls-crl crl.pem")->crl, "crl.pem");
    for (const auto& [line, missing] :
         {std::pair("--tls-cert a.pem --tls-key a.key", "--tls-ca: is missing"),
          std::pair("--tls-cert a.pem --tls-ca ca.pem", "--tls-key: is missing"),
          std::pair("--tls-crl crl.pem", "--tls-cert: is missing"),
          std::pair("--tls-key a.key --tls-ca ca.pem", "--tls-cert: is missing")}) {
        EXPECT_THAT([line = line] { parse(line); },
                    ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr(missing)));
    }
}

}  // namespace
}  // namespace osteomill
