#include "render_client/ui/view/transfer_file.h"

#include <gmock/gmock.h>

#include <fstream>

#include "common/scene/scene_file.h"
#include "common/scene/stiffness_relation.h"
#include "render_client/ui/view/hu_axis.h"

namespace osteomill::transfer_file_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(LookFile, ReadsBackWhatItWrote) {
    for (const TransferFunction& preset : transfer_presets()) {
        TransferFunction look = preset;
        look.name += " \"of\" 'mine'";
        look.points.front().opacity = 1.0 / 3.0;
        EXPECT_EQ(parse_look(look_text(look), "look"), look);
    }
    EXPECT_EQ(parse_look(look_text(std::nullopt), "look"), std::nullopt);
}

TEST(LookFile, RefusesInOneLineThatNamesFileAndKey) {
    const std::string head = "name = 'a'\nmode = 'surface'\n";
    const std::vector<std::pair<std::string, std::string>> cases{
        {"", "mode"},
        {"mode = 'glass'", "translucent"},
        {"mode = 'surface'\npoints = []", "name"},
        {head, "points"},
        {head + "points = []", "no control point"},
        {head + "points = [[1, 2, 3]]", "5"},
        {head + "points = [[9, 0, 0, 0, 1]]", "must be 0 to 5.1"},
        {head + "points = [[nan, 0, 0, 0, 1]]", "points"},
        {head + "points = [[1, 256, 0, 0, 1]]", "0 to 255"},
        {head + "points = [[1, 0.5, 0, 0, 1]]", "whole numbers"},
        {head + "points = [[1, 0, 0, 0, 1.5]]", "must be 0 to 1"},
        {head + "points = [[1, 0, 0, 0, 1], [1, 0, 0, 0, 1]]", "above"},
        {head + "colour = 3\npoints = [[1, 0, 0, 0, 1]]", "colour"},
        {"mode = ", "not TOML"},
    };
    for (const auto& [text, expected] : cases) try {
            parse_look(text, "my/look.toml");
            ADD_FAILURE() << text;
        } catch (const SceneError& error) {
            EXPECT_THAT(error.what(),
                        AllOf(HasSubstr("my/look.toml"), HasSubstr(expected), Not(HasSubstr("\n"))))
                << text;
        }
    // Torn anywhere, it is refused or it is whole.
    const std::string whole = look_text(transfer_presets()[0]);
    for (std::size_t length = 0; length + 2 < whole.size(); ++length)
        EXPECT_THROW(parse_look(whole.substr(0, length), "torn"), SceneError) << length;
}

TEST(LookFile, IsKeptWithTheCaseAndNotWrittenOverWhereItIsBad) {
    const auto folder = std::filesystem::path(::testing::TempDir()) / "transfer_file_test";
    std::filesystem::remove_all(folder);
    const auto file = folder / "case" / "look.toml";
    TransferFile keeper({}, std::nullopt);
    EXPECT_FALSE(keeper.has_file());
    const auto first = keeper.open(file);
    ASSERT_TRUE(first);
    EXPECT_EQ(*first, std::nullopt);
    EXPECT_FALSE(keeper.open(file)) << "it is open already";
    EXPECT_THAT(keeper.save(transfer_presets()[1]), HasSubstr(file.string()));
    TransferFile next({}, std::nullopt);
    const auto again = next.open(file);
    ASSERT_TRUE(again);
    EXPECT_EQ(*again, transfer_presets()[1]);
    std::ofstream(file) << "mode = 7\n";
    TransferFile bad({}, std::nullopt);
    EXPECT_THROW(bad.open(file), SceneError);
    EXPECT_THAT(bad.save(std::nullopt), HasSubstr("not saved"));
    TransferFile users(folder / "mine.toml", std::nullopt);
    EXPECT_FALSE(users.open(file)) << "the user's goes before the case's";
    std::filesystem::remove_all(folder);
}

TEST(HuAxis, GoesThereAndBack) {
    const StiffnessRelation relation = default_stiffness_relation();
    for (double hu = 400.0; hu <= 3000.0; hu += 37.0) {
        EXPECT_EQ(stiffness_at_hu(hu), relative_stiffness(relation, hu));
        EXPECT_NEAR(hu_at_stiffness(stiffness_at_hu(hu)), hu, 1e-6);
    }
    EXPECT_NEAR(hu_at_stiffness(1.0), reference_bone_hu, 1e-9);
    EXPECT_EQ(hu_at_stiffness(0.0), 0.0);
    EXPECT_EQ(hu_at_stiffness(100.0), 4000.0);
}

}  // namespace
}  // namespace osteomill::transfer_file_test
