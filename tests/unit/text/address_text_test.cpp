#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/text/foreign_text.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(AddressText, HoldsAPassword) {
    for (const char* address :
         {"postgresql://ann:secret@host/lab", "postgresql://ann:sec/ret@host/lab",
          "postgresql://ann:sec@ret@host:5432/lab", "postgresql://:secret@/lab",
          "postgresql://ann@host/lab?password=secret", "postgresql://host/lab?user=ann&p%61ssword=secret",
          "host=host user=ann password=secret", "host=host password = 'secret two'",
          "postgresql://host/lab?sslpassword=secret", "POSTGRESQL://ann:secret@host"})
        EXPECT_TRUE(holds_password(address)) << address;
    for (const char* address :
         {"postgresql://ann@host/lab", "postgresql://host:5432/lab", "postgresql://ann@host:5432/lab",
          "postgresql://[::1]:5432/lab", "service=lab", "host=host user=ann passfile=/home/ann/.pgpass",
          "postgresql://host:5432/lab?application_name=ann@station", "postgresql:///lab"})
        EXPECT_FALSE(holds_password(address)) << address;
}

TEST(AddressText, IsPrintedWithoutPasswords) {
    EXPECT_EQ(without_passwords("postgresql://ann:secret@host/lab: no route"),
              "postgresql://ann:***@host/lab: no route");
    for (const char* line :
         {"'postgresql://ann:sec/secret@host/lab' was not expected", "postgresql://:secret@/lab: no",
          "cannot reach postgresql://ann:a@secret@host:5432/lab", "x?password=secret&y=1",
          "password = 'se secret' host=a", "host=a sslpassword=secret"}) {
        EXPECT_THAT(without_passwords(line), Not(HasSubstr("secret"))) << line;
        EXPECT_THAT(without_passwords(line), HasSubstr("***")) << line;
    }
    for (const char* line : {"postgresql://ann@host/lab", "a.csv:3: 4:5", "forgot the password"})
        EXPECT_EQ(without_passwords(line), line);
}

}  // namespace
}  // namespace osteomill
