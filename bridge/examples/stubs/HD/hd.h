/* The part of OpenHaptics' HD interface that openhaptics_arm.c uses, to compile without it. No code of its maker. */
#ifndef STUB_HD_H
#define STUB_HD_H
#define HDCALLBACK
typedef unsigned int HHD;
typedef unsigned int HDenum;
typedef unsigned int HDerror;
typedef unsigned int HDCallbackCode;
typedef unsigned long HDSchedulerHandle;
typedef unsigned short HDushort;
typedef int HDint;
typedef double HDdouble;
typedef char HDchar;
typedef const HDchar* HDstring;
typedef struct { HDerror errorCode; int internalErrorCode; HHD hHD; } HDErrorInfo;
typedef HDCallbackCode(HDCALLBACK* HDSchedulerCallback)(void*);
#define HD_DEFAULT_DEVICE ((HDstring)0)
#define HD_SUCCESS 0x0000
#define HD_DEVICE_ERROR(X) (((X).errorCode) != HD_SUCCESS)
enum { HD_CALLBACK_DONE, HD_CALLBACK_CONTINUE };
enum { HD_CURRENT_BUTTONS = 0x2000, HD_CURRENT_POSITION = 0x2050, HD_CURRENT_VELOCITY = 0x2051,
       HD_CURRENT_TRANSFORM = 0x2052, HD_CURRENT_FORCE = 0x2700, HD_FORCE_OUTPUT = 0x4000 };
enum { HD_DEVICE_BUTTON_1 = 1, HD_DEVICE_BUTTON_2 = 2, HD_MAX_SCHEDULER_PRIORITY = 0xffff };
HHD hdInitDevice(HDstring name);
void hdDisableDevice(HHD device);
void hdEnable(HDenum what);
void hdBeginFrame(HHD device);
void hdEndFrame(HHD device);
void hdGetDoublev(HDenum what, HDdouble* values);
void hdGetIntegerv(HDenum what, HDint* values);
void hdSetDoublev(HDenum what, const HDdouble* values);
HDErrorInfo hdGetError(void);
HDstring hdGetErrorString(HDerror error);
void hdStartScheduler(void);
void hdStopScheduler(void);
HDSchedulerHandle hdScheduleAsynchronous(HDSchedulerCallback tick, void* data, HDushort priority);
void hdUnschedule(HDSchedulerHandle ticks);
#endif
