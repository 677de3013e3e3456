#include "haptic_server/streaming/operator_list.h"

#include <gmock/gmock.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

class OperatorListTest : public ::testing::Test {
  protected:
    OperatorList list(const std::string& text) const {
        std::ofstream(folder_ / "operators") << text;
        return OperatorList(folder_ / "operators");
    }
    std::string failure_of(const std::string& text) const {
        return testing::message_of<std::runtime_error>([&] { list(text); });
    }

    testing::TemporaryFolder folder_;
};

TEST_F(OperatorListTest, NamesWholeSubjectsAndNothingElse) {
    const OperatorList operators =
        list("# of the lab\n\n  CN=surgeon\t\r\nCN=O\\,Neill,OU=Ear and nose,O=Lab\n2.5.4.3=x+CN=y");
    EXPECT_TRUE(operators.names("CN=surgeon"));
    EXPECT_TRUE(operators.names("CN=O\\,Neill,OU=Ear and nose,O=Lab"));
    EXPECT_TRUE(operators.names("2.5.4.3=x+CN=y"));
    for (const char* other :
         {"", "CN=surgeo", "CN=surgeon2", "surgeon", "CN=Surgeon", "CN=surgeon,O=Lab", "# of the lab"})
        EXPECT_FALSE(operators.names(other)) << other;
}

TEST_F(OperatorListTest, IsRefusedWithTheLineThatIsNoSubject) {
    for (const char* wrong : {"surgeon", "CN = surgeon", "CN=surgeon, O=Lab", "CN=", "=x", "CN=a,",
                              "CN=a b ,", "CN=\x01", "CN=\xc3\xa9", "CN=a;O=b", "/CN=a"})
        EXPECT_THAT(failure_of(std::string("CN=first\n") + wrong + "\n"), HasSubstr("operators:2: "))
            << wrong;
    EXPECT_THAT(failure_of("surgeon"), HasSubstr("'surgeon' is no subject of a certificate"));
    EXPECT_THAT(failure_of("CN=" + std::string(2000, 'a')), HasSubstr("operators:1: "));
}

TEST_F(OperatorListTest, IsRefusedWhereItCannotBeReadOrNamesNobody) {
    EXPECT_THAT(failure_of("# nobody\n"), HasSubstr("names nobody"));
    EXPECT_THAT(failure_of(std::string(1'100'000, '#')), HasSubstr("more than the 1048576"));
    EXPECT_THROW(OperatorList{folder_.path()}, std::runtime_error);
    EXPECT_THROW(OperatorList{"/nowhere/operators"}, std::runtime_error);
}

}  // namespace
}  // namespace osteomill
