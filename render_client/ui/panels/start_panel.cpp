#include "render_client/ui/panels/start_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <string>
#include <string_view>

#include "common/words/translation.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/card_view.h"
#include "render_client/ui/panels/import_panel.h"
#include "render_client/ui/panels/session_dialog.h"
#include "render_client/ui/panels/widget_panel.h"

namespace osteomill {

namespace {

// Sessions that are listed, and for which the page grows.
constexpr std::size_t most_shown = 20, most_grown = 9;

struct CardGrid {
    std::size_t columns = 1;
    ImVec2 card{};
    float height = 0.0f;  ///< of all cards
};

CardGrid card_grid(const StartPage& page, float scroll_bar) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float room = ImGui::GetContentRegionAvail().x - 2.0f * style.WindowPadding.x - scroll_bar;
    CardGrid grid;
    grid.columns =
        static_cast<std::size_t>(std::clamp(static_cast<int>(room / (26.0f * ImGui::GetFontSize())), 1, 3));
    const auto columns = static_cast<float>(grid.columns);
    const float width = (room - (columns - 1.0f) * style.ItemSpacing.x) / columns;
    grid.card = {width, case_card_height(page, width)};
    const std::size_t rows = (page.cases().size() + grid.columns - 1) / grid.columns;
    grid.height =
        static_cast<float>(rows) * (grid.card.y + style.ItemSpacing.y) + style.WindowPadding.y * 2.0f;
    return grid;
}

/// Goal of a case with its marks to pass; empty without marks.
std::string goal_of(const ShelvedCase& shelved) {
    if (shelved.marks.empty()) return {};
    // A person who writes a case may leave out the full stop.
    std::string description = tr(shelved.description);
    if (!description.empty() && std::string_view(".!?").find(description.back()) == std::string_view::npos)
        description += '.';
    return trf("{}: {} To pass: {}.", shelved.is_built_in ? tr(shelved.name) : shelved.name, description,
               shelved.marks);
}

float wrapped_height(const std::string& text) {
    return ImGui::CalcTextSize(text.c_str(), nullptr, false, ImGui::GetContentRegionAvail().x).y;
}

/// The same for every case: nothing moves under the pointer when another is chosen.
float goal_height(const StartPage& page) {
    float height = 0.0f;
    for (const ShelvedCase& shelved : page.cases())
        if (!shelved.marks.empty()) height = std::max(height, wrapped_height(goal_of(shelved)));
    return height;
}

void draw_goal(const StartPage& page) {
    const float height = goal_height(page);
    if (height == 0.0f) return;
    const float end = ImGui::GetCursorPosY() + height + ImGui::GetStyle().ItemSpacing.y;
    if (page.chosen < page.cases().size())
        ImGui::TextWrapped("%s", goal_of(page.cases()[page.chosen]).c_str());
    ImGui::SetCursorPosY(end);
}

struct ListHeights {
    float cases, sessions;
};

/// The sessions have what the cards leave, and a quarter at least.
ListHeights list_heights(const StartPage& page, const CardGrid& grid) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float between = style.ItemSpacing.y, line = ImGui::GetFrameHeightWithSpacing();
    const bool has_sessions = !page.sessions().empty();
    const float goal = goal_height(page);
    const float others = 3.0f * line + (goal > 0.0f ? goal + between : 0.0f) + message_height(page) +
                         between + (has_sessions ? ImGui::GetTextLineHeightWithSpacing() + between : 0.0f) +
                         between;
    const float room = std::max(ImGui::GetContentRegionAvail().y - others, 4.0f * line);
    if (!has_sessions) return {room, 0.0f};
    const float wanted = static_cast<float>(std::min(page.sessions().size(), most_shown)) * line - between +
                         2.0f * style.WindowPadding.y;
    const float sessions = std::min(wanted, std::max(room - grid.height, 0.27f * room));
    return {room - sessions, sessions};
}

void draw_sessions(StartPage& page) {
    for (std::size_t i = 0; i < std::min(page.sessions().size(), most_shown); ++i) {
        const KeptSession session = page.sessions()[i];  // a click may list them anew
        ImGui::PushID(static_cast<int>(i));
        if (button(session.has_report ? tr("Report") : tr("Make report"),
                   session.has_report || (!page.is_working() && !session.is_under_way)))
            page.open_report_of(session);
        ImGui::SameLine();
        if (ImGui::Button(tr("Replay"))) page.replay(session.recording);
        ImGui::SameLine();
        const std::string title = session.title + (session.is_under_way ? tr(", still being written")
                                                   : session.is_whole   ? ""
                                                                        : tr(", broken off"));
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(title.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopID();
    }
}

void draw_cases(StartPage& page, StartPicture& pictures, bool is_asked) {
    const float letter = ImGui::GetFontSize();
    ImGui::TextUnformatted(tr("Choose a case: drill it with the mouse, for as long as you like."));
    ImGui::TextDisabled("%s", tr("Forces are those of milling bone; at the end there is a report."));
    CardGrid grid = card_grid(page, 0.0f);
    const ListHeights heights = list_heights(page, grid);
    if (grid.height > heights.cases) grid = card_grid(page, ImGui::GetStyle().ScrollbarSize);
    ImGui::BeginChild("cases", {0.0f, heights.cases}, true, ImGuiWindowFlags_NavFlattened);
    for (std::size_t i = 0; i < page.cases().size(); ++i) {
        if (i % grid.columns != 0) ImGui::SameLine();
        draw_case_card(page, pictures.of_cases, i, grid.card);
    }
    ImGui::EndChild();
    draw_goal(page);
    draw_message(page);
    if (!page.sessions().empty()) {
        ImGui::TextUnformatted(tr("Sessions so far"));
        ImGui::BeginChild("sessions", {0.0f, heights.sessions}, true, ImGuiWindowFlags_NavFlattened);
        draw_sessions(page);
        ImGui::EndChild();
    }
    if (button(tr("Start"), page.may_start())) page.start();
    ImGui::SameLine();
    text_field(tr("trainee"), page.trainee, 14.0f * letter);
    if (const std::string why = page.why_not_start(); !why.empty()) {
        ImGui::SameLine();
        ImGui::TextDisabled("%s", why.c_str());
    }
    if (button(tr("Import a scan ..."), page.may_start())) page.show(StartPage::View::scan_browser);
    ImGui::SameLine();
    if (button(tr("Import labels ..."), page.may_start())) page.show(StartPage::View::labels_browser);
    ImGui::SameLine();
    if (ImGui::Button(tr("Open a recording ..."))) page.show(StartPage::View::recording_browser);
    if (button(tr("Compare all sessions"), !page.is_working() && !page.sessions().empty()))
        page.compare_sessions();
    ImGui::SameLine();
    if (button(tr("Open its report"), page.report().has_value())) page.open_report();
    ImGui::SameLine();
    // There is nothing behind it while a session begins.
    if (button(tr("Hide this"), !page.is_beginning())) page.is_hidden = true;
    ImGui::SameLine();
    if (ImGui::Button(tr("Tour"))) page.tour_card = 0;
    ImGui::SameLine();
    ImGui::TextDisabled("%s", trf("{} help", key_of(Action::help)).c_str());
    // The chosen card has the keyboard before anything is gone to.
    const bool is_return = ImGui::IsKeyPressed(ImGuiKey_Enter, false);
    if (is_return && !ImGui::IsAnyItemFocused() && !page.tour_card && !is_asked) page.start();
}

/// A path to write; true once it is written.
bool path_field(std::string& path) {
    std::array<char, 1024> buffer{};
    path.copy(buffer.data(), buffer.size() - 1);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    const bool is_written =
        ImGui::InputText("##path", buffer.data(), buffer.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    path = buffer.data();
    return is_written;
}

void draw_browser(StartPage& page) {
    const bool is_for_scan =
        page.view() == StartPage::View::scan_browser || page.view() == StartPage::View::labels_browser;
    ImGui::TextUnformatted(
        is_for_scan
            ? tr("A DICOM folder, a NRRD, NIfTI or MetaImage file, or a folder of PNG or TIFF pictures")
        : page.view() == StartPage::View::colours_browser
            ? tr("Names and colours of labels: a table of 3D Slicer (.ctbl, .csv) or ITK-SNAP")
        : page.view() == StartPage::View::recording_browser
            ? tr("A recording of a session (.pcap)")
            : tr("A segmentation (.seg.nrrd, DICOM), or a label map"));
    const FolderListing listing = page.listing();  // a click replaces it
    if (std::string path = page.path(); path_field(path)) {
        page.go_to(path);
        if (page.path() == path) ImGui::SetKeyboardFocusHere(-1);  // a wrong one is mended
    }
    ImGui::BeginChild("files", list_size(3.0f), true);
    if (listing.folder.has_parent_path() && ImGui::Selectable(tr("../  (up)")))
        page.browse(listing.folder.parent_path());
    for (const std::string& name : listing.folders)
        if (ImGui::Selectable((name + "/").c_str())) page.browse(listing.folder / name);
    for (const std::string& name : listing.files)
        if (ImGui::Selectable(name.c_str())) page.take(listing.folder / name);
    ImGui::EndChild();
    if (!listing.problem.empty()) ImGui::TextUnformatted(listing.problem.c_str());
    if (!page.message().empty()) ImGui::TextUnformatted(page.message().c_str());
    if (is_for_scan) {
        if (button(tr("This folder"), !listing.files.empty())) page.take(listing.folder);
        ImGui::SameLine();
    }
    if (ImGui::Button(tr("Back"))) page.go_back();
}

struct TourCard {
    std::string title, text;
};

std::array<TourCard, 3> cards() {
    return {{{tr("1 of 3: choose a case"),
              tr("Each card is a piece of bone with a task. Click on one, or go there with the arrow keys; a "
                 "second click, or RETURN, starts it.\n\n"
                 "A CT of your own becomes a card by Import a scan ...")},
             {tr("2 of 3: drill"),
              trf("Drag with the left mouse button: the burr goes over the bone. Hold SPACE: it turns. The "
                  "wheel, or W, pushes it into the bone, S pulls it out.\n\n"
                  "Near what is protected a banner and a frame warn. {} undoes a stroke. {} shows all keys.",
                  key_of(Action::undo), key_of(Action::help))},
             {tr("3 of 3: read the report"),
              trf("Finish, or {}, ends the session. Its report says how long it took, with which forces, "
                  "what was removed and what was touched.\n\n"
                  "It stays under Sessions so far. Compare all sessions draws learning curves.",
                  key_of(Action::finish))}}};
}

bool is_pressed(ImGuiKey key) {
    return !ImGui::IsAnyItemFocused() && ImGui::IsKeyPressed(key, false);
}

void draw_card(StartPage& page) {
    const std::size_t number = *page.tour_card;
    const bool is_last = number + 1 == cards().size();
    ImGui::TextUnformatted(cards()[number].title.c_str());
    ImGui::Separator();
    ImGui::TextWrapped("%s", cards()[number].text.c_str());
    ImGui::SetCursorPosY(ImGui::GetWindowHeight() - ImGui::GetFrameHeight() -
                         ImGui::GetStyle().WindowPadding.y);
    if (ImGui::Button(is_last ? tr("Begin") : tr("Next")) || is_pressed(ImGuiKey_Enter) ||
        is_pressed(ImGuiKey_RightArrow))
        is_last ? page.tour_card.reset() : void(page.tour_card = number + 1);
    ImGui::SameLine();
    ImGui::BeginDisabled(number == 0);
    if (ImGui::Button(tr("Back")) || (number > 0 && is_pressed(ImGuiKey_LeftArrow)))
        page.tour_card = number - 1;
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button(tr("Skip"))) page.tour_card.reset();
    ImGui::SameLine();
    ImGui::TextDisabled("%s", trf("RETURN: on   {}: skip", key_of(Action::end)).c_str());
}

/// Opaque, for the page is not to be read through it. ImGui would put a child's own background below the
/// children before the last.
void draw_paper() {
    const ImVec2 low = ImGui::GetWindowPos();
    const ImVec2 high{low.x + ImGui::GetWindowWidth(), low.y + ImGui::GetWindowHeight()};
    ImVec4 paper = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
    paper.w = 1.0f;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(low, high);
    list.AddRectFilled(low, high, ImGui::GetColorU32(paper));
    list.AddRect(low, high, ImGui::GetColorU32(ImGuiCol_NavHighlight));
    list.PopClipRect();
}

/// A page of its own in the middle, over the rest.
void begin_card(const char* name, const ImVec2& size) {
    const ImVec2 room = ImGui::GetWindowSize();
    ImGui::SetCursorPos({0.5f * (room.x - size.x), 0.5f * (room.y - size.y)});
    ImGui::BeginChild(name, size, false,
                      ImGuiWindowFlags_NavFlattened | ImGuiWindowFlags_AlwaysUseWindowPadding);
    draw_paper();
}

/// As a session asks (session_dialog.h).
void draw_end_question(const StartPage& page, ViewSettings& view, SessionRequests& requests) {
    const SessionAtHand session = page.is_session_running() ? SessionAtHand::own : SessionAtHand::none;
    const glm::vec2 size = session_dialog_size(view, session);
    begin_card("end", {size.x, size.y});
    draw_question(view, session, requests);
    ImGui::EndChild();
}

}  // namespace

void draw_tour(StartPage& page) {
    if (!page.tour_card) return;
    const float letter = ImGui::GetFontSize();
    const ImVec2 room = ImGui::GetWindowSize();
    const ImVec2 size{std::min(36.0f * letter, 0.9f * room.x),
                      7.0f * letter + 3.0f * ImGui::GetFrameHeightWithSpacing()};
    begin_card("tour", size);
    draw_card(page);
    ImGui::EndChild();
}

glm::vec2 start_panel_size(const StartPage& page, const glm::vec2& available) {
    const float letter = ImGui::GetFontSize();
    // A region is chosen in slices, the larger the better.
    if (page.view() == StartPage::View::import) return glm::min(available, letter * glm::vec2(96.0f, 56.0f));
    glm::vec2 size = letter * glm::vec2(86.0f, 44.0f);
    if (page.shows_cases())
        size.y += ImGui::GetFrameHeightWithSpacing() *
                  static_cast<float>(std::min(page.sessions().size(), most_grown));
    return glm::min(available, size);
}

void draw_start_panel(StartPage& page, StartPicture& picture, const PanelPlace& place, ViewSettings& view,
                      SessionRequests* requests) {
    const WidgetPanel window("start", place, WidgetPanel::Background::filled, WidgetPanel::Size::whole,
                             WidgetPanel::Keys::reach_it);
    if (view.question != SessionQuestion::end || requests == nullptr) view.question = SessionQuestion::none;
    const bool asks = view.question != SessionQuestion::none;
    ImGui::BeginDisabled(page.tour_card.has_value() || asks);
    switch (page.view()) {
        case StartPage::View::cases:
            draw_cases(page, picture, asks);
            break;
        case StartPage::View::import:
            draw_import(page, picture);
            break;
        case StartPage::View::scan_browser:
        case StartPage::View::labels_browser:
        case StartPage::View::segmentation_browser:
        case StartPage::View::colours_browser:
        case StartPage::View::recording_browser:
            draw_browser(page);
            break;
    }
    ImGui::EndDisabled();
    if (page.shows_cases()) draw_tour(page);
    if (asks) draw_end_question(page, view, *requests);
}

}  // namespace osteomill
