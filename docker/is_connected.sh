#!/bin/sh
# Whether there is a connection to a TCP port of another machine. State 01 is ESTABLISHED.
port=$(printf '%04X' "$1")
cat /proc/net/tcp /proc/net/tcp6 2>/dev/null | grep -Eq "^ *[0-9]+: [0-9A-F]+:[0-9A-F]+ [0-9A-F]+:$port 01"
