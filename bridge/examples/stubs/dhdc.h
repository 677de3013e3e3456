/* The part of the Force Dimension SDK that force_dimension_arm.c uses, to compile without it. No code of its maker. */
#ifndef STUB_DHDC_H
#define STUB_DHDC_H
#define DHD_ON 1
#define DHD_OFF 0
int dhdOpen(void);
int dhdClose(void);
int dhdHasWrist(void);
int dhdEnableForce(unsigned char state);
int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double rotation[3][3]);
int dhdGetLinearVelocity(double* x, double* y, double* z);
int dhdGetButton(int button);
int dhdSetForceAndTorque(double fx, double fy, double fz, double tx, double ty, double tz);
int dhdKbHit(void);
char dhdKbGet(void);
const char* dhdErrorGetLastStr(void);
#endif
