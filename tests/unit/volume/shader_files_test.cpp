#include "render_client/volume/shaders/shader_files.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::shader_files_test {
namespace {

using ::testing::HasSubstr;

class ShaderFilesTest : public OffscreenTest {};

/// The constants of a variant of BoneProgram.
std::string variant_constants(int bits) {
    std::string text;
    for (const char* name :
         {"bone_has_colour_code", "bone_codes_are_mostly_alike", "bone_has_smoothed",
          "bone_has_surface_colours", "bone_is_translucent", "bone_is_occluded", "bone_shines",
          "bone_shows_through", "cuts_show_ct", "bone_has_grain", "bone_has_sawn_faces"}) {
        text += std::string("const bool ") + name + (bits % 2 == 1 ? " = true;\n" : " = false;\n");
        bits /= 2;
    }
    return text + "const int cut_count = " + std::to_string(bits) + ";\n";
}

std::vector<std::string_view> behind_bone_sampling(std::string_view places, const ProgramFiles& files) {
    std::vector<std::string_view> names{places};
    names.insert(names.end(), bone_sampling_files.begin(), bone_sampling_files.end());
    names.insert(names.end(), files.fragment.begin(), files.fragment.end());
    return names;
}

TEST_F(ShaderFilesTest, AllCompileInAllTheirPrograms) {
    std::set<std::string_view> used;
    for (const ProgramFiles& files :
         {background_files, gathered_light_files, contact_shadow_files, discontinuity_block_files,
          upscale_files, interleave_rows_files, light_field_files, tool_files, mesh_surface_files}) {
        EXPECT_NO_THROW(make_program(files)) << files.vertex;
        used.insert(files.vertex);
        used.insert(files.fragment.begin(), files.fragment.end());
    }
    EXPECT_NO_THROW(make_program(shader_text({&structure_files.vertex, 1}),
                                 shader_text(structure_files.fragment, "const int cut_count = 4;\n")));
    used.insert(structure_files.vertex);
    used.insert(structure_files.fragment.begin(), structure_files.fragment.end());
    for (const ProgramFiles& files : {raycast_files, slice_files, bone_surface_files, silhouette_files})
        for (const char* places : {"dense_places.glsl", "atlas_places.glsl"}) {
            const auto names = behind_bone_sampling(places, files);
            for (const int bits : {0, 1, 2 + 1, 4, 8, 16, 32, 64 + 32, 128 + 64, 255, 512 + 64, 1024, 2047})
                EXPECT_NO_THROW(make_program(shader_text({&files.vertex, 1}),
                                             shader_text(names, variant_constants(bits))))
                    << files.vertex << " behind " << places << ", variant " << bits;
            used.insert(files.vertex);
            used.insert(names.begin(), names.end());
        }
    for (const ShaderFile& file : shader_files()) EXPECT_TRUE(used.contains(file.name)) << file.name;
}

TEST_F(ShaderFilesTest, ErrorsNameFileAndLine) {
    // Without background.glsl, its names are unknown.
    const std::vector<std::string_view> names{"lighting.glsl", "background.frag.glsl"};
    const auto file = std::find_if(shader_files().begin(), shader_files().end(),
                                   [&](const ShaderFile& each) { return each.name == names[1]; });
    ASSERT_NE(file, shader_files().end());
    const auto call = file->text.find("background_at");
    ASSERT_NE(call, std::string_view::npos);
    const auto line = 1 + std::count(file->text.begin(), file->text.begin() + static_cast<long>(call), '\n');
    const std::string_view vertex = background_files.vertex;
    try {
        make_program(shader_text({&vertex, 1}), shader_text(names));
        FAIL() << "compiled";
    } catch (const std::runtime_error& error) {
        // Mesa's way of saying it, and NVIDIA's.
        const std::string file_name = "background.frag.glsl", at = std::to_string(line);
        EXPECT_THAT(error.what(),
                    ::testing::AnyOf(HasSubstr(file_name + ':' + at), HasSubstr(file_name + '(' + at + ')')));
    }
}

TEST(ShaderText, OfAnUnknownFileIsAMistakeOfTheProgram) {
    const std::string_view name = "nothing.glsl";
    EXPECT_THROW(shader_text({&name, 1}), std::logic_error);
}

}  // namespace
}  // namespace osteomill::shader_files_test
