// The start page: a session on this machine from the window alone. It lists the cases, makes a case of a
// scan, starts haptic_server for it as a separate program, and shows where the report is. No drawing here
// (panels/start_panel.h).
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/net/listen_address.h"
#include "common/program/child_program.h"
#include "render_client/ui/start/case_library.h"
#include "render_client/ui/start/folder_listing.h"
#include "render_client/ui/start/import_form.h"
#include "render_client/ui/start/kept_sessions.h"
#include "render_client/ui/start/loose_parts.h"

namespace osteomill {

struct StartPlaces {
    std::filesystem::path programs;  ///< where haptic_server and bone_import are
    std::filesystem::path home;      ///< has the folders cases and reports
    ListenAddress connects_to;       ///< the window's own server, while none was started here
};

/// Beside the program that runs.
std::filesystem::path folder_of_this_program();

class StartPage {
  public:
    enum class View {
        cases,
        import,
        scan_browser,
        labels_browser,
        segmentation_browser,
        colours_browser,
        recording_browser
    };

    explicit StartPage(StartPlaces places);
    /// Ends its programs: a session's server writes its report first.
    ~StartPage() { give_up_work(); }

    /// Once in a while: looks after the programs that run. True if there is something new to show.
    bool poll();

    View view() const { return view_; }
    bool shows_cases() const { return view_ == View::cases; }
    void show(View view);
    /// From an import or a browser to where it was called, unless a scan is imported or looked at.
    void go_back();
    /// One line about an error or current work; empty: nothing.
    const std::string& message() const { return message_; }
    std::string
        link_line{};  ///< why the server that a person named has no session here; empty: none was named

    const std::vector<ShelvedCase>& cases() const { return cases_; }
    /// The sessions that were kept here, the newest first.
    const std::vector<KeptSession>& sessions() const { return sessions_; }
    /// Its report in the user's browser, made before if there is none; a recording in a window of its own.
    void open_report_of(const KeptSession& session);
    void replay(const std::filesystem::path& recording);
    glm::ivec2 window_size{0};  ///< of this window, for others that it opens; 0: any
    std::size_t chosen = 0;     ///< index in cases()
    /// The next frame's list scrolls to the chosen case: it was chosen by an import, and may be out of sight.
    bool scrolls_to_chosen = false;
    std::string trainee{};  ///< who works in the session
    /// Beside a report that is still being written, too: all else of that session lies on the disk, and its
    /// program gives way to the new one's.
    void start();
    bool may_start() const { return !is_session_running() || is_report_written(); }
    /// Why there is no start yet, or what goes on beside it; empty: nothing.
    std::string why_not_start() const;
    /// A person's click on a card: the first chooses it, the second starts it, however long after. (A double
    /// click is over in 0.3 s, in which a slow picture draws one frame.)
    void click_card(std::size_t index);
    /// The window has seen the end of the session: only its report remains to be written.
    void note_end_of_session();
    /// File of the appearance of the case started last; empty before.
    const std::filesystem::path& look_file() const { return look_file_; }
    /// The server that the window should connect to from now on, if it has changed: a session started here
    /// listens on a port of its own.
    std::optional<ListenAddress> take_server() { return std::exchange(server_is_at_, std::nullopt); }
    bool is_session_running() const { return server_ != nullptr && server_->is_running(); }
    /// A session was started here, and the window has not drawn its bone yet: nothing of another is drawn.
    bool is_beginning() const { return is_session_running() && !is_drawn_; }
    /// The window draws the bone of the session that began.
    void note_bone_of_session() { is_drawn_ = !is_making_ready(); }
    /// A session was started here, and the window has not been sent to it yet.
    bool is_making_ready() const { return is_session_running() && (!has_address_ || server_is_at_); }
    /// Started a session that has ended.
    bool has_served() const { return !report_folder_.empty() && server_ == nullptr; }
    /// The last session's report, once it is written.
    const std::optional<std::filesystem::path>& report() const { return report_; }
    /// Ends the session's program at once, for it stands still; its recording stays.
    void break_off() {
        is_broken_off_ = is_session_running();
        if (server_) server_->kill();
    }
    /// Opens the report in the user's browser.
    void open_report() {
        if (report_) open_page(*report_);
    }
    /// Makes tables and learning curves of every session in the reports, and opens them once they are there.
    void compare_sessions();
    std::optional<std::size_t> tour_card{};  ///< which of the tour's cards is over the page
    bool is_hidden = false;  ///< until the next session: the user inspects the result of the last

    ImportForm form{};
    /// The scan's preview, once it is there.
    const std::optional<ScanPreview>& look() const { return look_; }
    const std::shared_ptr<const ScanVoxels>& voxels() const { return voxels_; }
    /// An estimate for the form's region and threshold; nothing while it is made, and of labels.
    std::optional<LooseParts> loose_parts() const;
    std::uint64_t voxels_number() const { return voxels_number_; }  ///< another for each preview
    glm::dvec3 slices_at_mm{0.0};                                   ///< where the slices meet, patient LPS
    bool is_working() const { return worker_ != nullptr; }          ///< makes a preview or imports
    bool is_importing() const { return is_working() && work_ == Work::import; }
    /// Retries the preview of a scan that failed before.
    void look_again() { look_at_scan(true); }
    void import();
    void give_up_work();

    const FolderListing& listing() const { return listing_; }
    /// The text of the browser's path field: a path that was written and is not there stays, to be mended.
    std::string path() const { return wrong_path_.empty() ? listing_.folder.string() : wrong_path_; }
    /// With the files that suit the browser's purpose.
    void browse(const std::filesystem::path& folder);
    /// Goes to a path that a person typed: browses a folder, chooses a file.
    void go_to(const std::string& path);
    /// A file, or a folder of DICOM, for the browser's purpose.
    void take(const std::filesystem::path& path);

  private:
    std::string program(const char* name) const { return (places_.programs / name).string(); }
    void attempt(const std::function<void()>& act);
    void open_page(const std::filesystem::path& page);
    void look_at_scan(bool is_another_scan);
    void look_at_home();
    bool look_after_others_sessions();
    void take_in_look(const std::string& said);
    void end_of_work();

    StartPlaces places_;
    View view_ = View::cases;
    std::string message_;
    std::vector<ShelvedCase> cases_;
    std::vector<KeptSession> sessions_;
    std::chrono::steady_clock::time_point listed_{};      // the sessions
    std::vector<std::unique_ptr<ChildProgram>> players_;  // close with this window
    FolderListing listing_;
    std::string wrong_path_;              // written last, and not there
    std::optional<std::size_t> clicked_;  // the card

    enum class Work { look, import, compare, report };
    Work work_ = Work::look;
    bool is_another_scan_ = false;
    ImportForm form_before_{};  // whose files could be read
    std::string wrong_with_form() const;
    void show_error_of_form(std::string error);
    std::string form_error_;          ///< as message() says it, until the form changes
    ImportForm wrong_form_{};         ///< which it is about
    std::filesystem::path reported_;  ///< whose report is being made
    std::unique_ptr<ChildProgram> worker_;
    std::filesystem::path scratch_;  // the preview's under way
    std::optional<ScanPreview> look_;
    std::chrono::steady_clock::time_point began_looking_{};
    std::shared_ptr<const ScanVoxels> voxels_;  // a count under way has them, too
    std::uint64_t voxels_number_ = 0;

    void look_for_address();

    /// The region of a scan, and its threshold, that a count of loose parts belongs to.
    struct CountOf {
        std::uint64_t voxels_number = 0;
        ScanBox region{};
        double threshold_hu = 0.0;

        bool operator==(const CountOf&) const = default;
    };
    CountOf count_wanted() const { return {voxels_number_, form.region, form.threshold_hu}; }
    bool count_loose_parts();

    CountOf counted_of_;  // by the count under way, or the one before
    std::optional<LooseParts> counted_;
    std::future<LooseParts> count_;

    /// The last session is over, and its program still writes the report.
    bool is_report_written() const;
    bool poll_reports();

    std::unique_ptr<ChildProgram> server_;
    std::vector<std::unique_ptr<ChildProgram>> reporting_;  // write reports of sessions before
    bool has_address_ = false;                              // it has said where it listens
    std::optional<ListenAddress> server_is_at_;
    bool is_drawn_ = false;       // the session's bone, by the window
    bool is_broken_off_ = false;  // the session, by a person
    std::filesystem::path report_folder_;
    std::filesystem::path look_file_;
    std::optional<std::filesystem::path> report_;
    std::unique_ptr<ChildProgram> opener_;
    std::string opened_;  // by it
};

}  // namespace osteomill
