#include <gtest/gtest.h>

#include <string>

#include "common/wire/frame.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {
namespace {

bool parses(const std::string& bytes) {
    v2::Goodbye message;
    return parse_message({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, message);
}

TEST(ParseMessage, RefusesTextThatIsNoUtf8AndLeavesItToTheCallerToSaySo) {
    ::testing::internal::CaptureStderr();
    EXPECT_TRUE(parses("\x0a\x02ok"));
    EXPECT_FALSE(parses("\x0a\x02\xff\xfe"));
    EXPECT_FALSE(
        parses("\x0a\x05short"
               "\x0a"));
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace osteomill
