// Silence of image libraries on standard error while they work: their complaints come back as one line of
// ours.
#pragma once

#include <exception>

namespace osteomill {

/// While it lives, GDCM warns nobody and file descriptor 2 leads nowhere (libjpeg prints on its own).
/// Standard error belongs to the whole process, so keep it brief, on one thread.
class QuietLibraries {
  public:
    QuietLibraries();
    ~QuietLibraries();
    QuietLibraries(const QuietLibraries&) = delete;
    QuietLibraries& operator=(const QuietLibraries&) = delete;

  private:
    int standard_error_ = -1;
};

/// Whether a step of GDCM's succeeds, which says false or throws if it does not.
template <typename Step>
bool quietly(const Step& step) {
    const QuietLibraries quiet;
    try {
        return step();
    } catch (const std::exception&) {
        return false;
    }
}

}  // namespace osteomill
