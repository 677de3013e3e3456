#include "common/wire/rating_message.h"

#include <string>

#include "common/text/plain_text.h"
#include "common/wire/plan_message.h"

namespace osteomill {

v2::RatingItem to_message(const RatingItem& item) {
    v2::RatingItem message;
    message.set_name(item.name);
    message.set_points(item.points);
    message.set_when(item.when);
    message.set_source(item.source);
    if (item.region) *message.mutable_region() = to_message(Plan{.region = *item.region});
    return message;
}

std::variant<Rating, WireError> rating_from(
    const google::protobuf::RepeatedPtrField<v2::RatingItem>& messages) {
    if (static_cast<std::size_t>(messages.size()) > most_rating_items)
        return WireError{"the rating has " + std::to_string(messages.size()) + " items; at most " +
                         std::to_string(most_rating_items) + " are taken"};
    Rating rating;
    for (const v2::RatingItem& message : messages) {
        if (message.name().size() > longest_rating_name || message.when().size() > longest_rating_condition ||
            message.source().size() > longest_rating_source)
            return WireError{"the rating's item \"" + one_line(message.name()) + "\" has too long a text"};
        if (!(message.points() > 0.0) || !(message.points() <= most_rating_points))
            return WireError{"the rating's item \"" + one_line(message.name()) + "\" has impossible points"};
        RatingItem item{.name = printable(message.name()),
                        .points = message.points(),
                        .when = printable(message.when()),
                        .source = printable(message.source())};
        if (message.has_region()) {
            auto region = plan_from(message.region());
            if (auto* error = std::get_if<WireError>(&region)) return *error;
            item.region = std::get<0>(std::move(region)).region;
        }
        rating.push_back(std::move(item));
    }
    return rating;
}

}  // namespace osteomill
