/* An arm that is not there: a mass of 50 g that a simulated hand moves to and fro over the start, slowly down with
 * the pedal down and up again. For trying the bridge, and to copy from.
 *     gcc -std=c99 simulated_arm.c -o simulated_arm && ./simulated_arm udp:127.0.0.1:7020 [KEY_FILE] [SECONDS]
 */
#include "../osteomill_bridge.h"

#include <signal.h>

static volatile sig_atomic_t is_stopped = 0;

static void stop(int signal_number) {
    (void)signal_number;
    is_stopped = 1;
}

static void wait_until(uint64_t when_ns) {
    while (omb_now_ns() < when_ns) {
#ifndef _WIN32
        struct timespec nap = {0, 200000};
        if (omb_now_ns() + 300000u < when_ns) nanosleep(&nap, NULL);
#endif
    }
}

int main(int argc, char** argv) {
    const double mass_kg = 0.05, pull_n_per_mm = 0.5, damping_n_s_per_mm = 0.005, tick_s = 0.001;
    const double seconds = argc > 3 ? atof(argv[3]) : 1e9;
    const char* key_file = argc > 2 && argv[2][0] != 0 ? argv[2] : NULL;
    double hand_mm[3] = {0.0, 0.0, 0.0}, before_n[3] = {0.0, 0.0, 0.0}, peak_n = 0.0, jump_n = 0.0, fade_n = 0.0, trust = 0.0;
    uint64_t next_ns, running = 0, tick;
    omb_arm arm = {"simulated arm", 3.3, 0.0, 1.5, 0.05, 0.0, {-80, -60, -35}, {80, 60, 35}, {0, 0, 0}, 0};
    omb_pose pose;
    omb_force force;
    omb_link link;
    if (argc < 2 || omb_open(&link, argv[1], key_file, &arm) != 0) {
        fprintf(stderr, "%s\n", argc < 2 ? "usage: simulated_arm udp:HOST:PORT|unix:PATH [KEY_FILE] [SECONDS]" : link.error);
        return 2;
    }
    memset(&pose, 0, sizeof pose);
    pose.status = OMB_READY | OMB_HAS_VELOCITY;
    signal(SIGINT, stop);
    signal(SIGTERM, stop);
    next_ns = omb_now_ns();
    for (tick = 0; (double)tick * tick_s < seconds && !is_stopped; ++tick) {
        int axis;
        const omb_state state = omb_exchange(&link, &pose, &force);
        if (state == OMB_RUNNING) ++running;
        if (omb_length(force.force_n) > peak_n) peak_n = omb_length(force.force_n);
        for (axis = 0; axis < 3; ++axis) before_n[axis] = force.force_n[axis] - before_n[axis];
        if (omb_length(before_n) > jump_n) jump_n = omb_length(before_n);
        if (link.trust < 1.0 && link.trust <= trust && omb_length(before_n) > fade_n) fade_n = omb_length(before_n);
        trust = link.trust;
        memcpy(before_n, force.force_n, sizeof before_n);
        /* The hand wants to go to and fro by 2 mm, and every 10 s slowly 4 mm down and up to where it began: after
         * a fault the server gives no force before the burr was out of the bone, nor a spindle before the pedal was
         * up. */
        const double time_s = (double)running * tick_s, phase = time_s - (double)(int64_t)time_s;
        const double stroke_s = time_s - 10.0 * (double)(int64_t)(0.1 * time_s);
        hand_mm[0] = phase < 0.5 ? 8.0 * phase - 2.0 : 6.0 - 8.0 * phase;
        hand_mm[2] = stroke_s < 8.0 ? -0.5 * stroke_s : stroke_s < 9.0 ? -4.0 * (9.0 - stroke_s) : 0.0;
        for (axis = 0; axis < 3; ++axis) {
            const double hand_n = pull_n_per_mm * (hand_mm[axis] - pose.position_mm[axis]);
            const double all_n = hand_n + force.force_n[axis] - damping_n_s_per_mm * pose.velocity_mm_per_s[axis];
            pose.velocity_mm_per_s[axis] += 1000.0 * all_n / mass_kg * tick_s;
            pose.position_mm[axis] += pose.velocity_mm_per_s[axis] * tick_s;
        }
        pose.buttons = stroke_s > 0.5 && stroke_s < 9.0 ? OMB_PEDAL : 0;
        next_ns += 1000000u;
        wait_until(next_ns);
    }
    printf("%lu exchanges, %lu of them while the server answered; largest force %.3f N, largest jump %.3f N, "
           "while it goes %.3f N; refused %lu, out of order %lu\n",
           (unsigned long)tick, (unsigned long)running, peak_n, jump_n, fade_n, (unsigned long)link.refused,
           (unsigned long)link.out_of_order);
    omb_close(&link);
    return running > 0 ? 0 : 1;
}
