#include "render_client/ui/view/transfer_file.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "common/files/atomic_file.h"
#include "common/files/inside_folder.h"
#include "common/scene/scene_file.h"
#include "common/scene/stiffness_relation.h"
#include "common/scene/toml_reader.h"
#include "common/scene/toml_text.h"
#include "common/words/translation.h"
#include "render_client/ui/view/hu_axis.h"

namespace osteomill {

namespace {

const std::vector<std::string> mode_names{"own colours", "surface", "translucent"};
constexpr std::size_t most_points = 256;
constexpr std::size_t columns = 5;

TransferPoint point_of(const TomlReader& reader, const std::vector<double>& row, std::size_t number) {
    const auto refuse = [&](const std::string& what) {
        reader.fail("points", fmt::format("point {}: {}", number, what));
    };
    if (!(row[0] >= 0.0 && row[0] <= largest_relative_stiffness))
        refuse(fmt::format("its stiffness is {}, must be 0 to {}", row[0], largest_relative_stiffness));
    TransferPoint point{.value = row[0], .opacity = row[4]};
    for (std::size_t i = 0; i < 3; ++i) {
        const double part = row[1 + i];
        if (!(part >= 0.0 && part <= 255.0) || part != std::floor(part))
            refuse(fmt::format("its colour has {}, must be whole numbers, 0 to 255", part));
        point.srgb[i] = static_cast<std::uint8_t>(part);
    }
    return point;
}

std::optional<TransferFunction> read_all(TomlReader reader) {
    const std::size_t mode = required(reader, "mode", reader.choice("mode", mode_names));
    if (mode == 0) {
        reader.refuse_other_keys();
        return std::nullopt;
    }
    TransferFunction look{.name = required(reader, "name", reader.text("name")),
                          .mode = mode == 1 ? TransferMode::surface : TransferMode::translucent};
    const auto rows = required(reader, "points", reader.rows("points", columns));
    reader.refuse_other_keys();
    if (rows.size() > most_points)
        reader.fail("points", fmt::format("has {} points, may have {}", rows.size(), most_points));
    for (const std::vector<double>& row : rows)
        look.points.push_back(point_of(reader, row, look.points.size() + 1));
    try {
        require_valid(look);
    } catch (const std::invalid_argument& wrong) {
        reader.fail("points", wrong.what());
    }
    return look;
}

}  // namespace

std::optional<TransferFunction> parse_look(std::string_view text, const std::string& name_for_messages) {
    const toml::table root = parse_toml(text, name_for_messages);
    return read_all(TomlReader(root, name_for_messages, "the look"));
}

std::optional<TransferFunction> read_transfer(const std::filesystem::path& file) {
    return parse_look(read_toml_text(file, "a look"), file.string());
}

std::string look_text(const std::optional<TransferFunction>& look) {
    if (!look) return fmt::format("mode = \"{}\"\n", mode_names[0]);
    std::ostringstream text;
    text << toml::table{{"name", look->name},
                        {"mode", mode_names[look->mode == TransferMode::surface ? 1 : 2]}};
    text << "\npoints = [  # relative stiffness, red, green, blue, opacity\n";
    for (const TransferPoint& point : look->points)
        text << fmt::format("    [{}, {}, {}, {}, {}],  # about {:.0f} HU\n", point.value, point.srgb[0],
                            point.srgb[1], point.srgb[2], point.opacity, hu_at_stiffness(point.value));
    text << "]\n";
    return text.str();
}

std::optional<std::optional<TransferFunction>> TransferFile::open(const std::filesystem::path& file) {
    if (is_users_ || file == file_) return std::nullopt;
    file_ = file;
    is_bad_ = false;
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) return otherwise_;
    try {
        // A case's file may be from elsewhere.
        if (!lies_inside(file, file.parent_path()))
            throw SceneError(file.string() + ": is a link that leads out of its folder");
        return read_transfer(file);
    } catch (const SceneError&) {
        is_bad_ = true;
        throw;
    }
}

std::string TransferFile::save(const std::optional<TransferFunction>& look) const {
    if (is_bad_) return trf("not saved: {} is no look; mend or remove it first", file_.string());
    try {
        if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path());
        write_atomic_file(file_, look_text(look), Link::replace);
    } catch (const std::exception& error) {
        return error.what();
    }
    return trf("the look is saved in {}", file_.string());
}

}  // namespace osteomill
