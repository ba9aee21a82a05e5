// What the operator asks about the place, against a robot whose services hang.

#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <pilothouse/PlanPath.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "gui/model/clock.hpp"
#include "gui/model/place_errands.hpp"
#include "test/wait_for.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

/// A service that is entered, and answers only where it is open.
struct Door {
  std::atomic<bool> open{true};
  std::atomic<int> entered{0}, answered{0};
  bool pass() {
    ++entered;
    waitFor([this] { return open.load(); });
    ++answered;
    return true;
  }
};

class Errands : public ::testing::Test {
 protected:
  void SetUp() override {
    offer("task/pause", pause);
    offer("task/skip", skip);
    offer("task/cancel", cancel);
    servers_.push_back(node_.advertiseService<PlanPath::Request, PlanPath::Response>(
        "plan_path", [this](PlanPath::Request&, PlanPath::Response&) { return plan.pass(); }));
    goals_ = node_.subscribe<geometry_msgs::PoseStamped>(
        "move_base_simple/goal", 10,
        [this](const geometry_msgs::PoseStampedConstPtr&) { ++goals; });
    spinner_.start();
    errands = std::make_unique<PlaceErrands>(state);
    ASSERT_TRUE(waitFor([this] { return goals_.getNumPublishers() > 0; }));
  }
  void TearDown() override {
    for (Door* door : {&plan, &pause, &skip, &cancel}) door->open = true;
    errands.reset();
  }
  void offer(const std::string& name, Door& door) {
    servers_.push_back(
        node_.advertiseService<std_srvs::Trigger::Request, std_srvs::Trigger::Response>(
            name, [&door](std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
              response.success = true;
              return door.pass();
            }));
  }
  void hang(Door& door, const std::function<void()>& ask) {
    door.open = false;
    ask();
    ASSERT_TRUE(waitFor([&] { return door.entered > 0; }));
  }
  bool told(const std::string& part) {
    return waitFor([&] { return state.place.answer.get().text.find(part) != std::string::npos; });
  }

  Door plan, pause, skip, cancel;
  std::atomic<int> goals{0};
  ConsoleState& state = *new ConsoleState;  // outlives everything: a call may use it still
  std::unique_ptr<PlaceErrands> errands;

 private:
  ros::NodeHandle node_;
  std::vector<ros::ServiceServer> servers_;
  ros::Subscriber goals_;
  ros::AsyncSpinner spinner_{4};
};

TEST_F(Errands, aGoalAndACancelGoOutWhileThePlannerHangs) {
  hang(plan, [this] { errands->preview(1, {{1.0, 0.0}, {}}, {}); });
  // Whether somebody listens is known once the topic has met its subscriber.
  ASSERT_TRUE(waitFor([this] {
    errands->goTo({{1.0, 0.0}, {}});
    return told("goal sent") && goals > 0;
  }));
  errands->task(TaskCall::kCancel);
  EXPECT_TRUE(waitFor([this] { return cancel.answered == 1; }));
  EXPECT_EQ(plan.answered, 0);
}

TEST_F(Errands, aCancelLetsNothingSetOutAfterIt) {
  hang(pause, [this] { errands->task(TaskCall::kPause); });
  errands->task(TaskCall::kSkip);
  errands->task(TaskCall::kCancel);
  pause.open = true;
  EXPECT_TRUE(waitFor([this] { return cancel.answered == 1; }));
  EXPECT_TRUE(told("cancelled"));
  EXPECT_EQ(skip.entered, 0);
}

TEST_F(Errands, whatCouldNotBeSentInTimeIsRefusedInWords) {
  hang(pause, [this] { errands->task(TaskCall::kPause); });
  const double asked = steadySeconds();
  errands->task(TaskCall::kSkip);
  EXPECT_TRUE(waitFor([this] { return state.place.asking.get().count("task") > 0; }));
  ASSERT_TRUE(waitFor([&] { return steadySeconds() - asked > 3.2; }));
  pause.open = true;
  EXPECT_TRUE(told("not sent"));
  EXPECT_EQ(skip.entered, 0);
}

TEST_F(Errands, tooManyAreRefusedAtOnce) {
  hang(pause, [this] { errands->task(TaskCall::kPause); });
  for (int i = 0; i < 17; ++i) errands->task(TaskCall::kSkip);
  EXPECT_TRUE(told("too much waits"));
  EXPECT_EQ(pause.answered, 0);
}

}  // namespace

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_console_errands");
  return RUN_ALL_TESTS();
}
