// A film in a file, made of pictures by the program ffmpeg.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <glm/vec2.hpp>

#include "common/files/atomic_file.h"
#include "render_client/volume/picture.h"

namespace osteomill {

class FilmFile {
  public:
    /// The ending of the name says which kind of film: .mp4, .mkv, .webm, ... Throws std::runtime_error with
    /// one line if there is no ffmpeg, and if the file cannot be.
    FilmFile(const std::filesystem::path& file, const glm::ivec2& size_px, int frames_per_s);
    /// Ends ffmpeg; a film that was not closed goes.
    ~FilmFile();
    FilmFile(const FilmFile&) = delete;
    FilmFile& operator=(const FilmFile&) = delete;

    /// The next picture, of the film's size. Throws std::runtime_error if ffmpeg takes no more.
    void add(const Picture& picture);
    /// Makes it the file. Throws std::runtime_error if ffmpeg could not.
    void close();

  private:
    bool end_program();
    [[noreturn]] void fail() const;

    AtomicFile file_;
    pid_t program_ = -1;
    int pipe_ = -1;        // into the program
    int complaints_ = -1;  // its standard error
};

}  // namespace osteomill
