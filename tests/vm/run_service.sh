# In the virtual machine: systemd, the first process of a container, starts the server as scripts/systemd/osteomill.service says, for
# an arm on /dev/uhid. The rest of a system is not there; the parts that the unit needs are made here.
mkdir -p /etc/systemd/system/osteomill.service.d /usr/local/bin /var/lib /var/tmp /home /root /run /sys/fs/cgroup
chmod 755 / /trial
mount -t tmpfs none /run
mount -t cgroup2 none /sys/fs/cgroup
printf 'root:x:0:0::/:/bin/sh\nosteomill:x:900:900::/:/bin/sh\n' >/etc/passwd
printf 'root:x:0:\nplugdev:x:46:\nosteomill:x:900:\n' >/etc/group
echo 0123456789abcdef0123456789abcdef >/etc/machine-id
ln -s /bin/haptic_server /usr/local/bin/haptic_server
if [ -e /bin/systemd-executor ]; then
    mkdir -p /usr/lib/systemd
    cp /bin/systemd-executor /usr/lib/systemd/
fi
cp osteomill.service /etc/systemd/system/
cat >/etc/systemd/system/osteomill.service.d/trial.conf <<'UNIT'
[Unit]
DefaultDependencies=no
SuccessAction=exit-force
FailureAction=exit-force
[Service]
ExecStart=
ExecStart=/usr/local/bin/haptic_server --device hid --device-profile /trial/vm_arm.toml --scene /trial/scene.toml \
    --listen 127.0.0.1:0 --milling-rate-hz 250 --duration-s 4 --json server.json
StandardOutput=file:/trial/out/server.txt
StandardError=inherit
ExecStopPost=+/bin/busybox sh -c 'echo "$SERVICE_RESULT $EXIT_STATUS" >/trial/out/result.txt'
UNIT

uhid_arm vm_arm.toml scene.toml trajectory.csv "" out/arm.csv >out/arm.txt 2>&1 &
arm=$!
sleep 0.2
# Does the work of scripts/udev/70-osteomill.rules.
chgrp plugdev /dev/hidraw0
chmod 660 /dev/hidraw0
unshare -p -f -m --mount-proc env -i container=trial PATH=/bin \
    systemd --system --unit=osteomill.service --log-target=console --show-status=no >out/systemd.txt 2>&1
cp /var/lib/osteomill/server.json out/
ls -ln /var/lib/osteomill >out/state.txt
kill $arm
wait $arm
