// Reason why a TLS connection failed, as a sentence about the other end ("it shows no certificate").
#pragma once

#include <openssl/ssl.h>

#include <boost/system/error_code.hpp>
#include <string>

namespace osteomill {

/// Why the handshake on `tls` ended with `error`.
std::string describe_handshake_failure(const SSL* tls, const boost::system::error_code& error);

/// Whether the other end sent a TLS alert: it is the one that refuses. With TLS 1.3 a client hears of that
/// only in place of the first data.
bool is_refusal(const boost::system::error_code& error);

/// Whether it would end the same way again with the same certificates at both ends.
bool is_about_certificates(const boost::system::error_code& error);

/// A description of any error of a stream.
std::string describe_stream_error(const boost::system::error_code& error);

}  // namespace osteomill
