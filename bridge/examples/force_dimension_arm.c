/* Force Dimension's omega, delta and sigma, and Novint's Falcon, by the DHD interface of the Force Dimension SDK.
 *     gcc -std=c99 force_dimension_arm.c -ldhd -lpthread -lusb-1.0 -o arm && ./arm udp:127.0.0.1:7020 [KEY_FILE]
 * Written against the published interface (Force Dimension SDK, DHD reference); compiled here against stubs of it.
 * Device space is DHD's: x to the user, y to the right, z up; metres there, mm here.
 */
#include "../osteomill_bridge.h"

#include <dhdc.h>

int main(int argc, char** argv) {
    /* An omega.6; its wrist is sensed, not actuated: torque 0. Take the figures of yours from its data sheet. */
    omb_arm arm = {"Force Dimension", 12.0, 0.0, 5.0, 0.2, 0.01, {-80, -80, -55}, {80, 80, 55}, {0, 0, 0}, 0};
    omb_link link;
    if (argc < 2 || omb_open(&link, argv[1], argc > 2 ? argv[2] : NULL, &arm) != 0) {
        fprintf(stderr, "%s\n", argc < 2 ? "usage: force_dimension_arm udp:HOST:PORT|unix:PATH [KEY_FILE]" : link.error);
        return 2;
    }
    if (dhdOpen() < 0) {
        fprintf(stderr, "the arm cannot be opened: %s\n", dhdErrorGetLastStr());
        return 1;
    }
    dhdEnableForce(DHD_ON);
    puts("q ends");
    while (!(dhdKbHit() && dhdKbGet() == 'q')) {
        const double mm_per_m = 1000.0;
        double m[3] = {0.0, 0.0, 0.0}, m_per_s[3] = {0.0, 0.0, 0.0}, rotation[3][3];
        omb_pose pose;
        omb_force force;
        int axis;
        memset(&pose, 0, sizeof pose);
        if (dhdGetPositionAndOrientationFrame(&m[0], &m[1], &m[2], rotation) < 0 ||
            dhdGetLinearVelocity(&m_per_s[0], &m_per_s[1], &m_per_s[2]) < 0)
            break;
        for (axis = 0; axis < 3; ++axis) {
            pose.position_mm[axis] = mm_per_m * m[axis];
            pose.velocity_mm_per_s[axis] = mm_per_m * m_per_s[axis];
        }
        pose.status = OMB_READY | OMB_HAS_VELOCITY;
        if (dhdHasWrist()) {
            omb_quaternion((const double(*)[3])rotation, pose.quaternion);
            pose.status |= OMB_HAS_ORIENTATION;
        }
        if (dhdGetButton(0) == DHD_ON) pose.buttons |= OMB_PEDAL;
        omb_exchange(&link, &pose, &force);
        /* DHD waits here for the arm, which answers up to 4000 times a second. */
        if (dhdSetForceAndTorque(force.force_n[0], force.force_n[1], force.force_n[2], 0.001 * force.torque_n_mm[0],
                                 0.001 * force.torque_n_mm[1], 0.001 * force.torque_n_mm[2]) < 0)
            break;
    }
    dhdEnableForce(DHD_OFF);
    dhdClose();
    omb_close(&link);
    return 0;
}
