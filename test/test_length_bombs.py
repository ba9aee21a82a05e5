#!/usr/bin/env python3
"""Serialised clouds whose length prefixes lie, sent over live TCPROS: the listener refuses each
with a reason, stays alive, allocates nothing for them, and processes the next good cloud."""
import io
import struct
import sys
import threading
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import String, UInt32

LISTENER = "/guarded_listener"
DEADLINE = 60.0  # s


class RawCloud(rospy.AnyMsg):
    """A PointCloud2 of any bytes."""

    _type = PointCloud2._type
    _md5sum = PointCloud2._md5sum
    _full_text = PointCloud2._full_text

    def __init__(self, data=b""):
        super().__init__()
        self._buff = data


def good_cloud(width):
    fields = [PointField(n, 4 * i, PointField.FLOAT32, 1) for i, n in enumerate("xyz")]
    cloud = PointCloud2(height=1, width=width, fields=fields, point_step=12, row_step=12 * width,
                        data=b"\0" * (12 * width))
    buffer = io.BytesIO()
    cloud.serialize(buffer)
    return buffer.getvalue()


def bomb(fields, size=64):
    """`size` bytes that claim `fields` fields."""
    head = struct.pack("<IIII", 0, 0, 0, 0) + struct.pack("<III", 1, 1, fields)
    return head.ljust(size, b"\0")


def resident_mb(pid):
    """Most memory that the process has held so far."""
    with open("/proc/%d/status" % pid) as status:
        line = next(l for l in status if l.startswith("VmHWM"))
    return int(line.split()[1]) / 1024.0


class LengthBombs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.changed = threading.Condition()
        cls.refused, cls.accepted = [], []
        rospy.Subscriber("refused", String, lambda m: cls.note(cls.refused, m.data))
        rospy.Subscriber("accepted", UInt32, lambda m: cls.note(cls.accepted, m.data))
        cls.publisher = rospy.Publisher("points", RawCloud, queue_size=2000)
        cls.wait_for(lambda: cls.publisher.get_num_connections() == 1, "the listener")
        # The answers' connections are up once one has come through.
        cls.wait_for(lambda: cls.publisher.publish(RawCloud(good_cloud(1))) or cls.accepted,
                     "a first cloud")
        cls.wait_for(lambda: cls.publisher.publish(RawCloud(b"")) or cls.refused,
                     "a first refusal")
        uri = rosgraph.Master(rospy.get_name()).lookupNode(LISTENER)
        cls.pid = xmlrpc.client.ServerProxy(uri).getPid(rospy.get_name())[2]

    @classmethod
    def note(cls, answers, data):
        with cls.changed:
            answers.append(data)
            cls.changed.notify_all()

    @classmethod
    def wait_for(cls, done, what):
        deadline = rospy.get_time() + DEADLINE
        with cls.changed:
            while not done():
                left = deadline - rospy.get_time()
                assert left > 0, "waited %g s for %s" % (DEADLINE, what)
                cls.changed.wait(min(left, 0.1))

    def send(self, bombs, width):
        """Send the bombs, then a good cloud; return the refusals when that cloud is processed."""

        def refusals():
            return [r for r in self.refused if "fields" in r]

        with self.changed:
            before = len(refusals())
        for data in bombs:
            self.publisher.publish(RawCloud(data))
        self.publisher.publish(RawCloud(good_cloud(width)))
        self.wait_for(lambda: width in self.accepted, "the cloud after the bombs")
        self.wait_for(lambda: len(refusals()) >= before + len(bombs), "every refusal")
        return refusals()[before:]

    def test_64_bytes_that_claim_40_million_fields(self):
        before = resident_mb(self.pid)
        refusals = self.send([bomb(40000000)], width=7)
        self.assertEqual(refusals,
                         ["length of PointCloud2 fields is 40000000, expected 0 to 2"])
        self.assertLess(resident_mb(self.pid) - before, 100.0)

    def test_a_thousand_bombs(self):
        before = resident_mb(self.pid)
        claims = [1 << (10 + i % 22) for i in range(1000)]
        refusals = self.send([bomb(c, 64 + i) for i, c in enumerate(claims)], width=8)
        self.assertEqual(len(refusals), 1000)
        self.assertLess(resident_mb(self.pid) - before, 100.0)


if __name__ == "__main__":
    rospy.init_node("test_length_bombs")
    rostest.rosrun("pilothouse", "test_length_bombs", LengthBombs, sys.argv)
