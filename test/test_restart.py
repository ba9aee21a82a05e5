#!/usr/bin/env python3
"""simulation.launch while its manager is killed in full drive: everything comes back by itself, and the
robot stands until it is armed by hand, although it was armed before by its demonstration."""
import os
import signal
import sys
import threading
import time
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from pilothouse.msg import StopState
from std_srvs.srv import Trigger

DEADLINE = 120.0  # s, for what must happen
OUTPUTS = ['camera/depth/image_rect', 'camera/rgb/image_rect_color', 'range/front', 'odom', 'imu/data',
           'joint_states', 'contacts', 'floor_grid', 'objects/camera', 'objects/front',
           'objects/merged', 'objects/filtered', 'speed_limit', 'route_state']
MANAGER = '/pilothouse_manager'


def process_of(node):
    address = rosgraph.Master(rospy.get_name()).lookupNode(node)
    return xmlrpc.client.ServerProxy(address).getPid(rospy.get_name())[2]


class Restart(unittest.TestCase):
    def setUp(self):
        self.changed = threading.Condition()
        self.stamps = {}    # when each output came last
        self.states = []    # of the stop gate
        self.wishes = []    # speeds on cmd_vel
        self.truths = []    # speeds of the robot
        for topic in OUTPUTS:
            rospy.Subscriber(topic, rospy.AnyMsg, self.take_any, topic, queue_size=1)
        rospy.Subscriber('stop_state', StopState, self.take(self.states, lambda m: m))
        rospy.Subscriber('cmd_vel', Twist, self.take(self.wishes, speed_of))
        rospy.Subscriber('ground_truth', Odometry, self.take(self.truths, lambda m: speed_of(m.twist.twist)))

    def take_any(self, _, topic):
        with self.changed:
            self.stamps[topic] = time.monotonic()
            self.changed.notify_all()

    def take(self, where, what):
        def taken(message):
            with self.changed:
                where.append(what(message))
                self.changed.notify_all()
        return taken

    def wait(self, condition, what):
        with self.changed:
            self.assertTrue(self.changed.wait_for(condition, DEADLINE), what())

    def silent(self, since):
        return [topic for topic in OUTPUTS if self.stamps.get(topic, 0.0) < since]

    def forget(self):
        with self.changed:
            for what in (self.states, self.wishes, self.truths):
                del what[:]

    def state(self):
        return str(self.states[-1:])

    def test_killed_manager(self):
        self.wait(lambda: not self.silent(since=0.1), lambda: 'never came: %s' % self.silent(since=0.1))
        self.wait(lambda: any(state.state == StopState.RUNNING for state in self.states), self.state)
        self.drive()

        process = process_of(MANAGER)
        killed = time.monotonic()
        os.kill(process, signal.SIGKILL)
        self.wait(lambda: self.states[-1].state == StopState.STOPPED, self.state)
        self.forget()
        # Each state tells the command of its own beat; cmd_vel comes by another connection, perhaps late.
        self.wait(lambda: len(self.states) > 25 and len(self.wishes) > 25 and not any(self.wishes[-25:]),
                  lambda: 'no commands of zero: %s' % self.wishes[-25:])
        with self.changed:
            late = [speed_of(state.command) for state in self.states]
        self.assertFalse(any(late), late)
        stopped = time.monotonic()  # what was under way has come in
        self.forget()
        self.wait(lambda: not self.silent(stopped), lambda: 'did not come back: %s' % self.silent(stopped))
        self.wait(lambda: self.states and self.states[-1].can_arm, self.state)
        print('all back %.1f s after the kill' % (time.monotonic() - killed))
        self.assertNotEqual(process_of(MANAGER), process)

        # Three seconds in which it could drive, with a route of the demonstration and all that it takes.
        seen = len(self.states)
        self.wait(lambda: len(self.states) > seen + 150, self.state)
        with self.changed:
            self.assertEqual({state.state for state in self.states}, {StopState.STOPPED})
            self.assertEqual(set(self.wishes), {0.0})
            self.assertLess(max(self.truths), 0.01)

        self.arm()

    def drives(self):
        return self.states[-1].state == StopState.RUNNING and self.truths and self.truths[-1] > 0.1

    def can_be_armed(self):
        return self.states[-1].state == StopState.STOPPED and self.states[-1].can_arm

    def drive(self):
        """Where a busy computer made something stale before it got going, a person arms it again."""
        deadline = time.monotonic() + DEADLINE
        while time.monotonic() < deadline:
            self.wait(lambda: self.drives() or self.can_be_armed(), self.state)
            if self.drives():
                return
            rospy.ServiceProxy('stop_gate/arm', Trigger)()
        self.fail('never got going: ' + self.state())

    def arm(self):
        """Again where a busy computer makes something stale at the very moment."""
        deadline = time.monotonic() + DEADLINE
        while time.monotonic() < deadline:
            self.wait(lambda: self.states[-1].can_arm, self.state)
            answer = rospy.ServiceProxy('stop_gate/arm', Trigger)()
            if answer.success:
                return
        self.fail(answer.message)


def speed_of(twist):
    return max(abs(twist.linear.x), abs(twist.linear.y), abs(twist.angular.z))


if __name__ == '__main__':
    rospy.init_node('test_restart')
    rostest.rosrun('pilothouse', 'restart', Restart, sys.argv)
