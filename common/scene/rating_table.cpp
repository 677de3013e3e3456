#include "common/scene/rating_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/scene/nearest_name.h"
#include "common/scene/plan_table.h"
#include "common/scene/rating_condition.h"
#include "common/scene/rating_quantities.h"
#include "common/scene/scene_keys.h"
#include "common/text/plain_text.h"

namespace osteomill {

namespace {

/// Names that a quantity may have, and the word for them.
struct Names {
    const char* what;
    std::vector<std::string> all{};
};

Names names_for(RatedThing of, const Scene& scene) {
    Names names{of == RatedThing::burr                                            ? "burr"
                : of == RatedThing::tissue || of == RatedThing::session_or_tissue ? "tissue"
                                                                                  : "protected tissue"};
    if (of == RatedThing::burr)
        for (const Burr& burr : scene.burrs) names.all.push_back(burr.name);
    else
        for (const Tissue& tissue : scene.tissues)
            if (tissue.is_protected || of == RatedThing::tissue || of == RatedThing::session_or_tissue)
                names.all.push_back(tissue.name);
    return names;
}

/// Nothing: the scene can answer it.
std::optional<std::string> why_not_answered(const AskedQuantity& asked, const Scene& scene, bool has_region) {
    const RatedThing of = rated_quantity(asked.key)->of;
    const bool takes_none = of == RatedThing::session || of == RatedThing::plan || of == RatedThing::region;
    if (of == RatedThing::plan && !scene.plan)
        return fmt::format("asks for '{}', and the scene has no [plan]", asked.key);
    if (of == RatedThing::region && !has_region)
        return fmt::format(
            "asks for '{}', and the item has no region: give it a tissue, a sphere or a cylinder", asked.key);
    if (takes_none)
        return asked.of.empty() ? std::nullopt
                                : std::optional(fmt::format("asks for '{}' of '{}'; it takes no name",
                                                            asked.key, asked.of));
    const Names names = names_for(of, scene);
    if (names.all.empty())
        return fmt::format("asks for '{}', and the scene has no {}", asked.key, names.what);
    if (asked.of.empty())
        return of == RatedThing::any_structure || of == RatedThing::session_or_tissue ||
                       of == RatedThing::burr
                   ? std::nullopt
                   : std::optional(fmt::format("asks for '{0}' without saying of which {1}; write {0}('{2}')",
                                               asked.key, names.what, names.all.front()));
    if (std::ranges::find(names.all, asked.of) != names.all.end()) return std::nullopt;
    auto meant = same_name(asked.of, names.all);
    if (!meant) meant = nearest_name(asked.of, names.all);
    return fmt::format("asks for '{}' of '{}', which is no {} of the scene{}", asked.key, one_line(asked.of),
                       names.what, meant ? "; did you mean '" + *meant + "'?" : "");
}

std::string bounded(TomlReader& reader, const char* key, std::size_t most) {
    std::string text = reader.text(key).value_or("");
    if (text.size() > most)
        reader.fail(key, fmt::format("'{}' in [[rating]] has {} letters; at most {} are read", key,
                                     text.size(), most));
    return text;
}

RatingItem read_item(TomlReader& reader, const Scene& scene) {
    RatingItem item{.name = bounded(reader, "name", longest_rating_name)};
    if (item.name.empty()) reader.fail_missing("name");
    scene_keys::of_rating_item(reader, item, RatingItem());
    item.when = bounded(reader, "when", longest_rating_condition);
    item.source = bounded(reader, "source", longest_rating_source);
    item.region = read_region(reader, scene.tissues, "[[rating]]");
    reader.refuse_other_keys();
    if (item.when.empty()) reader.fail_missing("when");
    const auto refuse = [&](const std::string& why) {
        reader.fail("when", fmt::format("[[rating]] \"{}\": 'when' {}", one_line(item.name), why));
    };
    try {
        const RatingCondition condition(item.when);
        for (const AskedQuantity& asked : condition.quantities())
            if (const auto why = why_not_answered(asked, scene, item.region.has_value())) refuse(*why);
    } catch (const ConditionError& error) {
        refuse(error.what());
    }
    return item;
}

}  // namespace

Rating read_rating(std::vector<TomlReader> readers, const Scene& scene) {
    if (readers.size() > most_rating_items)
        readers[most_rating_items].fail("name", fmt::format("{} items of [[rating]]; at most {} are read",
                                                            readers.size(), most_rating_items));
    Rating rating;
    for (TomlReader& reader : readers) {
        RatingItem item = read_item(reader, scene);
        if (std::ranges::find(rating, item.name, &RatingItem::name) != rating.end())
            reader.fail("name",
                        fmt::format("two items of [[rating]] are called \"{}\"", one_line(item.name)));
        rating.push_back(std::move(item));
    }
    return rating;
}

}  // namespace osteomill
