// List of the clients that may move the tool: subjects of certificates, from a file.
//
// One a line, whole, in the form of RFC 2253, which `openssl x509 -in viewer.pem -noout -subject -nameopt
// RFC2253` prints; a certificate of scripts/make_lab_certificates.sh for `viewer` has the subject CN=viewer.
// Blank lines and those that begin with # are skipped.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace osteomill {

class OperatorList {
  public:
    /// Throws std::runtime_error, in one line with the line's number, for a file that cannot be read, is
    /// longer than a megabyte or names nobody, and for a line that is no subject.
    explicit OperatorList(const std::filesystem::path& file);

    /// `subject` in the same form; none of them is empty.
    bool names(const std::string& subject) const { return subjects_.contains(subject); }

  private:
    std::set<std::string> subjects_;
};

}  // namespace osteomill
