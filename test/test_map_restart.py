#!/usr/bin/env python3
"""A room's map survives: saved, its manager killed with SIGKILL, loaded, equal. And by itself, while it is
killed at any moment. Bad files are refused and harm neither the map in use nor what is on the disk."""
import os
import random
import shutil
import signal
import struct
import sys
import threading
import time
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest
import tf2_msgs.msg
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid
from nav_msgs.srv import GetMap
from pilothouse.msg import FloorGrid, MapGrid
from pilothouse.srv import MapFile
from sensor_msgs.msg import CameraInfo, Image, PointCloud2
from std_srvs.srv import Trigger

DEADLINE = 60.0  # s, for what must happen
MANAGER = '/pilothouse_manager'
NAN = float('nan')


def process_of(node):
    try:
        address = rosgraph.Master(rospy.get_name()).lookupNode(node)
        return xmlrpc.client.ServerProxy(address).getPid(rospy.get_name())[2]
    except (OSError, rosgraph.MasterException):
        return None


class MapRestart(unittest.TestCase):
    def setUp(self):
        self.changed = threading.Condition()
        self.cells = self.grid = None
        self.folder = rospy.get_param('/mapper/folder')
        self.transforms = rospy.Publisher('/tf', tf2_msgs.msg.TFMessage, queue_size=10)
        self.floor = rospy.Publisher('floor_grid', FloorGrid, queue_size=4)
        self.subscribers = [rospy.Subscriber('map_cells', MapGrid, self.take, 'cells'),
                            rospy.Subscriber('map', OccupancyGrid, self.take, 'grid')]

    def tearDown(self):
        for subscriber in self.subscribers:
            subscriber.unregister()

    def take(self, message, name):
        with self.changed:
            setattr(self, name, message)
            self.changed.notify_all()

    def wait(self, condition, what):
        end = time.monotonic() + DEADLINE
        while not condition():
            self.assertLess(time.monotonic(), end, what)
            with self.changed:
                self.changed.wait(0.05)

    def show(self, seed, x=0.0, times=4):
        """A floor of random kinds, from a robot at (x, 0)."""
        choice = random.Random(seed)
        grid = FloorGrid()
        grid.info.resolution, grid.info.width, grid.info.height = 0.05, 40, 40
        grid.info.origin.position.x, grid.info.origin.position.y = 0.5, -1.0
        grid.info.origin.orientation.w = 1.0
        grid.classes = bytes(choice.choice([0, 1, 1, 2, 4]) for _ in range(1600))
        grid.heights = grid.deviations = [NAN] * 1600
        grid.header.frame_id = 'base_link'
        for _ in range(times):
            transform = TransformStamped()
            transform.header.stamp = grid.header.stamp = rospy.Time.now()
            transform.header.frame_id, transform.child_frame_id = 'map', 'base_link'
            transform.transform.translation.x = x
            transform.transform.rotation.w = 1.0
            self.transforms.publish(tf2_msgs.msg.TFMessage([transform]))
            self.floor.publish(grid)
            time.sleep(0.05)  # frames of a camera

    def known(self):
        return self.cells is not None and sum(1 for c in self.cells.classes if c) or 0

    def kinds(self):
        return set(bytearray(self.cells.classes))

    def kill(self):
        process = process_of(MANAGER)
        with self.changed:
            self.cells = self.grid = None
        os.kill(process, signal.SIGKILL)
        self.wait(lambda: process_of(MANAGER) not in (None, process), 'the manager never came back')
        self.wait(lambda: self.cells is not None and self.grid is not None, 'the map never came back')

    def call(self, service, name):
        rospy.wait_for_service(service, DEADLINE)
        return rospy.ServiceProxy(service, MapFile)(name)

    def learn(self, seed, x):
        before = self.known()

        def learnt():
            self.show(seed, x)
            return self.known() > before + 500
        self.wait(learnt, 'the map never grew from %d cells' % before)

    def settle(self):
        """Until the last frames on their way have come in, and what is published is what the mapper has: it
        publishes twice a second."""
        self.newest, self.since = None, 0.0
        self.wait(self.settled, 'an old map')

    def settled(self):
        newest = rospy.ServiceProxy('static_map', GetMap)().map.data
        if newest != self.newest:
            self.newest, self.since = newest, time.monotonic()
        if self.grid is None or self.grid.data != newest or time.monotonic() - self.since < 0.6:
            return False
        wanted = [-1 if v < 0 else 0 if v == 0 else 2 if v == 20 else 3 for v in newest]
        return [(-1, 0, 2, 3, 3)[c] for c in bytearray(self.cells.classes)] == wanted

    def same(self, one, other):
        self.assertTrue(one.classes == other.classes, 'other classes')  # a written difference takes minutes
        self.assertEqual((one.info.origin, one.info.width, one.info.resolution),
                         (other.info.origin, other.info.width, other.info.resolution))

    def test_1_saved_killed_loaded_equal(self):
        self.learn(1, 0.0)
        self.settle()
        answer = self.call('map/save', 'kept')
        self.assertTrue(answer.success, answer.message)
        self.settle()
        saved, grid = self.cells, self.grid
        self.assertEqual(self.kinds(), {0, 1, 2, 4}, 'thresholds and drop-offs are in the map')
        self.assertEqual(set(grid.data), {-1, 0, 20, 100})
        self.kill()
        self.learn(2, 3.0)  # another place, so that the map in use differs
        answer = self.call('map/load', 'kept')
        self.assertTrue(answer.success, answer.message)
        self.wait(lambda: self.cells.classes == saved.classes, 'the cells are not what was saved')
        self.wait(lambda: self.grid.data == grid.data, 'the grid is not what was saved')
        self.same(self.cells, saved)

    def test_2_survives_a_kill_by_itself(self):
        self.learn(3, 0.0)
        path = os.path.join(self.folder, 'room.phmap')
        self.wait(lambda: os.path.exists(path), 'never saved by itself')
        for kill in range(3):
            self.learn(4 + kill, 4.0 + 3.0 * kill)
            self.settle()
            # Ten times as long as it ever waits; it may have saved all of it before we looked.
            newest, begin = os.stat(path).st_ino, time.monotonic()
            self.wait(lambda: os.stat(path).st_ino != newest or time.monotonic() > begin + 10.0, 'never')
            self.settle()
            before = self.cells
            self.kill()
            self.same(self.cells, before)

    def test_3_bad_files_harm_nothing(self):
        self.learn(8, 0.0)
        self.settle()
        before = self.cells
        bad = {'short': b'PHMAP', 'noise': b'\xff' * 2000000}
        for name, data in bad.items():
            with open(os.path.join(self.folder, name + '.phmap'), 'wb') as file:
                file.write(data)
        with open(os.path.join(self.folder, 'nan.yaml'), 'w') as file:
            file.write('image: nan.pgm\nresolution: .nan\norigin: [0, 0, 0]\n')
        expected = {'short': 'expected at least 64', 'noise': 'expected that of a map',
                    'nan': 'resolution is nan', 'none': 'no such map', '../room': 'expected 1 to 64 letters'}
        for name, words in expected.items():
            answer = self.call('map/load', name)
            self.assertFalse(answer.success)
            self.assertIn(words, answer.message)
        answer = self.call('map/save', '../../escaped')
        self.assertFalse(answer.success)
        self.settle()
        self.same(self.cells, before)

    def look(self):
        """A wall 2 m before a camera that stands 0.8 m high."""
        picture, info, transform = Image(), CameraInfo(), TransformStamped()
        now = rospy.Time.now()
        for header in (picture.header, info.header):
            header.stamp, header.frame_id = now, 'wall_camera'
        picture.width, picture.height, picture.step, picture.encoding = 80, 60, 160, '16UC1'
        picture.data = (2000).to_bytes(2, 'little') * 4800
        info.width, info.height = 80, 60
        info.K = [65.0, 0.0, 39.5, 0.0, 65.0, 29.5, 0.0, 0.0, 1.0]
        info.P = [65.0, 0.0, 39.5, 0.0, 0.0, 65.0, 29.5, 0.0, 0.0, 0.0, 1.0, 0.0]
        transform.header.stamp = now
        transform.header.frame_id, transform.child_frame_id = 'map', 'wall_camera'
        transform.transform.translation.z = 0.8
        turn = transform.transform.rotation  # x right, y down, z ahead
        turn.x, turn.y, turn.z, turn.w = -0.5, 0.5, -0.5, 0.5
        self.transforms.publish(tf2_msgs.msg.TFMessage([transform]))
        self.info.publish(info)
        self.image.publish(picture)
        time.sleep(0.05)  # frames of a camera

    def filled(self):
        """Occupied volume that is published [voxels]."""
        if self.points is None:
            return 0
        edges = struct.unpack('<%df' % (len(self.points.data) // 4), self.points.data)[3::4]
        return sum(round(edge / 0.05) ** 3 for edge in edges)

    def test_5_the_volume_survives_a_kill_by_itself(self):
        self.image = rospy.Publisher('camera/depth/image_rect', Image, queue_size=2)
        self.info = rospy.Publisher('camera/depth/camera_info', CameraInfo, queue_size=2)
        self.points = None
        self.subscribers.append(rospy.Subscriber('volume_points', PointCloud2, self.take, 'points'))
        path = os.path.join(self.folder, 'room.bt')

        def learnt():
            self.look()
            return self.filled() > 300 and os.path.exists(path)
        self.wait(learnt, 'the wall was never learnt, or never saved by itself')
        answer = self.call('volume/save', '')  # all of it: nothing is shown any more
        self.assertTrue(answer.success, answer.message)
        learnt_before, self.points = self.filled(), None
        self.kill()
        self.wait(lambda: self.filled() >= 0.9 * learnt_before > 270, 'the wall never came back')

    def test_4_cleared(self):
        answer = rospy.ServiceProxy('map/clear', Trigger)()
        self.assertTrue(answer.success)
        self.wait(lambda: self.known() == 0, 'never empty')


if __name__ == '__main__':
    rospy.init_node('test_map_restart')
    try:
        rostest.rosrun('pilothouse', 'map_restart', MapRestart, sys.argv)
    finally:
        shutil.rmtree(rospy.get_param('/mapper/folder', '/nonexistent'), ignore_errors=True)
