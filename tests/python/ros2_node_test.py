"""The node of ROS 2: its conversions, and the node itself against stand-ins for rclpy, which is not in Debian."""

import importlib.util
import pathlib
import sys
import types
import unittest
from types import SimpleNamespace
from unittest import mock

import numpy as np
from support import tooth

EXAMPLE = pathlib.Path(__file__).parents[2] / "python" / "examples" / "ros2_node.py"
spec = importlib.util.spec_from_file_location("ros2_node", EXAMPLE)
ros2_node = importlib.util.module_from_spec(spec)
spec.loader.exec_module(ros2_node)


def members(names):
    return SimpleNamespace(**dict.fromkeys(names, 0.0))


def pose_message():
    return SimpleNamespace(position=members("xyz"), orientation=members("xyzw"))


def stamped(**parts):
    return SimpleNamespace(header=SimpleNamespace(stamp=None, frame_id=""), **parts)


class Ros2NodeTest(unittest.TestCase):
    def test_an_axis_is_there_and_back_a_quaternion(self):
        rng = np.random.default_rng(3)
        for axis in (*rng.normal(size=(50, 3)), [0, 0, 1], [0, 0, -1], [0, 1e-8, -1], [1, 0, 0]):
            axis = np.array(axis) / np.linalg.norm(axis)
            q = ros2_node.quaternion_of(axis)
            self.assertAlmostEqual(np.linalg.norm(q), 1.0)
            np.testing.assert_allclose(ros2_node.axis_of(SimpleNamespace(**dict(zip("xyzw", q)))), axis, atol=1e-7)

    def test_a_quarter_turn_about_y_takes_z_to_x(self):
        np.testing.assert_allclose(ros2_node.quaternion_of([1, 0, 0]), [0, np.sqrt(0.5), 0, np.sqrt(0.5)])

    def test_messages_are_in_metres_and_newton_metres(self):
        pose = pose_message()
        ros2_node.fill_pose(pose, [1000.0, -20.0, 3.0], [0.0, 0.6, 0.8])
        self.assertEqual((pose.position.x, pose.position.y, pose.position.z), (1.0, -0.02, 0.003))
        position_mm, axis = ros2_node.hand_of(pose)
        np.testing.assert_allclose(position_mm, [1000.0, -20.0, 3.0])
        np.testing.assert_allclose(axis, [0.0, 0.6, 0.8], atol=1e-12)
        wrench = SimpleNamespace(force=members("xyz"), torque=members("xyz"))
        ros2_node.fill_wrench(wrench, [1, 2, 3], [4, 5, 6])
        self.assertEqual((wrench.force.z, wrench.torque.z), (3.0, 0.006))

    def test_the_node_mills_what_the_hand_says(self):
        heard, published, timers = {}, [], []
        node = SimpleNamespace(
            create_subscription=lambda kind, name, callback, depth: heard.update({name: callback}),
            create_publisher=lambda kind, name, depth: SimpleNamespace(publish=lambda message: published.append((name, message))),
            create_timer=lambda period_s, callback: timers.append((period_s, callback)),
            get_clock=lambda: SimpleNamespace(now=lambda: SimpleNamespace(to_msg=lambda: "now")))

        def spin(_):
            heard["pedal"](SimpleNamespace(data=True))
            for depth_mm in np.linspace(0.0, 4.0, 150):
                message = pose_message()
                ros2_node.fill_pose(message, tooth().start_mm - depth_mm * tooth().start_axis, tooth().start_axis)
                heard["hand"](SimpleNamespace(pose=message))
                timers[0][1]()

        modules = {"rclpy": dict(init=lambda: None, create_node=lambda name: node, spin=spin), "geometry_msgs": {},
                   "geometry_msgs.msg": dict(PoseStamped=lambda: stamped(pose=pose_message()),
                                             WrenchStamped=lambda: stamped(wrench=SimpleNamespace(force=members("xyz"), torque=members("xyz")))),
                   "sensor_msgs": {}, "sensor_msgs.msg": dict(Joy=lambda: stamped(buttons=[])),
                   "std_msgs": {}, "std_msgs.msg": dict(Bool=None, Float64=lambda data: SimpleNamespace(data=data))}
        fakes = {name: types.ModuleType(name) for name in modules}
        for name, module in fakes.items():
            vars(module).update(modules[name])
        with mock.patch.dict(sys.modules, fakes), mock.patch.object(sys, "argv", ["ros2_node.py"]):
            ros2_node.main()
        last = dict(published[-4:])
        self.assertEqual(set(last), {"burr", "force", "removed_mm3", "buttons"})
        self.assertEqual(len(published), 4 * 150)
        self.assertEqual(timers[0][0], 0.01)
        self.assertGreater(last["removed_mm3"].data, 0.5)
        self.assertEqual(last["buttons"].buttons, [1, 0, 0])
        self.assertEqual((last["burr"].header.frame_id, last["burr"].header.stamp), ("patient_lps", "now"))
        burr_mm, axis = ros2_node.hand_of(last["burr"].pose)
        np.testing.assert_allclose(axis, tooth().start_axis, atol=1e-9)
        self.assertLess(np.linalg.norm(burr_mm - (tooth().start_mm - 4.0 * tooth().start_axis)), 1.5)
        force = last["force"].wrench.force
        self.assertGreater(np.linalg.norm([force.x, force.y, force.z]), 0.05)


if __name__ == "__main__":
    unittest.main()
