#include "imaging/bone_file/hu_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <utility>
#include <vector>

#include "imaging/imaging_error.h"
#include "tests/support/dense_bone_file.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using testing::read_bone_file;
using testing::write_bone_file;

HuVolume small_volume() {
    HuVolume volume{.grid = {.size_voxels = {5, 4, 3}, .spacing_mm = 0.1, .origin_mm = {-12.35, 7.1, 100.0}},
                    .hu = {},
                    .tissue = {}};
    for (int i = 0; i < 60; ++i) volume.hu.push_back(static_cast<std::int16_t>(37 * i - 1000));
    return volume;
}

std::string refusal(const std::filesystem::path& path) {
    return testing::message_of<ImagingError>([&] { read_bone_file(path); });
}

TEST(HuFile, GivesBackWhatWasWritten) {
    const testing::TemporaryFolder folder;
    const HuVolume volume = small_volume();
    write_bone_file(folder / "bone.nrrd", volume, {{threshold_key, threshold_text(412.5)}, {"note", "kept"}});
    const testing::DenseBoneFile file = read_bone_file(folder / "bone.nrrd");
    EXPECT_EQ(file.volume.grid, volume.grid);
    EXPECT_EQ(file.volume.hu, volume.hu);
    EXPECT_EQ(file.threshold_hu, 412.5);
    EXPECT_EQ(file.key_values.at("note"), "kept");
}

TEST(HuFile, StatesPatientSpaceForOtherPrograms) {
    const testing::TemporaryFolder folder;
    write_bone_file(folder / "bone.nrrd", small_volume());
    std::ifstream file(folder / "bone.nrrd", std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    EXPECT_THAT(text, HasSubstr("space: left-posterior-superior\n"));
    EXPECT_THAT(text, HasSubstr("encoding: gzip\n"));
    EXPECT_THAT(text, HasSubstr("space origin: (-12.35"));
    EXPECT_EQ(read_bone_file(folder / "bone.nrrd").threshold_hu, std::nullopt);
}

TEST(HuFile, OfALaterVersionIsRefusedByTheVersionThatItNeeds) {
    const testing::TemporaryFolder folder;
    write_bone_file(folder / "bone.nrrd", small_volume(), {{"osteomill_needs", "99.1"}});
    EXPECT_THAT(refusal(folder / "bone.nrrd"),
                HasSubstr("bone.nrrd: needs Osteomill 99.1 or later, this is "));
    write_bone_file(folder / "bone.nrrd", small_volume(), {{"osteomill_needs", "0.3"}});
    EXPECT_EQ(refusal(folder / "bone.nrrd"), "");
}

TEST(HuFile, SendsOtherImagesToBoneImport) {
    const testing::TemporaryFolder folder;
    const auto with = [&](const std::string& type, const std::string& directions) {
        std::ofstream(folder / "x.nrrd", std::ios::binary)
            << "NRRD0005\ntype: " << type << "\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nendian: little\n"
            << directions << "\n"
            << std::string(32, '\0');
        return refusal(folder / "x.nrrd");
    };
    const std::string space = "space: left-posterior-superior\nspace directions: ";
    EXPECT_EQ(with("int16", space + "(1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"), "");
    EXPECT_THAT(with("int16", space + "(1,0,0) (0,1,0) (0,0,2)\n"),
                HasSubstr("not cubes (1 x 1 x 2 mm); run bone_import"));
    EXPECT_THAT(with("int16", space + "(1,0,0) (0,-1,0) (0,0,1)\n"), HasSubstr("run bone_import"));
    EXPECT_THAT(with("float", space + "(1,0,0) (0,1,0) (0,0,1)\n"), HasSubstr("int16; run bone_import"));
    EXPECT_THAT(with("int16", "spacings: 1 1 1\n"), HasSubstr("run bone_import"));
    EXPECT_THAT(refusal(folder.path()), HasSubstr("run bone_import"));
    EXPECT_THAT(refusal(folder / "nowhere.nrrd"), HasSubstr("does not exist"));
}

TEST(HuFile, RefusesAFileThatIsCutOff) {
    const testing::TemporaryFolder folder;
    write_bone_file(folder / "bone.nrrd", small_volume());
    std::filesystem::resize_file(folder / "bone.nrrd", std::filesystem::file_size(folder / "bone.nrrd") - 40);
    EXPECT_THAT(refusal(folder / "bone.nrrd"), HasSubstr("cut off"));
}

TEST(HuFile, RefusesAThresholdThatIsNoNumberAndAFolderThatIsNotThere) {
    const testing::TemporaryFolder folder;
    write_bone_file(folder / "bone.nrrd", small_volume(), {{threshold_key, "high"}});
    EXPECT_THAT(refusal(folder / "bone.nrrd"), HasSubstr("osteomill_threshold_hu:=high"));
    EXPECT_THROW(write_bone_file(folder / "none/bone.nrrd", small_volume()), std::runtime_error);
}

TEST(HuFile, RefusesAHeaderThatIsNotTheOneWritten) {
    const testing::TemporaryFolder folder;
    write_bone_file(folder / "bone.nrrd", small_volume(), {{threshold_key, "300"}});
    std::ifstream file(folder / "bone.nrrd", std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"(-12.35,", "(-12.45,"},
             {"sizes: 5 4 3", "sizes: 5 3 4"},
             {"threshold_hu:=300", "threshold_hu:=200"},
             {"osteomill_hu_digest", "osteomill_hu_digesT"},
             {"(0.1,0,0) (0,0.1,0) (0,0,0.1)", "(0.3,0,0) (0,0.3,0) (0,0,0.3)"}}) {
        std::string changed = text;
        changed.replace(changed.find(from), from.size(), to);
        std::ofstream(folder / "bone.nrrd", std::ios::binary) << changed;
        EXPECT_THAT(refusal(folder / "bone.nrrd"),
                    HasSubstr("its header (sizes, spacing, origin, keys) is damaged: digest "))
            << to;
    }
}

TEST(HuFile, IsRefusedOrTheSameWithABitFlipped) {
    const testing::TemporaryFolder folder;
    const HuVolume volume = small_volume();
    write_bone_file(folder / "bone.nrrd", volume, {{threshold_key, "300"}});
    std::ifstream file(folder / "bone.nrrd", std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    int refused = 0;
    for (std::size_t bit = 0; bit < 8 * text.size(); bit += 7) {
        std::string flipped = text;
        flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
        std::ofstream(folder / "bone.nrrd", std::ios::binary) << flipped;
        try {
            const testing::DenseBoneFile read = read_bone_file(folder / "bone.nrrd");
            EXPECT_EQ(read.volume.hu, volume.hu) << bit;
            EXPECT_EQ(read.volume.grid, volume.grid) << bit;
            EXPECT_EQ(read.threshold_hu, 300.0) << bit;
        } catch (const ImagingError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, static_cast<int>(4 * text.size() / 7)) << "of eight bits a byte, a seventh";
}

TEST(HuFile, ReadsOtherSpacesAndByteOrders) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "x.nrrd", std::ios::binary)
        << "NRRD0005\ntype: short\ndimension: 3\nsizes: 2 1 1\nencoding: raw\nendian: big\nspace: RAS\n"
           "space directions: (-0.5,0,0) (0,-0.5,0) (0,0,0.5)\nspace origin: (1, -2, 3)\n\n"
        << std::string("\x01\x02\xff\xfe", 4);
    const testing::DenseBoneFile file = read_bone_file(folder / "x.nrrd");
    EXPECT_EQ(file.volume.grid,
              (Grid{.size_voxels = {2, 1, 1}, .spacing_mm = 0.5, .origin_mm = {-1.0, 2.0, 3.0}}));
    EXPECT_EQ(file.volume.hu, (std::vector<std::int16_t>{0x102, -2}));
}

}  // namespace
}  // namespace osteomill
