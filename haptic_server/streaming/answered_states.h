// Age of the news that a client's operator acts on: each input names the newest state frame that its
// client had seen, and this remembers when what those frames said was last true. So both directions of the
// link are measured by the server's clock alone: an input that was long under way and a client whose picture
// is old look alike, and neither may move the tool.
//
//     age of an answer = now - when the state that it answers was last true
//
// A state is true from when its frame was made for as long as there is nothing newer to tell: a tool that
// rests is sent ten times a second only. No sockets, no clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>

namespace osteomill {

class AnsweredStates {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// What answers older news moves nothing. A round trip of 200 ms and the time between two state frames
    /// fit in; a person at such a link still steers by what is there.
    static constexpr std::chrono::milliseconds longest_age{250};

    enum class Answer {
        fresh,
        stale,     ///< too old
        repeated,  ///< not numbered higher than one before: said twice, or overtaken
        unnamed,   ///< it names no state, as one that has seen none yet
        unsent,    ///< it names a state that has not been sent: no client that means well does that
    };

    /// A state frame of this number (they ascend) has been made.
    void sent(std::uint64_t number, Time now);
    /// There is nothing newer to tell than what was sent last.
    void still_true(Time now);

    /// An input of this number (from 1; they ascend) that names that state (0: none).
    Answer judge(std::uint64_t input_number, std::uint64_t state_number, Time now);
    /// Whether the last input was judged otherwise than those before; at first they count as fresh. Repeated
    /// ones do not count.
    bool is_news() const { return is_news_; }

  private:
    Answer judge_new(std::uint64_t state_number, Time now) const;

    struct State {
        std::uint64_t number = 0;
        Time true_until;
    };
    /// More are not kept, and count as old: a feed that has much to tell makes that many in a tenth of a
    /// second.
    static constexpr std::size_t most_kept = 1024;

    std::deque<State> states_;  // ascending; those that are too old go, but for the last
    std::uint64_t last_input_ = 0;
    Answer last_answer_ = Answer::fresh;
    bool is_news_ = false;
};

}  // namespace osteomill
