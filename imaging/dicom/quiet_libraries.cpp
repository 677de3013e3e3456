#include "imaging/dicom/quiet_libraries.h"

#include <fcntl.h>
#include <gdcmTrace.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace osteomill {

QuietLibraries::QuietLibraries() {
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    gdcm::Trace::DebugOff();
    std::cerr.flush();
    std::fflush(stderr);
    standard_error_ = ::dup(STDERR_FILENO);
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (standard_error_ >= 0 && nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) ::close(nowhere);
}

QuietLibraries::~QuietLibraries() {
    std::cerr.flush();
    std::fflush(stderr);
    if (standard_error_ < 0) return;
    ::dup2(standard_error_, STDERR_FILENO);
    ::close(standard_error_);
}

}  // namespace osteomill
