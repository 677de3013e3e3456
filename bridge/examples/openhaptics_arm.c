/* 3D Systems' Touch, Touch X, and the PHANToM Omni of before, by OpenHaptics' HD library.
 *     gcc -std=c99 openhaptics_arm.c -lHD -lHDU -o openhaptics_arm && ./openhaptics_arm udp:127.0.0.1:7020 [KEY_FILE]
 * Written against the published interface (OpenHaptics Programmer's Guide); compiled here against stubs of it.
 * Device space is HD's: x to the right, y up, z to the user, mm. The stylus's z axis is taken to point from the tip
 * to the hand; where yours does not, turn it here.
 */
#include "../osteomill_bridge.h"

#include <HD/hd.h>

typedef struct session {
    HHD device;
    omb_link link;
} session;

static HDCallbackCode HDCALLBACK tick(void* data) {
    session* now = (session*)data;
    HDdouble transform[16]; /* column by column */
    HDint buttons = 0;
    HDErrorInfo error;
    omb_pose pose;
    omb_force force;
    double rotation[3][3];
    int row, column;
    memset(&pose, 0, sizeof pose);
    hdBeginFrame(now->device);
    hdGetDoublev(HD_CURRENT_POSITION, pose.position_mm);
    hdGetDoublev(HD_CURRENT_VELOCITY, pose.velocity_mm_per_s);
    hdGetDoublev(HD_CURRENT_TRANSFORM, transform);
    hdGetIntegerv(HD_CURRENT_BUTTONS, &buttons);
    for (row = 0; row < 3; ++row)
        for (column = 0; column < 3; ++column) rotation[row][column] = transform[4 * column + row];
    omb_quaternion((const double(*)[3])rotation, pose.quaternion);
    if (buttons & HD_DEVICE_BUTTON_1) pose.buttons |= OMB_PEDAL;
    if (buttons & HD_DEVICE_BUTTON_2) pose.buttons |= OMB_NEXT_BURR;
    pose.status = OMB_READY | OMB_HAS_VELOCITY | OMB_HAS_ORIENTATION;
    omb_exchange(&now->link, &pose, &force);
    hdSetDoublev(HD_CURRENT_FORCE, force.force_n);
    hdEndFrame(now->device);
    return HD_DEVICE_ERROR(error = hdGetError()) ? HD_CALLBACK_DONE : HD_CALLBACK_CONTINUE;
}

int main(int argc, char** argv) {
    omb_arm arm = {"OpenHaptics", 3.3, 0.0, 1.3, 0.045, 0.055, {-80, -60, -35}, {80, 60, 35}, {0, 0, 0}, 0};
    HDErrorInfo error;
    session now;
    HDSchedulerHandle ticks;
    if (argc < 2 || omb_open(&now.link, argv[1], argc > 2 ? argv[2] : NULL, &arm) != 0) {
        fprintf(stderr, "%s\n", argc < 2 ? "usage: openhaptics_arm udp:HOST:PORT|unix:PATH [KEY_FILE]" : now.link.error);
        return 2;
    }
    now.device = hdInitDevice(HD_DEFAULT_DEVICE);
    if (HD_DEVICE_ERROR(error = hdGetError())) {
        fprintf(stderr, "the arm cannot be opened: %s\n", hdGetErrorString(error.errorCode));
        return 1;
    }
    hdEnable(HD_FORCE_OUTPUT);
    ticks = hdScheduleAsynchronous(tick, &now, HD_MAX_SCHEDULER_PRIORITY);
    hdStartScheduler();
    puts("ENTER ends");
    (void)getchar();
    hdStopScheduler();
    hdUnschedule(ticks);
    hdDisableDevice(now.device);
    omb_close(&now.link);
    return 0;
}
