#!/usr/bin/env python3
"""The players as an operator meets them: files in, camera topics out, refusals in /diagnostics."""
import math
import os
import shutil
import struct
import sys
import tempfile
import threading
import unittest
import zlib

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from nodelet.srv import NodeletLoad, NodeletUnload
from sensor_msgs.msg import CameraInfo, Image, PointCloud2

DEADLINE = 60.0  # s


def pcd(points, width=None):
    """A binary PCD file; a width of its own makes it lie."""
    width = len(points) if width is None else width
    head = ("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH %d\nHEIGHT 1\n"
            "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA binary\n" % (width, width))
    return head.encode() + b"".join(struct.pack("<fff", *p) for p in points)


def png(width, height, depth_bits, rows):
    """A grey (16 bits) or RGB (8 bits) PNG of raw rows."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    colour_type = 0 if depth_bits == 16 else 2
    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth_bits, colour_type, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows))) +
            chunk(b"IEND", b""))


class Players(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for service in ("load_nodelet", "unload_nodelet"):
            rospy.wait_for_service("manager/" + service, DEADLINE)
        cls.load = staticmethod(rospy.ServiceProxy("manager/load_nodelet", NodeletLoad))
        cls.unload = staticmethod(rospy.ServiceProxy("manager/unload_nodelet", NodeletUnload))

    def setUp(self):
        self.changed = threading.Condition()
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.space = "/" + self._testMethodName
        self.diagnostics = []
        self.listen("/diagnostics", DiagnosticArray, self.diagnostics)

    def write(self, name, data):
        path = os.path.join(self.folder, name)
        with open(path, "wb") as file:
            file.write(data)
        return path

    def listen(self, topic, kind, messages):
        def keep(message):
            with self.changed:
                messages.append(message)
                self.changed.notify_all()
        subscriber = rospy.Subscriber(topic, kind, keep)
        self.addCleanup(subscriber.unregister)
        return messages

    def wait_for(self, done, what):
        deadline = rospy.get_time() + DEADLINE
        with self.changed:
            while not done():
                left = deadline - rospy.get_time()
                self.assertGreater(left, 0, "waited %g s for %s" % (DEADLINE, what))
                self.changed.wait(min(left, 0.1))

    def start(self, kind, **parameters):
        name = self.space + "/player"
        rospy.set_param(name, parameters)
        self.load(name=name, type="pilothouse/" + kind, remap_source_args=[],
                  remap_target_args=[], my_argv=[], bond_id="")
        self.addCleanup(self.unload, name)

    def refuses_to_start(self, kind, **parameters):
        try:
            self.start(kind, **parameters)
        except rospy.ServiceException:
            return True
        return False

    def statuses(self):
        return [s for array in self.diagnostics for s in array.status
                if s.name.startswith(self.space[1:]) or self.space in s.name]

    def test_clouds_of_good_files_only(self):
        good = [self.write("a.pcd", pcd([(1, 2, 3)])), self.write("b.pcd", pcd([(4, 5, math.nan)] * 2))]
        hostile = self.write("hostile.pcd", pcd([], width=4294967295))
        clouds = self.listen(self.space + "/camera/depth/points", PointCloud2, [])
        self.start("PcdPlayer", rate=50.0, files=[good[0], hostile, self.folder + "/missing.pcd", good[1]])
        self.wait_for(lambda: len(clouds) >= 5, "clouds")
        self.assertEqual([c.width for c in clouds[:5]], [1, 2, 1, 2, 1])
        self.assertEqual(struct.unpack("<fff", clouds[0].data[:12]), (1.0, 2.0, 3.0))
        self.assertEqual(clouds[0].header.frame_id, "camera_depth_optical_frame")
        stamps = [c.header.stamp for c in clouds]
        self.assertEqual(stamps, sorted(set(stamps)), "each cloud has a stamp of its own")
        self.wait_for(lambda: any("missing.pcd: no such file" in s.message for s in self.statuses()),
                      "the refusal in the diagnostics")

    def test_a_folder_once_in_order(self):
        for name, points in (("c.pcd", 3), ("a.pcd", 1), ("b.pcd", 2), ("notes.txt", 9)):
            self.write(name, pcd([(0, 0, 1)] * points))
        clouds = self.listen(self.space + "/camera/depth/points", PointCloud2, [])
        self.start("PcdPlayer", rate=50.0, loop=False, folder=self.folder, frame="elsewhere")
        self.wait_for(lambda: any(s.message == "played" for s in self.statuses()), "the end")
        self.wait_for(lambda: len(clouds) == 3, "three clouds")
        self.assertEqual([c.width for c in clouds], [1, 2, 3])
        self.assertEqual(clouds[0].header.frame_id, "elsewhere")

    def test_only_hostile_files_is_an_error(self):
        self.start("PcdPlayer", rate=50.0, files=[self.write("x.pcd", b"\x7fELF")])
        self.listen(self.space + "/camera/depth/points", PointCloud2, [])
        self.wait_for(lambda: any(s.level == 2 and "x.pcd" in s.message for s in self.statuses()),
                      "the error in the diagnostics")

    def test_depth_with_colour(self):
        self.write("camera.json", b'{"width": 2, "height": 2, "intrinsic_matrix":'
                                  b' [500, 0, 0, 0, 501, 0, 0.5, 0.25, 1]}')
        for i in range(2):
            self.write("%d_depth.png" % i, png(2, 2, 16, [struct.pack(">HH", 1000, 2000 + i)] * 2))
            self.write("%d_color.png" % i, png(2, 2, 8, [bytes([255, 0, 10 * i] * 2)] * 2))
        self.write("2_depth.png", b"damaged")
        topics = {"depth/image_rect": Image, "depth/camera_info": CameraInfo,
                  "rgb/image_rect_color": Image, "rgb/camera_info": CameraInfo}
        seen = {t: self.listen(self.space + "/camera/" + t, k, []) for t, k in topics.items()}
        self.start("DepthFolderPlayer", rate=50.0, folder=self.folder)

        def common():
            stamps = [{m.header.stamp for m in messages} for messages in seen.values()]
            return sorted(set.intersection(*stamps))
        self.wait_for(lambda: len(common()) >= 2, "two pictures with all their parts")
        stamp = common()[0]
        depth, info, colour, colour_info = (
            next(m for m in seen[t] if m.header.stamp == stamp) for t in topics)
        self.assertEqual((depth.encoding, depth.width, depth.height), ("16UC1", 2, 2))
        first, second = struct.unpack("<HH", depth.data[:4])
        self.assertEqual(first, 1000)
        index = second - 2000
        self.assertIn(index, (0, 1))
        self.assertEqual((colour.encoding, bytes(colour.data[:3])), ("bgr8", bytes([10 * index, 0, 255])))
        for camera in (info, colour_info):
            self.assertEqual(camera.K, (500.0, 0.0, 0.5, 0.0, 501.0, 0.25, 0.0, 0.0, 1.0))
            self.assertEqual((camera.P[0], camera.P[5], camera.P[2]), (500.0, 501.0, 0.5))
        self.assertEqual(depth.header.frame_id, "camera_depth_optical_frame")
        self.assertEqual(colour.header.frame_id, "camera_color_optical_frame")
        self.wait_for(lambda: any("2_depth.png" in s.message for s in self.statuses()),
                      "the refusal in the diagnostics")

    def test_bad_parameters_refuse_to_start(self):
        files = [self.write("a.pcd", pcd([(1, 2, 3)]))]
        self.assertTrue(self.refuses_to_start("PcdPlayer"))
        self.assertTrue(self.refuses_to_start("PcdPlayer", files=files, folder=self.folder))
        self.assertTrue(self.refuses_to_start("PcdPlayer", files=[]))
        self.assertTrue(self.refuses_to_start("PcdPlayer", files=files[0]))
        self.assertTrue(self.refuses_to_start("PcdPlayer", files=[1]))
        for rate in (0, -1.0, "fast", math.nan, 1e9):
            self.assertTrue(self.refuses_to_start("PcdPlayer", files=files, rate=rate), rate)
        self.assertTrue(self.refuses_to_start("PcdPlayer", files=files, unknown=1))
        self.assertTrue(self.refuses_to_start("DepthFolderPlayer"))
        self.assertTrue(self.refuses_to_start("DepthFolderPlayer", folder=self.folder, loop=1))
        self.assertFalse(self.refuses_to_start("PcdPlayer", files=files), "the plain case starts")

    def real(self, path):
        data = os.environ.get("PILOTHOUSE_DATA")
        if not data:
            self.skipTest("PILOTHOUSE_DATA is not set: no recordings to play")
        return os.path.join(data, path)

    def test_real_clouds(self):
        folder = self.real("floor_depth/kinect_labelled")
        clouds = self.listen(self.space + "/camera/depth/points", PointCloud2, [])
        self.start("PcdPlayer", rate=20.0, folder=folder)
        self.wait_for(lambda: len(clouds) >= 3, "clouds")
        self.assertEqual((clouds[0].width, clouds[0].height), (640, 480))
        self.assertIn("label", [f.name for f in clouds[0].fields])

    def test_real_pictures(self):
        folder = self.real("floor_depth/realsense_floor")
        pictures = self.listen(self.space + "/camera/depth/image_rect", Image, [])
        colours = self.listen(self.space + "/camera/rgb/image_rect_color", Image, [])
        self.start("DepthFolderPlayer", rate=20.0, folder=folder)
        self.wait_for(lambda: len(pictures) >= 6 and len(colours) >= 6, "a round of pictures")
        self.assertEqual(len({hash(bytes(p.data)) for p in pictures}), 6)
        self.assertEqual((colours[0].width, colours[0].encoding), (640, "bgr8"))


if __name__ == "__main__":
    rospy.init_node("test_players")
    rostest.rosrun("pilothouse", "test_players", Players, sys.argv)
