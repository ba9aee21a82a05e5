#include <pluginlib/class_list_macros.hpp>

#include <stdexcept>

#include "doors/file_bytes.hpp"
#include "nodelets/frame_cache.hpp"
#include "nodelets/pcd_file.hpp"
#include "nodelets/player.hpp"

namespace pilothouse {

/// Plays PCD files as camera/depth/points: those of ~files (a list of paths) in its order, or all
/// *.pcd in ~folder by name. ~frame is the clouds' frame.
class PcdPlayer : public Player {
  void configure(StrictParameters& parameters) override {
    parameters.read("frame", frame_);
    parameters.read("folder", folder_);
    XmlRpc::XmlRpcValue files = parameters.raw("files");
    if (files.valid() != folder_.empty())
      parameters.addFault("exactly one of files and folder is expected");
    if (!files.valid()) return;
    const bool list = files.getType() == XmlRpc::XmlRpcValue::TypeArray && files.size() > 0;
    if (!list) return parameters.addWrong("files", files, "a list of paths");
    for (int i = 0; i < files.size(); ++i) {
      if (files[i].getType() != XmlRpc::XmlRpcValue::TypeString)
        return parameters.addWrong("files", files[i], "a list of paths");
      paths_.push_back(static_cast<std::string>(files[i]));
    }
  }

  void advertise(ros::NodeHandle& handle) override {
    points_ = handle.advertise<sensor_msgs::PointCloud2>("camera/depth/points", 2);
  }

  std::vector<std::string> openSource() override {
    if (!folder_.empty())
      for (const std::string& name : listFolder(folder_))
        if (endsWith(name, ".pcd")) paths_.push_back(folder_ + "/" + name);
    if (paths_.empty()) throw std::runtime_error("folder " + folder_ + " has no *.pcd file");
    clouds_.resize(paths_.size());
    return paths_;
  }

  bool hasListeners() const override { return points_.getNumSubscribers() > 0; }

  void play(std::size_t frame, const ros::Time& stamp) override {
    const auto kept = clouds_.get(
        frame, [&] { return readPcd(paths_[frame]); },
        [](const sensor_msgs::PointCloud2& cloud) { return cloud.data.size(); });
    // A message is never changed after publishing: each gets its own stamp, so its own copy.
    const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>(*kept);
    cloud->header.stamp = stamp;
    cloud->header.frame_id = frame_;
    points_.publish(cloud);
  }

  std::string frame_ = "camera_depth_optical_frame";
  std::string folder_;
  std::vector<std::string> paths_;
  FrameCache<sensor_msgs::PointCloud2> clouds_;
  ros::Publisher points_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::PcdPlayer, nodelet::Nodelet)
