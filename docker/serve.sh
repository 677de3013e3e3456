#!/bin/sh
# haptic_server with real-time priority where the container was given SYS_NICE (docker run --cap-add SYS_NICE), else
# without. A program whose file asks for a capability that its container lacks does not start, so there are two of it.
sys_nice=23
bounding=$((0x$(sed -n 's/^CapBnd:[[:space:]]*//p' /proc/self/status)))
if [ $((bounding >> sys_nice & 1)) -eq 1 ]; then
    exec /usr/local/lib/osteomill/haptic_server "$@"
fi
exec /usr/bin/haptic_server "$@"
