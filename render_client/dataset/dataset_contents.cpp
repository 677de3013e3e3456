#include "render_client/dataset/dataset_contents.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace osteomill {

DatasetImages images_named(std::span<const std::string> names) {
    constexpr std::array kinds{
        std::pair{"colour", &DatasetImages::colour}, std::pair{"depth", &DatasetImages::depth},
        std::pair{"ray-depth", &DatasetImages::ray_depth}, std::pair{"labels", &DatasetImages::labels},
        std::pair{"normals", &DatasetImages::normals}};
    DatasetImages images{false, false, false, false, false};
    for (const std::string& name : names) {
        const auto kind = std::ranges::find_if(kinds, [&](const auto& one) { return name == one.first; });
        if (kind == kinds.end())
            throw std::invalid_argument("has '" + name +
                                        "', not one of colour, depth, ray-depth, labels, normals");
        images.*kind->second = true;
    }
    return images;
}

}  // namespace osteomill
