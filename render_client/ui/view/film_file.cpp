#include "render_client/ui/view/film_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/text/foreign_text.h"

namespace osteomill {

FilmFile::FilmFile(const std::filesystem::path& file, const glm::ivec2& size_px, int frames_per_s)
    : file_(file) {
    // Players take colours at half the resolution, which needs even sizes; a picture holds still lines and
    // letters, so little is given away to the coder.
    std::vector<std::string> command{"ffmpeg",
                                     "-loglevel",
                                     "error",
                                     "-xerror",  // else it ends well on a full disk
                                     "-f",
                                     "rawvideo",
                                     "-pixel_format",
                                     "rgb24",
                                     "-video_size",
                                     fmt::format("{}x{}", size_px.x, size_px.y),
                                     "-framerate",
                                     std::to_string(frames_per_s),
                                     "-i",
                                     "pipe:0",
                                     "-vf",
                                     "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                     "-pix_fmt",
                                     "yuv420p",
                                     "-crf",
                                     "18",
                                     "-y",
                                     file_.part().string()};
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);

    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::runtime_error(fmt::format("{}: {}", file.string(), std::strerror(errno)));
    complaints_ = ::memfd_create("ffmpeg", MFD_CLOEXEC);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    if (complaints_ >= 0) ::posix_spawn_file_actions_adddup2(&actions, complaints_, STDERR_FILENO);
    // A CTRL-C is this program's to answer.
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error = ::posix_spawnp(&program_, "ffmpeg", &actions, &attributes, arguments.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[0]);
    pipe_ = ends[1];
    if (error == 0) return;
    ::close(pipe_);
    ::close(complaints_);
    throw std::runtime_error(fmt::format(
        "{}: a film is made by the program ffmpeg, which cannot be run: {}; install Debian's package ffmpeg",
        file.string(), std::strerror(error)));
}

FilmFile::~FilmFile() {
    end_program();
    ::close(complaints_);
}

void FilmFile::add(const Picture& picture) {
    std::size_t done = 0;
    while (done < picture.rgb.size()) {
        const ssize_t written = ::write(pipe_, picture.rgb.data() + done, picture.rgb.size() - done);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) {
            end_program();  // and has said why
            fail();
        }
        done += static_cast<std::size_t>(written);
    }
}

void FilmFile::close() {
    if (!end_program()) fail();
    file_.commit();
}

/// Whether it ended well.
bool FilmFile::end_program() {
    if (pipe_ < 0) return false;
    ::close(std::exchange(pipe_, -1));
    int status = 0;
    while (::waitpid(program_, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void FilmFile::fail() const {
    std::array<char, 500> said{};
    const ssize_t bytes = ::pread(complaints_, said.data(), said.size(), 0);
    const std::string_view all(said.data(), bytes > 0 ? static_cast<std::size_t>(bytes) : 0);
    const std::string why = printable(std::string(all.substr(0, all.find('\n'))));
    throw std::runtime_error(
        fmt::format("{}: ffmpeg could not make it{}{}", file_.path().string(), why.empty() ? "" : ": ", why));
}

}  // namespace osteomill
