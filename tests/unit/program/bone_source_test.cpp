#include "imaging/case/bone_source.h"

#include <gmock/gmock.h>

#include <fstream>

#include "imaging/imaging_error.h"
#include "tests/support/dense_bone_file.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

HuVolume block(std::int16_t bone_hu) {
    HuVolume volume{
        .grid = {.size_voxels = {20, 18, 17}, .spacing_mm = 0.1, .origin_mm = {}}, .hu = {}, .tissue = {}};
    for (int i = 0; i < 20 * 18 * 17; ++i)
        volume.hu.push_back(static_cast<std::int16_t>(i % 20 < 12 ? bone_hu + i % 300 : 40));
    return volume;
}

class BoneSourceOfFile : public ::testing::Test {
  protected:
    BoneSourceOfFile() { scene_.bone = FileSource{.path = path_}; }
    LoadedBone reloaded(const std::filesystem::path& path) const {
        Scene scene;
        scene.bone = FileSource{.path = path};
        return load_bone(scene);
    }
    testing::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "bone.nrrd";
    std::filesystem::path saved_ = folder_ / "saved.nrrd";
    Scene scene_;
};

TEST_F(BoneSourceOfFile, IsSavedWithTheHuOfTheFileThatWasLoadedAlthoughAnotherTookItsName) {
    testing::write_bone_file(path_, block(900));
    const LoadedBone loaded = load_bone(scene_);
    testing::write_bone_file(path_, block(1500));
    save_bone(saved_, loaded.source, loaded.bone);
    EXPECT_EQ(testing::read_bone_file(saved_).volume.hu, block(900).hu);
    EXPECT_EQ(checksum(reloaded(saved_).bone), checksum(loaded.bone));
}

TEST_F(BoneSourceOfFile, IsSavedAllTheSameWhereItsFileWasOverwritten) {
    testing::write_bone_file(path_, block(900));
    const LoadedBone loaded = load_bone(scene_);
    const auto expect_saved = [&] {
        try {
            save_bone(saved_, loaded.source, loaded.bone);
            ADD_FAILURE() << "not a word";
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), HasSubstr("bone.nrrd"));
            EXPECT_THAT(error.what(), HasSubstr("saved.nrrd is saved with CT numbers that only say where"));
        }
        EXPECT_EQ(checksum(reloaded(saved_).bone), checksum(loaded.bone));
        std::filesystem::remove(saved_);
    };
    // In place, not beside as our programs do it; another bone, then nothing.
    testing::write_bone_file(folder_ / "other.nrrd", block(1500));
    std::filesystem::copy(folder_ / "other.nrrd", path_, std::filesystem::copy_options::overwrite_existing);
    expect_saved();
    std::ofstream(path_, std::ios::trunc);
    expect_saved();
}

TEST_F(BoneSourceOfFile, IsSavedAllTheSameWhereTheCarvedBoneThatItContinuesIsGone) {
    testing::write_bone_file(folder_ / "scan.nrrd", block(900));
    const LoadedBone first = reloaded(folder_ / "scan.nrrd");
    const auto change = [&](int kind) {
        if (kind == 0) std::ofstream(path_, std::ios::trunc);
        if (kind == 1) std::filesystem::resize_file(path_, 1000);
        if (kind == 2) std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 50);
        if (kind == 3)
            std::filesystem::copy(folder_ / "scan.nrrd", path_,
                                  std::filesystem::copy_options::overwrite_existing);
        if (kind == 4) {  // one bit of the bricks that stand before the voxels
            std::fstream bits(path_, std::ios::in | std::ios::out | std::ios::binary);
            bits.seekp(static_cast<std::streamoff>(std::filesystem::file_size(path_) / 2));
            bits.put('\x55');
        }
    };
    for (int kind = 0; kind < 5; ++kind) {
        save_bone(path_, first.source, first.bone);
        const LoadedBone continued = load_bone(scene_);
        change(kind);
        EXPECT_THROW(save_bone(saved_, continued.source, continued.bone), SavedWithoutCt) << kind;
        EXPECT_EQ(checksum(reloaded(saved_).bone), checksum(continued.bone)) << kind;
        std::filesystem::remove(saved_);
    }
    save_bone(path_, first.source, first.bone);
    const LoadedBone continued = load_bone(scene_);
    std::filesystem::remove(path_);
    EXPECT_NO_THROW(save_bone(saved_, continued.source, continued.bone)) << "the file is held open";
    EXPECT_EQ(checksum(reloaded(saved_).bone), checksum(continued.bone));
}

TEST_F(BoneSourceOfFile, RemembersWhatAllSessionsRemoved) {
    testing::write_bone_file(path_, block(900));
    double removed_mm3 = 0.0;
    for (int session = 0; session < 3; ++session) {
        LoadedBone loaded = reloaded(session == 0 ? path_ : saved_);
        EXPECT_NEAR(loaded.source.removed_before_mm3[0], removed_mm3, 1e-8) << session;
        const double before_mm3 = bone_volume_mm3(loaded.bone);
        for (std::uint8_t& fraction : loaded.bone.fractions(0))
            fraction = static_cast<std::uint8_t>(fraction / 2);
        removed_mm3 += before_mm3 - bone_volume_mm3(loaded.bone);
        save_bone(saved_, loaded.source, loaded.bone);
    }
    EXPECT_GT(removed_mm3, 0.5);
}

TEST_F(BoneSourceOfFile, RefusesWhatHoldsNoBone) {
    testing::write_bone_file(path_, block(-900));
    EXPECT_THROW(load_bone(scene_), ImagingError);
    testing::write_bone_file(path_, block(900));
    LoadedBone loaded = load_bone(scene_);
    for (std::size_t slot = 0; slot < loaded.bone.stored_bricks(); ++slot)
        for (std::uint8_t& fraction : loaded.bone.fractions(static_cast<std::int32_t>(slot))) fraction = 0;
    save_bone(saved_, loaded.source, loaded.bone);
    EXPECT_THROW(reloaded(saved_), ImagingError) << "all of it is milled away";
}

TEST_F(BoneSourceOfFile, OfAPhantomIsMadeOnceMore) {
    scene_.bone = PhantomSource{"cube"};
    const LoadedBone loaded = load_bone(scene_);
    save_bone(saved_, loaded.source, loaded.bone);
    const testing::DenseBoneFile file = testing::read_bone_file(saved_);
    EXPECT_EQ(file.volume.hu.front(), 1600);
    EXPECT_EQ(file.volume.hu.back(), -1000);
    EXPECT_EQ(file.threshold_hu, 150.0);
    EXPECT_EQ(checksum(reloaded(saved_).bone), checksum(loaded.bone));
}

}  // namespace
}  // namespace osteomill
