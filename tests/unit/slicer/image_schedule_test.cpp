#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "slicer/slicer_session.h"

namespace osteomill {
namespace {

constexpr ReducedBox whole{{0, 0, 0}, {64, 64, 64}};

bool holds(const ReducedBox& outer, const ReducedBox& inner) {
    return around(outer, inner) == outer;
}

TEST(ImageSchedule, BeginsWithTheWhole) {
    ImageSchedule schedule;
    EXPECT_FALSE(schedule.next(0.0)) << "there is no image yet";
    schedule.restart(whole);
    EXPECT_EQ(schedule.next(0.0), whole);
    EXPECT_FALSE(schedule.next(0.0));
    EXPECT_FALSE(schedule.next(100.0)) << "nothing changes";
}

TEST(ImageSchedule, SendsTheWholeAgainAtRest) {
    ImageSchedule schedule;
    schedule.restart(whole);
    EXPECT_TRUE(schedule.next(0.0));
    schedule.changed({{1, 1, 1}, {2, 2, 2}}, 8.0);
    EXPECT_EQ(schedule.next(8.0), (ReducedBox{{1, 1, 1}, {2, 2, 2}}));
    EXPECT_FALSE(schedule.next(8.9));
    EXPECT_EQ(schedule.next(9.0), whole);
    EXPECT_FALSE(schedule.next(20.0));
}

/// Milling that wanders, drawn from a seed, and a receiver that imports the newest message now and then:
/// after each import it holds all that had changed, and its very first import is a whole.
TEST(ImageSchedule, LeavesNoReceiverBehindThatImportsWithinFiveSeconds) {
    for (const double between_imports_s : {0.005, 0.3, 3.0, 4.9}) {
        std::mt19937 random(7);
        std::uniform_int_distribution<int> place(0, 62);
        std::uniform_real_distribution<double> chance(0.0, 1.0);
        ImageSchedule schedule;
        schedule.restart(whole);
        struct Change {
            ReducedBox box;
            double at_s;
        };
        std::vector<Change> missing;  // in the receiver's image
        std::optional<ReducedBox> newest;
        double newest_s = 0.0;
        bool has_image = false;
        double import_s = between_imports_s;
        double last_part_s = -1.0;
        int parts = 0;
        for (int frame = 0; frame < 3000; ++frame) {  // 100 s
            const double now_s = frame / 30.0;
            const bool mills = static_cast<int>(now_s) % 20 < 15;
            if (mills && chance(random) < 0.7) {
                const glm::ivec3 first(place(random), place(random), place(random));
                const ReducedBox box{first, first + 2};
                schedule.changed(box, now_s);
                missing.push_back({box, now_s});
            }
            if (const auto box = schedule.next(now_s)) {
                if (*box != whole) {
                    ASSERT_GE(now_s - last_part_s, ImageSchedule::between_parts_s - 1e-9);
                    last_part_s = now_s;
                    ++parts;
                }
                newest = box;
                newest_s = now_s;
            }
            if (now_s < import_s || !newest) continue;
            import_s += between_imports_s;
            if (!has_image) {
                ASSERT_EQ(*newest, whole);
            }
            has_image = true;
            for (const Change& change : missing)
                if (change.at_s <= newest_s) {
                    ASSERT_TRUE(holds(*newest, change.box))
                        << "changed at " << change.at_s << ", imported at " << now_s << " every "
                        << between_imports_s;
                }
            std::erase_if(missing, [&](const Change& change) { return change.at_s <= newest_s; });
            newest.reset();
        }
        EXPECT_GT(parts, 100);
        EXPECT_TRUE(missing.empty()) << "milling has rested for 5 s";
    }
}

}  // namespace
}  // namespace osteomill
