#include "gui/model/ros_streams.hpp"

#include <ros/master.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>

#include "doors/guarded_subscriber.hpp"
#include "gui/model/clock.hpp"
#include "gui/model/master.hpp"

namespace pilothouse::gui {

namespace {

// Age of a message on arrival; 0 when its stamp belongs to another clock (a bag of last year, a
// simulation). Never by ROS time: roscpp's /clock stands still after the master was replaced.
double latencyOf(const ros::Time& stamp) {
  const double latency = ros::WallTime::now().toSec() - stamp.toSec();
  return latency > 0.0 && latency < 10.0 ? latency : 0.0;
}

ros::NodeHandle onQueue(ros::CallbackQueue& queue) {
  ros::NodeHandle node;
  node.setCallbackQueue(&queue);
  return node;
}

}  // namespace

RosStreams::RosStreams(ConsoleState& state, Helm* helm)
    : state_(state),
      node_(onQueue(queue_)),
      conversions_(state),
      drive_(node_, state, helm),
      place_(node_, state, conversions_, transforms_),
      began_(steadySeconds()),
      spinner_(1, &queue_) {
  listener_ = std::make_unique<tf2_ros::TransformListener>(transforms_, node_, false);
  rewinds_ = listen<tf2_msgs::TFMessage>(
      "/tf",
      [this](const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
        for (const auto& one : event.getConstMessage()->transforms) {
          if (rewind_.rewound(one.child_frame_id, one.header.stamp.toSec())) transforms_.clear();
        }
      },
      [this](const std::string& reason) { drive_.refused("tf", reason); }, 100);
  std::map<std::string, std::string> names;
  for (const char* topic :
       {"camera/depth/image_rect", "camera/depth/camera_info", "camera/depth/points",
        "camera/rgb/image_rect_color", "camera/rgb/image_rect_color/compressed", "floor_grid",
        "objects/camera", "objects/merged", "objects/filtered", "speed_limit", "stop_state", "odom",
        "map_cells", "pose", "plan_path", "task_state", "volume_points"}) {
    names[topic] = node_.resolveName(topic);
  }
  state_.names.set(names);
  depth_ = subscribe("camera/depth/image_rect", conversions_.depth, state_.depth);
  floor_ = subscribe("floor_grid", conversions_.floor, state_.floor);
  info_ = listen<sensor_msgs::CameraInfo>(
      "camera/depth/camera_info",
      [this](const ros::MessageEvent<const sensor_msgs::CameraInfo>& event) {
        conversions_.info.set(event.getConstMessage());
      },
      [this](const std::string& reason) { state_.depth.reject(reason, steadySeconds()); });
  complaints_ = listen<diagnostic_msgs::DiagnosticArray>(
      "diagnostics",
      [this](const ros::MessageEvent<const diagnostic_msgs::DiagnosticArray>& event) {
        diagnostics_.update(*event.getConstMessage(), steadySeconds());
        state_.complaints.set(diagnostics_.complaints(steadySeconds()));
      },
      [this](const std::string& reason) { drive_.refused("diagnostics", reason); }, 10);
  // Also where nothing comes any more: what was complained of is forgotten all the same.
  forget_ = node_.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) {
    state_.complaints.set(diagnostics_.complaints(steadySeconds()));
  });
  settings_ = listen<dynamic_reconfigure::Config>(
      "floor/parameter_updates",
      [this](const ros::MessageEvent<const dynamic_reconfigure::Config>& event) {
        announced(*event.getConstMessage());
      },
      [this](const std::string& reason) { drive_.refused("floor/parameter_updates", reason); });
  spinner_.start();
}

RosStreams::~RosStreams() {
  spinner_.stop();
  state_.complaints.set({});
  state_.missing_transform.set({});
  state_.floor_settings.set({});
}

template <class Message>
ros::Subscriber RosStreams::listen(
    const std::string& topic,
    const boost::function<void(const ros::MessageEvent<const Message>&)>& receive,
    const std::function<void(const std::string&)>& refused, std::uint32_t queue) {
  auto options = guardedOptions<Message>(topic, queue, receive, refused);
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return node_.subscribe(options);
}

template <class Message, class Picture>
ros::Subscriber RosStreams::subscribe(const std::string& topic, Mailbox<Message>& box,
                                      Feed<Picture>& feed) {
  const std::string name = node_.resolveName(topic);
  return listen<Message>(
      topic,
      [this, &box, &feed, name](const ros::MessageEvent<const Message>& event) {
        const auto message = event.getConstMessage();
        const double now = steadySeconds();
        feed.arrived(now, message->header.seq, event.getPublisherName(), name);
        if (box.put({message, now, latencyOf(message->header.stamp), name})) feed.overwritten();
        conversions_.wake();
      },
      [&feed](const std::string& reason) { feed.reject(reason, steadySeconds()); });
}

void RosStreams::review() {
  std::vector<ros::master::TopicInfo> topics;
  std::set<std::string> advertised;
  if (ros::master::getTopics(topics)) {
    for (const auto& topic : topics) advertised.insert(topic.name);
  }
  state_.advertised.set(advertised);
  drive_.review(advertised);
  chooseSources();
  lookAtTransforms();
}

void RosStreams::chooseSources() {
  const auto advertised = state_.advertised.get();
  const auto there = [&](const char* topic) {
    return advertised.count(node_.resolveName(topic)) > 0;
  };
  // The list that tells most of its objects.
  std::string objects = "objects/camera";
  for (const char* topic : {"objects/merged", "objects/filtered"}) {
    if (there(topic)) objects = topic;
  }
  if (!objects_ || objects_.getTopic() != node_.resolveName(objects)) {
    objects_ = subscribe(objects, conversions_.objects, state_.objects);
  }
  const double now = steadySeconds();
  const auto flows = [&](const FeedState& feed, const char* topic) {
    return feed.ever && feed.age_s < kStaleAfter && feed.topic == node_.resolveName(topic);
  };
  const bool cloud = there("camera/depth/points");
  const bool waited = now - began_ > kStaleAfter;
  const FeedState depth = state_.depth.state(now);
  // A cloud is ten times a depth image's bytes: only where no image is to be had.
  const bool image_silent =
      !there("camera/depth/image_rect") || (waited && !flows(depth, "camera/depth/image_rect"));
  conversions_.cloud_as_depth = cloud && image_silent;

  const bool raw = there("camera/rgb/image_rect_color");
  const bool coded = there("camera/rgb/image_rect_color/compressed");
  // The JPEG where both are offered: a tenth of the bytes over a radio link.
  if (coded != static_cast<bool>(coded_)) {
    coded_ = coded ? subscribe("camera/rgb/image_rect_color/compressed", conversions_.coded,
                               state_.colour)
                   : ros::Subscriber();
  }
  const bool use_raw = raw && !coded;
  if (use_raw != static_cast<bool>(colour_)) {
    colour_ = use_raw ? subscribe("camera/rgb/image_rect_color", conversions_.colour, state_.colour)
                      : ros::Subscriber();
  }
  conversions_.cloud_as_colour = cloud && !raw && !coded;
  const bool use_cloud = conversions_.cloud_as_depth || conversions_.cloud_as_colour;
  if (use_cloud != static_cast<bool>(cloud_)) {
    cloud_ = use_cloud ? subscribeCloud() : ros::Subscriber();
  }
}

ros::Subscriber RosStreams::subscribeCloud() {
  const std::string name = node_.resolveName("camera/depth/points");
  using Cloud = sensor_msgs::PointCloud2;
  // One message may feed both pictures.
  const auto forBoth = [this](const auto& tell) {
    if (conversions_.cloud_as_depth) tell(state_.depth);
    if (conversions_.cloud_as_colour) tell(state_.colour);
  };
  return listen<Cloud>(
      "camera/depth/points",
      [this, name, forBoth](const ros::MessageEvent<const Cloud>& event) {
        const auto cloud = event.getConstMessage();
        const double now = steadySeconds();
        const bool lost =
            conversions_.cloud.put({cloud, now, latencyOf(cloud->header.stamp), name});
        forBoth([&](auto& feed) {
          feed.arrived(now, cloud->header.seq, event.getPublisherName(), name);
          if (lost) feed.overwritten();
        });
        conversions_.wake();
      },
      [forBoth](const std::string& reason) {
        forBoth([&](auto& feed) { feed.reject(reason, steadySeconds()); });
      });
}

void RosStreams::lookAtTransforms() {
  const auto depth = state_.depth.latest();
  if (!depth || depth->frame.empty()) return;
  const auto floor = state_.floor.latest();
  const std::string base = floor && !floor->frame.empty() ? floor->frame : "base_link";
  try {
    const auto found = transforms_.lookupTransform(base, depth->frame, ros::Time(0)).transform;
    const auto& q = found.rotation;
    // Where the optical axis (z) points, seen from above.
    const double forward = 2.0 * (q.x * q.z + q.w * q.y);
    const double left = 2.0 * (q.y * q.z - q.w * q.x);
    if (std::isfinite(forward) && std::isfinite(left)) {
      state_.camera_pose.set(
          CameraPose{found.translation.x, found.translation.y, std::atan2(left, forward)});
    }
    state_.missing_transform.set({});
  } catch (const tf2::TransformException&) {
    // A nodelet that searches the floor in each picture puts the camera above the origin.
    const bool searched = masterText(node_.resolveName("floor/mounting_source")) == "search";
    state_.camera_pose.set(searched ? std::make_optional(CameraPose{0.0, 0.0, 0.0}) : std::nullopt);
    state_.missing_transform.set(base + " to " + depth->frame);
  }
}

void RosStreams::announced(const dynamic_reconfigure::Config& config) {
  FloorSettings settings;
  for (const auto& entry : config.strs) {
    if (entry.name == "method") {
      settings.known = true;
      settings.original = entry.value == "original";
    }
  }
  for (const auto& entry : config.bools) {
    if (entry.name == "calibrate_mounting") settings.calibrate = entry.value != 0;
  }
  state_.floor_settings.set(settings);
}

}  // namespace pilothouse::gui
