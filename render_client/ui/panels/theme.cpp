#include "render_client/ui/panels/theme.h"

namespace osteomill {

namespace {

constexpr Theme dark{.tones = {Rgba{235, 235, 235},
                               {196, 199, 203},
                               {0, 190, 140},
                               {248, 130, 62},
                               {230, 159, 0},
                               {86, 180, 233},
                               {0, 190, 140},
                               {240, 228, 66},
                               {224, 140, 187}},
                     .panel = {16, 18, 21, 216},
                     .control = {62, 68, 76},
                     .control_hovered = {74, 81, 92},
                     .control_active = {0, 84, 138},
                     .grid = {150, 150, 150, 90},
                     .on_picture = {240, 240, 240},
                     .behind_letter = {0, 0, 0, 170},
                     .background_low = {0.035f, 0.040f, 0.048f},
                     .background_high = {0.115f, 0.130f, 0.150f}};

constexpr Theme light{.tones = {Rgba{24, 24, 24},
                                {70, 73, 77},
                                {0, 110, 80},
                                {176, 48, 0},
                                {150, 66, 0},
                                {0, 100, 165},
                                {0, 108, 78},
                                {60, 60, 60},
                                {150, 60, 115}},
                      .panel = {250, 250, 248, 224},
                      .control = {208, 212, 217},
                      .control_hovered = {186, 192, 199},
                      .control_active = {124, 198, 240},
                      .grid = {90, 90, 90, 90},
                      .on_picture = {20, 20, 20},
                      .behind_letter = {255, 255, 255, 180},
                      .background_low = {0.52f, 0.54f, 0.56f},
                      .background_high = {0.80f, 0.82f, 0.84f}};

}  // namespace

const Theme& theme_of(ThemeName name) {
    return name == ThemeName::dark ? dark : light;
}

ThemeName other_theme(ThemeName name) {
    return name == ThemeName::dark ? ThemeName::light : ThemeName::dark;
}

}  // namespace osteomill
