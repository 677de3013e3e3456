#include "simulation/loop/thread_priority.h"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

namespace osteomill {

bool ask_for_real_time(int priority) noexcept {
    prctl(PR_SET_TIMERSLACK, 1UL);
    sched_param parameters{};
    parameters.sched_priority = priority;
    return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
}

}  // namespace osteomill
