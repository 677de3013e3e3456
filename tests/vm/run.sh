# In the virtual machine: an arm on /dev/uhid and the server that drives it through hidraw.
uhid_arm vm_arm.toml scene.toml trajectory.csv garbage@4.5-4.6,unplug@6.2-7.3 out/arm.csv >out/arm.txt 2>&1 &
arm=$!
sleep 0.2
haptic_server --list-devices >out/devices.txt 2>&1
haptic_server --device hid --device-profile vm_arm.toml --scene scene.toml --listen none --milling-rate-hz 250 \
    --duration-s 12 --log-csv out/server.csv --json out/server.json >out/server.txt 2>&1
echo $? >out/exit_code
kill $arm
wait $arm
