#include "devices/hid/device_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/fake_hid.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(DeviceList, SaysWhatCanBeUsedAndWhatCannot) {
    testing::FakeHid hid;
    EXPECT_THAT(device_list(hid), HasSubstr("no haptic arm"));
    hid.plug({.info = {"/dev/hidraw3", 0x1234, 0x0006, 0xFFAB, 0x0200, "mbed arm"}});
    hid.plug({.info = {"/dev/hidraw4", 0x1234, 0x0006, 0xFFAB, 0x0200, "another"}, .is_permitted = false});
    hid.plug({.info = {"/dev/hidraw5", 0x1234, 0x0006, 0x0001, 0x0006, "a keyboard"}});
    hid.plug({.info = {"/dev/hidraw6", 0x256F, 0xC635, 0x0001, 0x0008, "SpaceMouse Compact"}});
    EXPECT_THAT(device_list(hid), HasSubstr("256f:c635 SpaceMouse Compact\n    3D mouse"));
    EXPECT_THAT(device_list(hid),
                AllOf(HasSubstr("1234:0006 mbed arm"), HasSubstr("/dev/hidraw3: ready"),
                      HasSubstr("woodenhaptics_v2015|polhem_v1"), HasSubstr("/dev/hidraw4: no permission"),
                      Not(HasSubstr("keyboard"))));
}

}  // namespace
}  // namespace osteomill
