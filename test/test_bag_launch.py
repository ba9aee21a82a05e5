#!/usr/bin/env python3
"""bag.launch on a bag whose topics have other names and whose tf_static is not latched: grids come,
also after the bag has started again, and whoever listens late still gets the static transform."""
import array
import math
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import rosbag
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from pilothouse.msg import FloorGrid
from sensor_msgs.msg import CameraInfo, Image
from tf2_msgs.msg import TFMessage

WIDTH, HEIGHT, FOCAL = 320, 240, 262.5
CAMERA_HEIGHT, PITCH = 0.65, math.radians(26)
FIRST, SECONDS, RATE = 1500000000, 2, 10
DEADLINE = 60.0  # s


def floor_image():
    """Depth of a level floor: the same along a row."""
    image = Image(height=HEIGHT, width=WIDTH, encoding='16UC1', step=2 * WIDTH)
    pixels = array.array('H')
    for row in range(HEIGHT):
        down = math.sin(PITCH) + (row - (HEIGHT - 1) / 2) / FOCAL * math.cos(PITCH)
        depth = CAMERA_HEIGHT / down if down > 0.05 else 0.0
        pixels.extend([int(depth * 1000 + 0.5)] * WIDTH)
    image.data = pixels.tobytes()
    return image


def camera_pose():
    """base_link -> eye: pitched down, then to the optical axes."""
    pose = TransformStamped()
    pose.header.frame_id, pose.child_frame_id = 'base_link', 'eye'
    pose.transform.translation.z = CAMERA_HEIGHT
    c, s = math.cos(PITCH / 2) / 2, math.sin(PITCH / 2) / 2
    rotation = pose.transform.rotation  # about y by PITCH, times (-1/2, 1/2, -1/2, 1/2)
    rotation.x, rotation.y, rotation.z, rotation.w = -c - s, c + s, -c + s, c - s
    return pose


def write_bag(path):
    image, info = floor_image(), CameraInfo(height=HEIGHT, width=WIDTH)
    info.K = [FOCAL, 0, (WIDTH - 1) / 2, 0, FOCAL, (HEIGHT - 1) / 2, 0, 0, 1]
    with rosbag.Bag(path, 'w') as bag:
        bag.write('/tf_static', TFMessage([camera_pose()]), rospy.Time(FIRST))
        for i in range(SECONDS * RATE):
            stamp = rospy.Time(FIRST, 0) + rospy.Duration(i / RATE)
            for message, topic in ((info, '/my_cam/info'), (image, '/my_cam/depth')):
                message.header.stamp, message.header.frame_id = stamp, 'eye'
                bag.write(topic, message, stamp)


class BagLaunch(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix='bag with spaces ')
        bag = os.path.join(self.folder.name, 'floor.bag')
        write_bag(bag)
        self.launch = subprocess.Popen(
            ['roslaunch', 'pilothouse', 'bag.launch', 'bag:=' + bag,
             'depth_topic:=/my_cam/depth', 'info_topic:=/my_cam/info'], start_new_session=True)

    def tearDown(self):
        self.launch.send_signal(signal.SIGINT)
        self.launch.wait(DEADLINE)
        self.folder.cleanup()

    def test_grids_come_over_and_over(self):
        grids, looped = [], threading.Event()

        def take(grid):
            grids.append(grid)
            stamps = [g.header.stamp for g in grids]
            if sum(1 for a, b in zip(stamps, stamps[1:]) if b < a) >= 2:
                looped.set()

        subscriber = rospy.Subscriber('floor_grid', FloorGrid, take, queue_size=100)
        self.assertTrue(looped.wait(DEADLINE), '%d grids came' % len(grids))
        subscriber.unregister()
        last = grids[-1]
        kinds = bytearray(last.classes)
        self.assertGreater(kinds.count(FloorGrid.FLOOR), 300)
        self.assertEqual(kinds.count(FloorGrid.OBSTACLE), 0)
        late = []
        heard = threading.Event()
        rospy.Subscriber('/tf_static', TFMessage, lambda m: (late.append(m), heard.set()))
        self.assertTrue(heard.wait(DEADLINE))
        self.assertEqual(late[0].transforms[0].child_frame_id, 'eye')


if __name__ == '__main__':
    # Wall time: the deadlines must not depend on the bag's clock.
    rospy.init_node('test_bag_launch')
    rostest.rosrun('pilothouse', 'bag_launch', BagLaunch, sys.argv)
