#!/usr/bin/python3
"""The package as others build and use it: from the install space, and by catkin_make.

usage: package_test.py SOURCE BUILD installed|catkin_make
"""
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

DEADLINE = 60.0  # s, for what must appear


def fail(text):
    sys.exit('package_test: ' + text)


def bare_environment(home):
    """A shell in which nothing was sourced; all servers on loopback."""
    return {'HOME': home, 'PATH': '/usr/bin:/bin', 'ROS_IP': '127.0.0.1', 'ROS_HOME': home,
            'CCACHE_DIR': os.environ.get('CCACHE_DIR', os.path.expanduser('~/.cache/ccache')),
            'LANG': 'C.UTF-8'}


def run(command, environment, **options):
    result = subprocess.run(command, env=environment, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, universal_newlines=True, **options)
    if result.returncode != 0:
        fail('%s ended with %d:\n%s' % (command, result.returncode, result.stdout[-4000:]))
    return result.stdout


def sourced(prefix, environment):
    """The environment after `. PREFIX/setup.bash`."""
    listing = run(['bash', '-c', '. "$1/setup.bash" && env -0', 'bash', prefix], environment)
    return dict(entry.split('=', 1) for entry in listing.split('\0') if '=' in entry)


def free_port():
    """Below those that the system gives to every connection of whatever runs beside."""
    while True:
        port = random.randrange(12000, 32000)
        with socket.socket() as probe:
            try:
                probe.bind(('', port))
                return port
            except OSError:
                continue


def expect(text, output):
    if text not in output:
        fail('expected %r in:\n%s' % (text, output))


def check_floor_runs(environment):
    """Starts the robot's side and waits until it offers the floor grid."""
    port = free_port()
    environment = dict(environment, ROS_MASTER_URI='http://127.0.0.1:%d' % port)
    launch = subprocess.Popen(['roslaunch', '-p', str(port), 'pilothouse', 'robot.launch'],
                              env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True)
    try:
        end = time.monotonic() + DEADLINE
        while True:
            listing = subprocess.run(['rostopic', 'info', '/floor_grid'], env=environment,
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                     universal_newlines=True).stdout
            if 'Type: pilothouse/FloorGrid' in listing and '/pilothouse_manager' in listing:
                return
            if launch.poll() is not None:
                fail('robot.launch ended by itself:\n' + launch.stdout.read()[-4000:])
            if time.monotonic() > end:
                fail('no /floor_grid within %g s: %s' % (DEADLINE, listing))
    finally:
        if launch.poll() is None:
            launch.send_signal(signal.SIGINT)
        launch.communicate(timeout=DEADLINE)


def installed(source, build, folder):
    prefix = os.path.join(folder, 'install')
    environment = bare_environment(folder)
    run(['cmake', '--install', build, '--prefix', prefix], environment)
    environment = sourced(prefix, environment)
    expect(prefix, run(['rospack', 'find', 'pilothouse'], environment))
    expect('usage: console', run(['rosrun', 'pilothouse', 'console', '--help'], environment))
    for root, _, files in os.walk(prefix):
        for name in files:
            path = os.path.join(root, name)
            if name.endswith(('.launch', '.yaml', '.xml')):
                with open(path) as text:
                    if source in text.read():
                        fail('%s names the source tree' % path)
    check_floor_runs(environment)


def catkin_make(source, build, folder):
    os.mkdir(os.path.join(folder, 'src'))
    os.symlink(source, os.path.join(folder, 'src', 'pilothouse'))
    environment = bare_environment(folder)
    run(['catkin_make', '-j2', '-DPILOTHOUSE_BENCH=OFF', '-DCATKIN_ENABLE_TESTING=OFF',
         '-DCMAKE_BUILD_TYPE=Release'], environment, cwd=folder)
    environment = sourced(os.path.join(folder, 'devel'), environment)
    expect('usage: console', run(['rosrun', 'pilothouse', 'console', '--help'], environment))


def main():
    if len(sys.argv) != 4 or sys.argv[3] not in ('installed', 'catkin_make'):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    source, build, what = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3]
    folder = tempfile.mkdtemp(prefix='pilothouse_package_')
    try:
        {'installed': installed, 'catkin_make': catkin_make}[what](source, build, folder)
    finally:
        shutil.rmtree(folder)
    print('package_test: %s works' % what)
    return 0


if __name__ == '__main__':
    sys.exit(main())
