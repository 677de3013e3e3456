// Any arm that CHAI3D drives, by its device class.
//     g++ -std=c++11 chai3d_arm.cpp -I CHAI3D/src -lchai3d -o chai3d_arm && ./chai3d_arm udp:127.0.0.1:7020 [KEY_FILE]
// Written against the published interface (CHAI3D 3.2, cGenericHapticDevice); compiled here against stubs of it.
// Device space is CHAI3D's: x to the user, y to the right, z up; metres there, mm here.
#include "../osteomill_bridge.h"

#include <chai3d.h>

#include <chrono>
#include <csignal>
#include <thread>

static volatile std::sig_atomic_t ends = 0;

int main(int argc, char** argv) {
    chai3d::cHapticDeviceHandler handler;
    chai3d::cGenericHapticDevicePtr device;
    handler.getDevice(device, 0);
    if (!device || !device->open()) {
        std::fprintf(stderr, "CHAI3D finds no arm\n");
        return 1;
    }
    device->calibrate();
    const chai3d::cHapticDeviceInfo info = device->getSpecifications();
    omb_arm arm = {};
    std::snprintf(arm.name, sizeof arm.name, "%.15s", info.m_modelName.c_str());
    arm.max_force_n = info.m_maxLinearForce;
    arm.max_torque_n_mm = info.m_actuatedRotation ? 1000.0 * info.m_maxAngularTorque : 0.0;
    arm.max_stiffness_n_per_mm = 0.001 * info.m_maxLinearStiffness;
    arm.apparent_mass_kg = 0.1;  // CHAI3D does not know; see your arm's data sheet
    for (int axis = 0; axis < 3; ++axis) {
        arm.workspace_max_mm[axis] = 1000.0 * info.m_workspaceRadius;
        arm.workspace_min_mm[axis] = -arm.workspace_max_mm[axis];
    }
    omb_link link;
    if (argc < 2 || omb_open(&link, argv[1], argc > 2 ? argv[2] : nullptr, &arm) != 0) {
        std::fprintf(stderr, "%s\n", argc < 2 ? "usage: chai3d_arm udp:HOST:PORT|unix:PATH [KEY_FILE]" : link.error);
        return 2;
    }
    std::signal(SIGINT, [](int) { ends = 1; });
    auto next = std::chrono::steady_clock::now();
    while (!ends) {
        chai3d::cVector3d position, velocity;
        chai3d::cMatrix3d turn;
        unsigned int buttons = 0;
        device->getPosition(position);
        device->getLinearVelocity(velocity);
        device->getRotation(turn);
        device->getUserSwitches(buttons);
        omb_pose pose = {};
        double rotation[3][3];
        for (int row = 0; row < 3; ++row) {
            pose.position_mm[row] = 1000.0 * position(static_cast<unsigned>(row));
            pose.velocity_mm_per_s[row] = 1000.0 * velocity(static_cast<unsigned>(row));
            for (int column = 0; column < 3; ++column)
                rotation[row][column] = turn(static_cast<unsigned>(row), static_cast<unsigned>(column));
        }
        omb_quaternion(rotation, pose.quaternion);
        pose.status = OMB_READY | OMB_HAS_VELOCITY;
        if (info.m_sensedRotation) pose.status |= OMB_HAS_ORIENTATION;
        pose.buttons = buttons & (OMB_PEDAL | OMB_NEXT_BURR);
        omb_force force;
        omb_exchange(&link, &pose, &force);
        const double* n = force.force_n;
        const double* n_mm = force.torque_n_mm;
        device->setForceAndTorque(chai3d::cVector3d(n[0], n[1], n[2]),
                                  chai3d::cVector3d(0.001 * n_mm[0], 0.001 * n_mm[1], 0.001 * n_mm[2]));
        next += std::chrono::milliseconds(1);
        std::this_thread::sleep_until(next);
    }
    device->close();
    omb_close(&link);
}
