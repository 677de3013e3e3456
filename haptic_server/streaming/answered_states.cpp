#include "haptic_server/streaming/answered_states.h"

#include <algorithm>

namespace osteomill {

void AnsweredStates::sent(std::uint64_t number, Time now) {
    states_.push_back({number, now});
    while (states_.size() > most_kept || now - states_.front().true_until > longest_age) states_.pop_front();
}

void AnsweredStates::still_true(Time now) {
    if (!states_.empty()) states_.back().true_until = now;
}

AnsweredStates::Answer AnsweredStates::judge(std::uint64_t input_number, std::uint64_t state_number,
                                             Time now) {
    is_news_ = false;
    if (state_number != 0 && input_number <= last_input_) return Answer::repeated;
    last_input_ = std::max(last_input_, input_number);
    const Answer answer = judge_new(state_number, now);
    is_news_ = answer != last_answer_;
    last_answer_ = answer;
    return answer;
}

AnsweredStates::Answer AnsweredStates::judge_new(std::uint64_t state_number, Time now) const {
    if (state_number == 0) return Answer::unnamed;
    if (states_.empty() || state_number > states_.back().number) return Answer::unsent;
    const auto state = std::ranges::lower_bound(states_, state_number, {}, &State::number);
    const bool is_fresh = state->number == state_number && now - state->true_until <= longest_age;
    return is_fresh ? Answer::fresh : Answer::stale;
}

}  // namespace osteomill
