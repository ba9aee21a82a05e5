#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <pilothouse/Operator.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <QProcess>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "gui/model/clock.hpp"
#include "gui/model/helm.hpp"
#include "gui/model/key_watcher.hpp"
#include "gui/model/ros_link.hpp"
#include "gui/view/drive_bar.hpp"
#include "gui/view/main_window.hpp"

namespace pilothouse::gui {

// What the tests of the whole console on a real screen need: processes, real keys, what was
// published, and the console itself.

constexpr int kPatience = 60000;  // ms; far above what anything here takes

/// A process that ends with the test, whatever happens.
class Child {
 public:
  Child(const QString& program, const QStringList& arguments) {
    process_.setProcessChannelMode(QProcess::ForwardedChannels);
    process_.start(program, arguments);
    started_ = process_.waitForStarted(kPatience);
  }
  ~Child() {
    process_.terminate();
    if (!process_.waitForFinished(5000)) process_.kill();
    process_.waitForFinished(5000);
  }
  bool started() const { return started_; }

 private:
  QProcess process_;
  bool started_ = false;
};

inline int xdotool(const QString& words) {
  return std::system(qPrintable("xdotool " + words));
}

/// What the console published, on a thread of its own.
class Recorder {
 public:
  struct Beat {
    double at;
    Operator message;
  };
  struct Drive {
    double at;
    Twist2 command;
  };
  Recorder() : spinner_(1, &queue_) {
    node_.setCallbackQueue(&queue_);
    operator_ = node_.subscribe<Operator>("operator", 100, [this](const OperatorConstPtr& m) {
      const std::lock_guard<std::mutex> lock(mutex_);
      beats_.push_back({steadySeconds(), *m});
    });
    teleop_ = node_.subscribe<geometry_msgs::TwistStamped>(
        "cmd_vel/teleop", 100, [this](const geometry_msgs::TwistStampedConstPtr& m) {
          const std::lock_guard<std::mutex> lock(mutex_);
          drives_.push_back(
              {steadySeconds(), {m->twist.linear.x, m->twist.linear.y, m->twist.angular.z}});
        });
    spinner_.start();
  }
  std::vector<Beat> beats(double since) const { return after(beats_, since); }
  std::vector<Drive> drives(double since) const { return after(drives_, since); }

 private:
  template <class T>
  std::vector<T> after(const std::vector<T>& all, double since) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<T> out;
    for (const auto& one : all) {
      if (one.at >= since) out.push_back(one);
    }
    return out;
  }
  mutable std::mutex mutex_;
  std::vector<Beat> beats_;
  std::vector<Drive> drives_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::Subscriber operator_, teleop_;
  ros::AsyncSpinner spinner_;
};

inline int zeros(const std::vector<Recorder::Drive>& drives) {
  return static_cast<int>(
      std::count_if(drives.begin(), drives.end(), [](const auto& d) { return d.command.zero(); }));
}

/// The console with everything round it; made once, as roscpp can be started once.
class Bridge {
 public:
  Bridge() {
    robot.name = robot.title = "platform";
    robot.footprint = {{{0.25, 0.20}}, {{-0.25, 0.20}}, {{-0.25, -0.20}}, {{0.25, -0.20}}};
    robot.drive.kind = BaseKind::kFourWheelSteered;
    window = std::make_unique<MainWindow>(
        PanelContext{state, robot, nullptr, &helm, [this](StopSerial stops) { link.askArm(stops); },
                     [this](const std::function<void(PlaceAsks&)>& ask) { link.askPlace(ask); }},
        false, watcher != nullptr);
    window->show();
    if (watcher) watcher->heed(window->winId());
    QObject::connect(&watch, &QTimer::timeout, [this] {
      const QRect stop = window->driveBar()->stopPlace();
      if (watcher) watcher->heedPresses({stop.x(), stop.y(), stop.width(), stop.height()});
    });
    watch.start(100);
    helm.start();
    link.start();
  }
  bool wait(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, kPatience);
  }
  bool gateIs(GatePhase phase) {
    return wait([&] {
      const auto gate = state.gate.latest();
      return gate && gate->phase == phase;
    });
  }
  void focus() {
    window->activateWindow();
    ASSERT_TRUE(wait([&] {
      xdotool(QString("windowactivate --sync %1").arg(window->winId()));
      return window->isActiveWindow();
    }));
  }
  /// Armed, all keys up, nothing driven.
  void makeReady() {
    focus();
    if (state.gate.latest() && !helm.stopped() && gateNow() != GatePhase::kStopped) return;
    ASSERT_TRUE(gateIs(GatePhase::kStopped));  // a stop may be on its way still
    link.askArm(helm.stops());
    ASSERT_TRUE(wait([&] { return gateNow() != GatePhase::kStopped; }));
    ASSERT_TRUE(wait([&] {  // and the helm knows
      const double since = steadySeconds() - 0.2;
      const auto beats = recorder->beats(since);
      return !beats.empty() && !beats.back().message.stop;
    }));
  }
  GatePhase gateNow() const { return state.gate.latest()->phase; }
  bool drives(double since, std::size_t count) {
    return wait([&] { return recorder->drives(since).size() >= count; });
  }
  /// The last command is a zero and a while ago.
  bool ended(double since) {
    return wait([&] {
      const auto all = recorder->drives(since);
      return !all.empty() && all.back().command.zero() &&
             recorder->beats(all.back().at).size() >= 4;
    });
  }
  /// Nothing is driven while this many signs of life pass.
  void expectSilence(std::size_t beats) {
    const double since = steadySeconds();
    ASSERT_TRUE(wait([&] { return recorder->beats(since).size() >= beats; }));
    for (const auto& d : recorder->drives(since)) {
      ADD_FAILURE() << "driven " << d.command.vx << ", " << d.command.vy << ", " << d.command.w;
    }
  }
  bool stopPublished(double since) {
    return wait([&] {
      const auto all = recorder->beats(since);
      return !all.empty() && all.back().message.stop;
    });
  }

  // Outlive everything: a ROS call may still use them while the test ends.
  ConsoleState& state = *new ConsoleState;
  RobotDescription robot;
  Helm helm{[] {
    BaseParameters base;
    base.kind = BaseKind::kFourWheelSteered;
    return base;
  }()};
  RosLink& link = *new RosLink({"console"}, state, &helm);
  std::unique_ptr<KeyWatcher> watcher = KeyWatcher::open(helm);
  std::unique_ptr<MainWindow> window;
  std::unique_ptr<Recorder> recorder;
  QTimer watch;
};

}  // namespace pilothouse::gui
