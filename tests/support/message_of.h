// The message of an error that a test expects.
#pragma once

#include <string>
#include <utility>

namespace osteomill::testing {

/// The message of the Error that `work` throws; empty if it throws none.
template <typename Error, typename Work>
std::string message_of(Work&& work) {
    try {
        std::forward<Work>(work)();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace osteomill::testing
