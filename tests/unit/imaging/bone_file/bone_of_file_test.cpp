#include "imaging/bone_file/bone_of_file.h"

#include <gmock/gmock.h>

#include "imaging/bone_file/nrrd_writer.h"
#include "imaging/imaging_error.h"
#include "tests/support/dense_bone_file.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

class BoneOfFileTest : public ::testing::Test {
  protected:
    /// A cube whose HU are air in a third, soft tissue in a third and bone in a third, and `offset` more.
    static HuVolume scan(int offset) {
        HuVolume volume{.grid = {.size_voxels = {30, 30, 30}, .spacing_mm = 0.1, .origin_mm = {}},
                        .hu = {},
                        .tissue = {}};
        for (int i = 0; i < 27'000; ++i) {
            const int tissue_hu = i % 30 < 10 ? -1000 : (i % 30 < 20 ? 40 : 1400);
            volume.hu.push_back(static_cast<std::int16_t>(std::max(tissue_hu + i % 41 - 20, -1024) + offset));
        }
        return volume;
    }
    /// The file as another program writes it: without our keys.
    std::filesystem::path foreign(const HuVolume& volume) const {
        NrrdWriter writer(path_, {.voxel = NrrdVoxel::int16, .grid = volume.grid});
        writer.add(std::as_bytes(std::span(volume.hu)));
        writer.commit({});
        return path_;
    }
    std::string refusal(const std::filesystem::path& path, std::optional<double> threshold_hu,
                        std::optional<std::uint64_t> available_bytes = std::nullopt) const {
        return testing::message_of<ImagingError>(
            [&] { bone_of_file(path, threshold_hu, relation_, available_bytes); });
    }

    const StiffnessRelation relation_ = default_stiffness_relation();
    testing::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "bone.nrrd";
};

TEST_F(BoneOfFileTest, OfAnotherProgramIsDoubtedWhereItsValuesAreNoHu) {
    EXPECT_EQ(bone_of_file(foreign(scan(0)), {}, relation_).doubt, "");
    EXPECT_THAT(bone_of_file(foreign(scan(1000)), {}, relation_).doubt,
                HasSubstr("as where air is stored as 0"));
    EXPECT_THAT(bone_of_file(foreign(scan(1024)), {}, relation_).doubt, HasSubstr("--rescale 1,-1024"));
    HuVolume labels = scan(0);
    for (std::int16_t& value : labels.hu)
        value = static_cast<std::int16_t>(value > 300 ? 2 : value > -100 ? 1 : 0);
    EXPECT_THAT(bone_of_file(foreign(labels), 1.0, relation_).doubt, HasSubstr("as of a label map"));
    EXPECT_THAT(refusal(foreign(labels), {}),
                HasSubstr("no voxel reaches 300 HU, the highest has 2; its values "
                          "are 3 whole numbers from 0 to 2, as of a label map"));
}

TEST_F(BoneOfFileTest, OfOursIsNotDoubtedTwice) {
    testing::write_bone_file(path_, scan(1000));
    EXPECT_EQ(bone_of_file(path_, {}, relation_).doubt, "");
}

TEST_F(BoneOfFileTest, ThatIsAllBoneIsDoubted) {
    HuVolume volume = scan(0);
    std::fill(volume.hu.begin(), volume.hu.end(), std::int16_t{-1000});
    testing::write_bone_file(path_, volume);
    EXPECT_EQ(bone_of_file(path_, -1000.0, relation_).doubt,
              "every voxel reaches -1000 HU, so that all of it is bone");
    EXPECT_THAT(refusal(path_, -999.0), HasSubstr("holds no bone: no voxel reaches -999 HU"));
}

TEST_F(BoneOfFileTest, IsRefusedWhereItWouldNotFitInMemory) {
    testing::write_bone_file(path_, scan(0));
    EXPECT_EQ(refusal(path_, 300.0, 3 * 9000), "");
    EXPECT_THAT(refusal(path_, 300.0, 3 * 9000 - 1),
                HasSubstr("bone.nrrd: has more bone, from 300 HU on, than fits in the 0.0 GiB of memory"));
    EXPECT_THAT(refusal(path_, -2000.0, 3 * 9000), HasSubstr("from -2000 HU on"));
}

}  // namespace
}  // namespace osteomill
