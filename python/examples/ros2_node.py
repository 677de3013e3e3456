#!/usr/bin/env python3
"""A node of ROS 2 that mills: the hand comes in by a topic, burr, force and removed volume go out, a hundred times a second.

    python3 ros2_node.py [CASE]

in    hand         geometry_msgs/PoseStamped   of the handpiece: the burr's centre; z from tip to shank
      pedal        std_msgs/Bool               down: the spindle turns
out   burr         geometry_msgs/PoseStamped   the same of the burr, which bone holds back
      force        geometry_msgs/WrenchStamped on the hand, about the burr's centre
      removed_mm3  std_msgs/Float64            since the session began
      buttons      sensor_msgs/Joy             spindle turns, touches a protected structure, force is off by a fault

All is in the frame "patient_lps" (x left, y back, z up), m, N and N m as REP 103 wants it. It needs rclpy, which is not in Debian: `source` a ROS first.
It steps a session of the module osteomill on its own virtual clock: for an arm that a hand holds use haptic_server, which is built to meet deadlines."""

import sys

import numpy as np

PERIOD_MS, FRAME = 10, "patient_lps"


def quaternion_of(axis):
    """x, y, z, w of the shortest rotation that takes z to a unit axis; of -z, half a turn about x."""
    x, y, z = axis
    q = np.array([-y, x, 0.0, 1.0 + z]) if z > -1.0 + 1e-12 else np.array([1.0, 0.0, 0.0, 0.0])
    return q / np.linalg.norm(q)


def axis_of(q):
    """The axis z turned by a quaternion with members x, y, z, w."""
    return np.array([2 * (q.x * q.z + q.y * q.w), 2 * (q.y * q.z - q.x * q.w), 1 - 2 * (q.x**2 + q.y**2)])


def put(message, **members):
    for name, value in members.items():
        setattr(message, name, float(value))


def fill_pose(pose, position_mm, axis):
    put(pose.position, **dict(zip("xyz", 1e-3 * np.asarray(position_mm))))
    put(pose.orientation, **dict(zip("xyzw", quaternion_of(axis))))


def fill_wrench(wrench, force_n, torque_nmm):
    put(wrench.force, **dict(zip("xyz", force_n)))
    put(wrench.torque, **dict(zip("xyz", 1e-3 * np.asarray(torque_nmm))))


def hand_of(pose):
    """Position in mm and axis of a message's pose."""
    return 1e3 * np.array([pose.position.x, pose.position.y, pose.position.z]), axis_of(pose.orientation)


def main():
    import rclpy
    from geometry_msgs.msg import PoseStamped, WrenchStamped
    from sensor_msgs.msg import Joy
    from std_msgs.msg import Bool, Float64

    import osteomill as om

    case = om.Case(sys.argv[1] if len(sys.argv) > 1 else "tooth")
    session = om.Session(case)
    hand = {"mm": case.start_mm, "axis": case.start_axis, "pedal": False}
    rclpy.init()
    node = rclpy.create_node("osteomill")
    node.create_subscription(PoseStamped, "hand", lambda message: hand.update(zip(("mm", "axis"), hand_of(message.pose))), 1)
    node.create_subscription(Bool, "pedal", lambda message: hand.update(pedal=message.data), 1)
    out = {name: node.create_publisher(kind, name, 10)
           for name, kind in (("burr", PoseStamped), ("force", WrenchStamped), ("removed_mm3", Float64), ("buttons", Joy))}

    def step():
        way = np.linspace(0.0, 1.0, PERIOD_MS + 1)[1:, None]
        now = session.now
        session.rollout(now.hand_mm + way * (hand["mm"] - now.hand_mm), hand["axis"], hand["pedal"])
        now, stamp = session.now, node.get_clock().now().to_msg()
        burr, force, removed, buttons = PoseStamped(), WrenchStamped(), Float64(data=now.removed_mm3["total"]), Joy()
        for message in (burr, force, buttons):
            message.header.stamp, message.header.frame_id = stamp, FRAME
        fill_pose(burr.pose, now.burr_mm, now.axis)
        fill_wrench(force.wrench, now.force_n, now.torque_nmm)
        buttons.buttons = [int(now.spindle_on), int(now.touches_protected), int(bool(now.fault))]
        for name, message in (("burr", burr), ("force", force), ("removed_mm3", removed), ("buttons", buttons)):
            out[name].publish(message)

    node.create_timer(1e-3 * PERIOD_MS, step)
    rclpy.spin(node)


if __name__ == "__main__":
    main()
