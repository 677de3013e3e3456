#include "render_client/ui/start/start_page.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "common/log/log.h"
#include "common/program/available_memory.h"
#include "common/text/foreign_text.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

/// A large bone is saved, and a report drawn.
constexpr std::chrono::seconds longest_report{60};

std::filesystem::path cases_of(const StartPlaces& places) {
    return places.home / "cases";
}

/// A new folder for temporary files.
std::filesystem::path scratch_folder() {
    std::string name = (std::filesystem::temp_directory_path() / "osteomill_look_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        throw std::runtime_error("no folder for temporary files can be made in " +
                                 std::filesystem::temp_directory_path().string());
    return name;
}

void remove_quietly(const std::filesystem::path& folder) {
    std::error_code ignored;
    if (!folder.empty()) std::filesystem::remove_all(folder, ignored);
}

/// A name for the scan, made of its path.
std::string name_of_scan(const std::filesystem::path& scan) {
    const std::string name = scan.filename().string();
    const std::string stem = as_file_name(name.substr(0, name.find('.')));
    return stem.empty() ? "case" : stem;
}

/// "haptic_server: " and the like are for terminals.
std::string without_program(const std::string& line) {
    const std::size_t colon = line.find(": ");
    const bool is_program = colon != std::string::npos && line.find(' ') > colon;
    return is_program ? line.substr(colon + 2) : line;
}

/// The last line of a program that failed, in the window's language. A session's recording is kept to where
/// the disk was full.
std::string failure_in_words(const ChildProgram& program) {
    std::string words = tr_about_file(without_program(program.last_line()));
    const std::string full = std::generic_category().message(ENOSPC);
    const std::size_t at = words.find(full);
    if (at != std::string::npos) words.replace(at, full.size(), tr(full));
    if (words.find(tr(full)) == std::string::npos) return words;
    return words + ". " +
           tr("Make room on the disk, then click on \"Make report\": what was recorded until it was full is "
              "kept");
}

/// "refining 40 %, 12 s left", as a program says that works, or another line, in the window's language.
std::string progress_in_words(const std::string& line) {
    const std::size_t unit = line.find(" %");
    const std::size_t title = unit == std::string::npos ? unit : line.rfind(' ', unit - 1);
    if (title == std::string::npos) return tr_filled(line);
    const std::string left = line.substr(unit + 2);
    return tr(line.substr(0, title)) + line.substr(title, unit + 2 - title) +
           (left.starts_with(", ") ? ", " + tr_filled(left.substr(2)) : left);
}

/// How a session's program ended, for a trainee; empty if all went well. The technician finds the rest in the
/// log.
std::string end_in_words(const ChildProgram& server, bool is_recorded, bool is_broken_off) {
    const int status = server.status().value_or(0);
    if (status == 0) return {};
    if (is_broken_off)
        return is_recorded
                   ? tr("The session was broken off here, as you asked. What you did until then is kept, "
                        "first under Sessions so far: \"Make report\" makes its report.")
                   : tr("The session was broken off here, as you asked, before anything was recorded.");
    if (status > 0) return failure_in_words(server);
    log_warning("haptic_server was ended by signal {} ({}); its last line: {}", -status, strsignal(-status),
                printable(server.last_line()));
    return is_recorded
               ? tr("The session was broken off: its program ended in the middle. What you did until then is "
                    "kept, first under Sessions so far: \"Make report\" makes its report. Then start anew; "
                    "if it "
                    "happens again, tell whoever looks after the simulator.")
               : tr("The session was broken off before anything was recorded. Start it anew; if it happens "
                    "again, tell whoever looks after the simulator.");
}

/// As the server says it once all but its report is done (session_outputs.cpp).
constexpr std::string_view report_begins = "the session has ended; its report is being made";

}  // namespace

std::filesystem::path folder_of_this_program() {
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

StartPage::StartPage(StartPlaces places) : places_(std::move(places)) {
    look_at_home();
    if (const char* user = std::getenv("USER"); user != nullptr) trainee = user;
}

void StartPage::look_at_home() {
    cases_ = cases_in(cases_of(places_));
    sessions_ = sessions_in(places_.home / "reports");
    listed_ = std::chrono::steady_clock::now();
}

/// The report of a session of a window that was closed, or of another one's, is there by and by.
bool StartPage::look_after_others_sessions() {
    constexpr std::chrono::seconds between_looks{1};
    if (view_ != View::cases || std::ranges::none_of(sessions_, &KeptSession::is_under_way) ||
        std::chrono::steady_clock::now() - listed_ < between_looks)
        return false;
    const std::vector<KeptSession> before = sessions_;
    look_at_home();
    return sessions_ != before;
}

void StartPage::show(View view) {
    if (view == View::cases) look_at_home();
    message_.clear();
    wrong_path_.clear();
    clicked_.reset();
    view_ = view;
    if (view == View::cases || view == View::import) return;
    const char* home = std::getenv("HOME");
    browse(!listing_.folder.empty() ? listing_.folder : home != nullptr && *home != '\0' ? home : "/");
}

void StartPage::go_back() {
    if (view_ == View::import && is_working()) return;
    if (view_ == View::import)
        show(look_ ? View::cases : form.are_labels ? View::labels_browser : View::scan_browser);
    else
        show(view_ == View::segmentation_browser || view_ == View::colours_browser ? View::import
                                                                                   : View::cases);
}

void StartPage::browse(const std::filesystem::path& folder) {
    wrong_path_.clear();
    // DICOM files have any name, or none.
    listing_ = view_ == View::recording_browser ? list_folder(folder, {".pcap"})
               : view_ == View::colours_browser ? list_folder(folder, {".csv", ".ctbl", ".label", ".txt"})
                                                : list_folder(folder);
}

void StartPage::go_to(const std::string& path) {
    std::error_code ignored;
    message_.clear();
    if (std::filesystem::is_directory(path, ignored))
        browse(path);
    else if (std::filesystem::exists(path, ignored))
        take(path);
    else
        message_ = trf("{}: is not there", wrong_path_ = path);
}

/// Shows errors.
void StartPage::attempt(const std::function<void()>& act) {
    try {
        act();
    } catch (const std::exception& error) {
        message_ = tr_about_file(error.what());
    }
}

void StartPage::start() {
    if (!may_start() || chosen >= cases_.size()) return;
    clicked_.reset();
    if (server_) {
        server_->yield_to_others();
        reporting_.push_back(std::move(server_));
    }
    const ShelvedCase& wanted = cases_[chosen];
    message_ = make_folder_at_home(places_.home / "reports");
    if (!message_.empty()) return;
    report_.reset();
    is_hidden = is_drawn_ = is_broken_off_ = false;
    report_folder_ = report_folder(places_.home / "reports", wanted.name, trainee, std::time(nullptr));
    std::vector<std::string> command{program("haptic_server"),
                                     "--case=" + wanted.argument,
                                     "--device=client",
                                     "--listen=127.0.0.1:0",
                                     "--wait-for-client",
                                     "--report=" + report_folder_.string(),
                                     "--language=" + spoken_language(),
                                     "--save-bone=" + (report_folder_ / "bone.nrrd").string()};
    if (!trainee.empty()) command.push_back("--trainee=" + trainee);
    // A case that is built in has no folder of its own.
    std::error_code failed;
    look_file_ = std::filesystem::is_directory(wanted.argument, failed)
                     ? std::filesystem::path(wanted.argument) / "look.toml"
                     : places_.home / "looks" / (wanted.name + ".toml");
    attempt([&] {
        server_ = std::make_unique<ChildProgram>(command, longest_report);
        has_address_ = false;
        message_ = trf("{} is being made ready ...", tr(wanted.name));
    });
}

void StartPage::click_card(std::size_t index) {
    chosen = index;
    if (std::exchange(clicked_, index) == index) start();
}

bool StartPage::is_report_written() const {
    return is_session_running() && server_->output().find(report_begins) != std::string::npos;
}

std::string StartPage::why_not_start() const {
    if (may_start()) return is_report_written() ? tr("the last session's report is still being written") : "";
    return is_making_ready() ? tr("a session is being made ready")
                             : tr("the last session is still being saved");
}

bool StartPage::poll_reports() {
    return std::erase_if(reporting_, [&](const std::unique_ptr<ChildProgram>& program) {
               program->poll();
               if (program->is_running()) return false;
               if (program->status() != 0) message_ = failure_in_words(*program);
               look_at_home();
               return true;
           }) > 0;
}

void StartPage::note_end_of_session() {
    // Until the window is sent to a session that begins, it sees the end of the one before.
    if (is_session_running() && !is_making_ready())
        message_ = tr("the session has ended; its report is being written ...");
}

void StartPage::open_page(const std::filesystem::path& page) {
    opened_ = page.string();
    message_ = trf("Opening in the browser: {}", opened_);
    try {
        opener_ = std::make_unique<ChildProgram>(std::vector<std::string>{"/usr/bin/xdg-open", opened_});
    } catch (const std::exception&) {
        message_ = trf("No browser could be opened: {}", opened_);
    }
}

void StartPage::open_report_of(const KeptSession& session) {
    if (session.has_report) return open_page(session.folder / "report.html");
    if (is_working()) return;
    attempt([&] {
        work_ = Work::report;
        reported_ = session.folder;
        worker_ = std::make_unique<ChildProgram>(std::vector<std::string>{
            program("packet_replay"), session.recording.string(), "--report=" + session.folder.string(),
            "--language=" + spoken_language()});
        message_ = tr("the report is being made ...");
    });
}

void StartPage::replay(const std::filesystem::path& recording) {
    std::vector<std::string> command{program("render_client"), "--replay=" + recording.string(),
                                     "--language=" + spoken_language()};
    // A window that suits this screen, and not one that is larger than it.
    if (window_size.x > 0 && window_size.y > 0)
        command.push_back(fmt::format("--window-size={}x{}", window_size.x, window_size.y));
    attempt([&] {
        players_.push_back(std::make_unique<ChildProgram>(command));
        message_ = recording.string() + tr(" opens in a window of its own");
    });
}

void StartPage::compare_sessions() {
    if (is_working()) return;
    // Those that were broken off are named on the page.
    const auto sessions = sessions_in(places_.home / "reports", 0);
    if (std::ranges::none_of(sessions, &KeptSession::is_whole)) {
        message_ = tr("there is nothing to compare yet: no session was finished");
        return;
    }
    std::vector<std::string> command{program("osteomill_study"), "sessions", "--out",
                                     (places_.home / "comparison").string(),
                                     "--language=" + spoken_language()};
    for (const auto& session : sessions) command.push_back(session.folder.string());
    attempt([&] {
        work_ = Work::compare;
        worker_ = std::make_unique<ChildProgram>(command);
        message_ = tr("comparing ...");
    });
}

void StartPage::take(const std::filesystem::path& path) {
    if (view_ == View::scan_browser || view_ == View::labels_browser) {
        form = {.scan = path, .are_labels = view_ == View::labels_browser, .name = name_of_scan(path)};
        look_.reset();
        voxels_.reset();
        show(View::import);
        look_at_scan(true);
    } else if (view_ == View::recording_browser) {
        show(View::cases);
        replay(path);
    } else if (view_ == View::segmentation_browser || view_ == View::colours_browser) {
        form_before_ = form;
        if (view_ == View::colours_browser)
            form.colours = path;
        else
            form.segmentations.push_back(path);
        show(View::import);
        look_at_scan(false);
    }
}

void StartPage::look_at_scan(bool is_another_scan) {
    give_up_work();
    attempt([&] {
        scratch_ = scratch_folder();
        work_ = Work::look;
        is_another_scan_ = is_another_scan;
        worker_ =
            std::make_unique<ChildProgram>(look_command(program("bone_import"), form, scratch_ / "look.raw"));
        began_looking_ = std::chrono::steady_clock::now();
        message_ = tr("looking at the scan ...");
    });
}

std::string StartPage::wrong_with_form() const {
    if (std::string wrong = wrong_with_name(form.name, cases_of(places_)); !wrong.empty()) return wrong;
    if (std::string wrong = look_ ? wrong_with_threshold(form, *look_) : ""; !wrong.empty()) return wrong;
    return wrong_with_size(form);
}

void StartPage::show_error_of_form(std::string error) {
    wrong_form_ = form;
    message_ = form_error_ = std::move(error);
}

void StartPage::import() {
    if (is_working() || !look_) return;
    show_error_of_form(wrong_with_form());
    if (message_.empty()) message_ = make_folder_at_home(cases_of(places_));
    if (!message_.empty()) return;
    attempt([&] {
        work_ = Work::import;
        worker_ = std::make_unique<ChildProgram>(
            import_command(program("bone_import"), form, cases_of(places_) / form.name));
        message_ = tr("importing ...");
    });
}

void StartPage::give_up_work() {
    worker_.reset();
    remove_quietly(scratch_);
    scratch_.clear();
    message_.clear();
}

void StartPage::end_of_work() {
    const bool is_good = worker_->status() == 0;
    const std::string said = worker_->output();
    message_ = worker_->status().value_or(0) < 0 ? tr("it was ended in the middle; try again")
               : worker_->last_line().empty()    ? tr("it failed without a word")
                                                 : failure_in_words(*worker_);
    if (work_ == Work::import || work_ == Work::look) message_ = without_options(message_);
    worker_.reset();
    if (is_good) message_.clear();
    if (work_ == Work::import && !is_good) show_error_of_form(message_);
    if (work_ == Work::import && is_good) {
        show(View::cases);
        for (std::size_t i = 0; i < cases_.size(); ++i)
            if (cases_[i].name == form.name) chosen = i;
        scrolls_to_chosen = true;
        message_ = trf("{} is there", form.name);
        if (const std::string specks = specks_said(said); !specks.empty()) message_ += "; " + specks;
    } else if (work_ == Work::report) {
        look_at_home();
        if (std::error_code ignored; std::filesystem::exists(reported_ / "report.html", ignored))
            open_page(reported_ / "report.html");
    } else if (work_ == Work::compare && is_good) {
        open_page(places_.home / "comparison" / "sessions.html");
    } else if (work_ == Work::look && is_good) {
        take_in_look(said);
        form_before_ = form;
    } else if (work_ == Work::look && !is_another_scan_) {
        form.segmentations = form_before_.segmentations;
        form.colours = form_before_.colours;
    }
    remove_quietly(scratch_);
    scratch_.clear();
}

void StartPage::take_in_look(const std::string& said) {
    look_ = read_scan_preview(said);
    if (!look_) return;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began_looking_;
    look_->took_s = took.count();
    attempt([&] {
        voxels_ = std::make_shared<const ScanVoxels>(
            read_scan_voxels(scratch_ / "look.raw", look_->covers, preview_mm_per_px));
        ++voxels_number_;
    });
    form.available_bytes = available_memory_bytes().value_or(0);
    if (is_another_scan_) slices_at_mm = 0.5 * (look_->covers.low_mm + look_->covers.high_mm);
    take_look(form, *look_, is_another_scan_);
}

std::optional<LooseParts> StartPage::loose_parts() const {
    return counted_of_ == count_wanted() && !form.are_labels ? counted_ : std::nullopt;
}

/// A large scan takes a second, which the window must not stand still for.
bool StartPage::count_loose_parts() {
    bool has_news = false;
    if (count_.valid() && count_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        counted_ = count_.get();
        has_news = true;
    }
    if (view_ != View::import || !look_ || !voxels_ || form.are_labels || count_.valid() ||
        counted_of_ == count_wanted())
        return has_news;
    counted_of_ = count_wanted();
    counted_.reset();
    count_ = std::async(std::launch::async, [voxels = voxels_, look = *look_, of = counted_of_] {
        return loose_parts_in(*voxels, look, preview_mm_per_px, of.region, of.threshold_hu);
    });
    return has_news;
}

void StartPage::look_for_address() {
    constexpr std::string_view words = "listening on ";
    const std::string& said = server_->output();
    const std::size_t at = said.find(words);
    const std::size_t end = at == std::string::npos ? at : said.find('\n', at);
    if (end == std::string::npos) return;
    try {
        server_is_at_ = parse_listen_address(said.substr(at + words.size(), end - at - words.size()));
        has_address_ = true;
    } catch (const std::invalid_argument& error) {
        message_ = error.what();
    }
}

bool StartPage::poll() {
    bool has_news = false;
    if (!form_error_.empty() && form != wrong_form_) {
        if (message_ == form_error_) message_.clear();
        form_error_.clear();
        has_news = true;
    }
    if (worker_ && worker_->poll()) {
        has_news = true;
        if (!worker_->is_running())
            end_of_work();
        else if (const std::string line = without_program(worker_->last_line());
                 !line.empty() && (scratch_.empty() || line.find(scratch_.string()) == std::string::npos))
            message_ = progress_in_words(line);
    }
    has_news = count_loose_parts() || has_news;
    has_news = poll_reports() || has_news;
    has_news = look_after_others_sessions() || has_news;
    if (server_ && server_->poll()) {
        has_news = true;
        if (!server_->is_running()) {
            const std::filesystem::path page = report_folder_ / "report.html";
            std::error_code ignored;
            if (std::filesystem::exists(page, ignored)) report_ = page;
            look_at_home();
            const bool is_recorded =
                std::ranges::find(sessions_, report_folder_, &KeptSession::folder) != sessions_.end();
            message_ = end_in_words(*server_, is_recorded, is_broken_off_);
            server_.reset();
            // Its port may soon be somebody else's.
            server_is_at_ = places_.connects_to;
        } else if (!has_address_) {
            look_for_address();
        }
    }
    std::erase_if(players_, [&](const std::unique_ptr<ChildProgram>& player) {
        if (!player->poll() || player->is_running()) return false;
        has_news = true;
        if (player->status() != 0) message_ = failure_in_words(*player);
        return true;
    });
    if (opener_ && opener_->poll() && !opener_->is_running()) {
        has_news = true;
        if (opener_->status() != 0)
            message_ = trf("No browser could be opened: {}", opened_);
        else if (message_ == trf("Opening in the browser: {}", opened_))
            message_ = trf("Opened in the browser: {}", opened_);
        opener_.reset();
    }
    return has_news;
}

}  // namespace osteomill
