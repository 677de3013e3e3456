#!/bin/sh
# Whether something listens on a TCP port, without connecting: the server would log every look. State 0A is LISTEN.
port=$(printf '%04X' "$1")
cat /proc/net/tcp /proc/net/tcp6 2>/dev/null | grep -Eq "^ *[0-9]+: [0-9A-F]+:$port [0-9A-F]+:0000 0A"
