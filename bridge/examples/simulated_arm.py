#!/usr/bin/env python3
"""The simulated arm of simulated_arm.c with nothing but Python's standard library: docs/device-bridge.md in code.
    python3 simulated_arm.py udp:127.0.0.1:7020 [KEY_FILE] [SECONDS]"""
import hashlib, hmac, math, os, secrets, socket, struct, sys, time

HELLO, WELCOME, POSE, FORCE, GOODBYE = range(1, 6)
MAX_FORCE_N, TICK_S, MASS_KG = 3.3, 0.001, 0.05


def open_link(address):
    kind, _, where = address.partition(":")
    if kind == "unix":
        link = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        link.bind("")  # a name of its own, which Linux chooses
        server = where
    else:
        host, _, port = where.rpartition(":")
        found = socket.getaddrinfo(host.strip("[]"), int(port), type=socket.SOCK_DGRAM)[0]
        link, server = socket.socket(found[0], found[1]), found[4]
    link.setblocking(False)
    return link, server


class Arm:
    def __init__(self, address, key_file):
        self.link, self.server = open_link(address)
        self.key = open(key_file, "rb").read() if key_file else b""
        self.session = self.sequence = self.heard = self.heard_clock = self.echo_clock = 0
        self.nonce, self.arrived, self.trust, self.force = secrets.randbits(64), 0, 0.0, (0.0,) * 3

    def tag(self, message):
        return hmac.new(self.key, message, hashlib.sha256).digest()[:16] if self.key else bytes(16)

    def say(self, kind, body):
        self.sequence += 1
        head = struct.pack("<4sHHQQQ", b"OSMB", 1, kind, self.session, self.sequence, time.monotonic_ns())
        message = (head + body).ljust(176, b"\0")
        try:
            self.link.sendto(message + self.tag(message), self.server)
        except OSError:
            pass  # as good as lost on the way: the server is not there yet

    def hear(self, message, now):
        if len(message) != 192 or not hmac.compare_digest(self.tag(message[:176]), message[176:]):
            return
        magic, version, kind, session, sequence, clock = struct.unpack_from("<4sHHQQQ", message)
        if (magic, version) != (b"OSMB", 1):
            return
        if kind == WELCOME and not self.session and struct.unpack_from("<Q", message, 32)[0] == self.nonce:
            self.session, self.heard, self.heard_clock, self.arrived = session, sequence, clock, now
        elif session == self.session and sequence > self.heard and kind == FORCE:
            self.heard, self.heard_clock, self.arrived = sequence, clock, now
            off, self.echo_clock = struct.unpack_from("<I12xQ", message, 80)
            self.force = (0.0,) * 3 if off else struct.unpack_from("<3d", message, 32)

    def exchange(self, position, velocity, pedal):
        """Says where the arm is; the force that it is to give now: safe, whatever has come."""
        now = time.monotonic_ns()
        try:
            while True:
                self.hear(self.link.recv(193), now)
        except OSError:
            pass
        if self.session and now - self.arrived > 250_000_000:
            self.session, self.nonce = 0, secrets.randbits(64)
        if not self.session:
            if now > self.arrived + 20_000_000:
                self.arrived = now
                self.say(HELLO, struct.pack("<Q16s14d", self.nonce, b"python arm", MAX_FORCE_N, 0, 1.5, MASS_KG, 0,
                                            -80, -60, -35, 80, 60, 35, 0, 0, 0))
            return (0.0,) * 3
        self.say(POSE, struct.pack("<10dIIQQQ", *position, 1, 0, 0, 0, *velocity, int(pedal), 1 | 2, self.heard,
                                   self.heard_clock, now - self.arrived))
        fresh = min(1.0, max(0.0, (50e6 - (now - self.echo_clock)) / 45e6))
        self.trust = min(fresh, self.trust + 10 * TICK_S)
        length = math.sqrt(sum(f * f for f in self.force))
        if not math.isfinite(length):
            return (0.0,) * 3
        return tuple(f * self.trust * min(1.0, MAX_FORCE_N / length if length else 1.0) for f in self.force)


def main():
    arm = Arm(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else None)
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else math.inf
    position, velocity, peak, ticks, running = [0.0] * 3, [0.0] * 3, 0.0, 0, 0
    began = due = time.perf_counter()
    while due - began < seconds:
        t = running * TICK_S
        stroke = t % 10  # down, and up again
        force = arm.exchange(position, velocity, 0.5 < stroke < 9.0)
        running += bool(arm.session)
        ticks += 1
        peak = max(peak, math.hypot(*force))
        down = -0.5 * stroke if stroke < 8 else min(-4 * (9 - stroke), 0.0)
        hand = (8 * (t % 1) - 2 if t % 1 < 0.5 else 6 - 8 * (t % 1), 0.0, down)
        for i in range(3):
            pull = 0.5 * (hand[i] - position[i]) + force[i] - 0.005 * velocity[i]
            velocity[i] += 1000 * pull / MASS_KG * TICK_S
            position[i] += velocity[i] * TICK_S
        due += TICK_S
        while time.perf_counter() < due:
            time.sleep(max(0.0, due - time.perf_counter() - 0.0002))
    print(f"{ticks} exchanges in {time.perf_counter() - began:.2f} s, {running} with a session; largest force {peak:.2f} N")
    arm.say(GOODBYE, b"")


main()
