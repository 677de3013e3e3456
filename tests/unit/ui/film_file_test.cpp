#include "render_client/ui/view/film_file.h"

#include <gmock/gmock.h>

#include <random>
#include <stdexcept>

#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

/// Pictures that no coder makes small.
Picture noise(std::mt19937& random) {
    Picture picture({64, 48});
    for (std::uint8_t& byte : picture.rgb) byte = static_cast<std::uint8_t>(random());
    return picture;
}

TEST(FilmFile, ThatFindsAFullDiskIsNoFilmAndSaysWhy) {
    const testing::TemporaryFolder folder;
    const auto file = folder / "a.mp4";
    const auto make = [&] {
        const testing::FileSizeLimit disk(20'000);
        std::mt19937 random(1);
        FilmFile film(file, {64, 48}, 30);
        for (int i = 0; i < 30; ++i) film.add(noise(random));
        film.close();
    };
    EXPECT_THAT(make,
                ::testing::ThrowsMessage<std::runtime_error>(::testing::AllOf(
                    ::testing::HasSubstr(file.string() + ": ffmpeg could not make it: "),
                    ::testing::HasSubstr("File too large"), ::testing::Not(::testing::HasSubstr("\n")))));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace osteomill
