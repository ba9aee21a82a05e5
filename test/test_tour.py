#!/usr/bin/env python3
"""simulation.launch with its tour and with goals: the tour is a task as any other, so that a person pauses it,
skips its points, and sends the robot elsewhere instead."""
import sys
import threading
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from pilothouse.msg import NavigationState, StopState, TaskState
from std_srvs.srv import Trigger

DEADLINE = 120.0  # s, for what must happen


class Tour(unittest.TestCase):
    def setUp(self):
        self.changed = threading.Condition()
        self.task, self.navigation, self.speed = None, None, 0.0
        self.gate = None
        rospy.Subscriber('stop_state', StopState, self.take('gate'))
        rospy.Subscriber('task_state', TaskState, self.take('task'))
        rospy.Subscriber('navigation_state', NavigationState, self.take('navigation'))
        rospy.Subscriber('ground_truth', Odometry, self.take('speed', lambda m: abs(m.twist.twist.linear.x) +
                                                             abs(m.twist.twist.linear.y)))

    def take(self, what, how=lambda message: message):
        def taken(message):
            with self.changed:
                setattr(self, what, how(message))
                self.changed.notify_all()
        return taken

    def wait(self, condition, what):
        """Where a busy computer made something stale, a person arms it again: how fast it goes is not the matter."""
        deadline = time.monotonic() + DEADLINE
        while True:
            with self.changed:
                self.changed.wait_for(lambda: condition() or self.can_be_armed(), deadline - time.monotonic())
                if condition():
                    return
            self.assertLess(time.monotonic(), deadline, '%s: %s' % (what, self.task))
            rospy.ServiceProxy('stop_gate/arm', Trigger)()

    def can_be_armed(self):
        """Again: at first it is the demonstration that arms."""
        return (self.task and self.task.behaviour and self.gate and self.gate.state == StopState.STOPPED and
                self.gate.cause != StopState.NOT_ARMED and self.gate.can_arm)

    def ask(self, service):
        answer = rospy.ServiceProxy(service, Trigger)()
        self.assertTrue(answer.success, answer.message)

    def test_as_a_task(self):
        self.wait(lambda: self.task and self.task.behaviour == 'route' and self.task.state == TaskState.RUNNING,
                  'the tour runs')
        self.wait(lambda: self.speed > 0.1, 'it drives')
        self.assertEqual(self.navigation.points, 6)

        self.ask('task/pause')
        self.wait(lambda: self.task.state == TaskState.PAUSED and self.speed < 0.01, 'paused, it stands')
        self.ask('task/resume')
        self.wait(lambda: self.task.state == TaskState.RUNNING and self.speed > 0.1, 'it goes on')
        point = self.navigation.point
        self.ask('task/skip')
        self.wait(lambda: self.navigation.point == (point + 1) % 6, 'a point is skipped')

        goal = PoseStamped()
        goal.header.frame_id = 'base_link'
        goal.pose.orientation.w = 1.0
        publisher = rospy.Publisher('move_base_simple/goal', PoseStamped, queue_size=1)
        self.wait(lambda: publisher.get_num_connections() > 0, 'somebody takes goals')
        publisher.publish(goal)
        self.wait(lambda: self.task.behaviour == 'go_to', 'a goal takes the place of the tour')
        self.wait(lambda: self.task.state != TaskState.RUNNING, 'the goal is reached')
        self.assertEqual((self.task.behaviour, self.task.state), ('go_to', TaskState.DONE), self.task)
        self.assertEqual(self.task.waiting, [], 'the tour does not come back')


if __name__ == '__main__':
    rospy.init_node('test_tour')
    rostest.rosrun('pilothouse', 'tour', Tour, sys.argv)
