// The part of CHAI3D that chai3d_arm.cpp uses, so that it is compiled without it. No code of its authors.
#pragma once

#include <memory>
#include <string>

namespace chai3d {

class cVector3d {
  public:
    cVector3d() = default;
    cVector3d(double x, double y, double z);
    double& operator()(unsigned int index);
    const double& operator()(unsigned int index) const;
};

class cMatrix3d {
  public:
    double& operator()(unsigned int row, unsigned int column);
    const double& operator()(unsigned int row, unsigned int column) const;
};

struct cHapticDeviceInfo {
    std::string m_modelName;
    double m_maxLinearForce;
    double m_maxAngularTorque;
    double m_maxLinearStiffness;
    double m_workspaceRadius;
    bool m_sensedRotation;
    bool m_actuatedRotation;
};

class cGenericHapticDevice {
  public:
    virtual ~cGenericHapticDevice() = default;
    virtual bool open() = 0;
    virtual bool close() = 0;
    virtual bool calibrate(bool force = false) = 0;
    virtual bool getPosition(cVector3d& position) = 0;
    virtual bool getLinearVelocity(cVector3d& velocity) = 0;
    virtual bool getRotation(cMatrix3d& rotation) = 0;
    virtual bool getUserSwitches(unsigned int& switches) = 0;
    virtual bool setForceAndTorque(const cVector3d& force, const cVector3d& torque) = 0;
    virtual cHapticDeviceInfo getSpecifications() = 0;
};

using cGenericHapticDevicePtr = std::shared_ptr<cGenericHapticDevice>;

class cHapticDeviceHandler {
  public:
    cHapticDeviceHandler();
    bool getDevice(cGenericHapticDevicePtr& device, unsigned int index = 0);
};

}  // namespace chai3d
