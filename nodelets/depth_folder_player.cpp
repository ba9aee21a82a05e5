#include <pluginlib/class_list_macros.hpp>

#include "nodelets/depth_folder.hpp"
#include "nodelets/frame_cache.hpp"
#include "nodelets/player.hpp"

namespace pilothouse {

/// Plays ~folder (see DepthFolder) as a depth camera with colour: image and CameraInfo of both,
/// all of one picture with the same stamp.
class DepthFolderPlayer : public Player {
  void configure(StrictParameters& parameters) override {
    parameters.require({"folder"});
    parameters.read("folder", path_);
    parameters.read("depth_frame", depth_frame_);
    parameters.read("colour_frame", colour_frame_);
  }

  void advertise(ros::NodeHandle& handle) override {
    depth_ = handle.advertise<sensor_msgs::Image>("camera/depth/image_rect", 2);
    depth_info_ = handle.advertise<sensor_msgs::CameraInfo>("camera/depth/camera_info", 2);
    colour_ = handle.advertise<sensor_msgs::Image>("camera/rgb/image_rect_color", 2);
    colour_info_ = handle.advertise<sensor_msgs::CameraInfo>("camera/rgb/camera_info", 2);
  }

  std::vector<std::string> openSource() override {
    folder_ = std::make_unique<DepthFolder>(path_);
    std::vector<std::string> names;
    for (const FramePair& pair : folder_->frames()) names.push_back(path_ + "/" + pair.depth);
    frames_.resize(names.size());
    return names;
  }

  bool hasListeners() const override {
    return depth_.getNumSubscribers() + colour_.getNumSubscribers() > 0;
  }

  void play(std::size_t index, const ros::Time& stamp) override {
    const auto frame = frames_.get(
        index, [&] { return folder_->read(index); },
        [](const DepthFrame& kept) { return kept.depth.data.size() + kept.colour.data.size(); });
    publish(depth_, depth_info_, frame->depth, depth_frame_, stamp);
    if (!frame->colour.data.empty())
      publish(colour_, colour_info_, frame->colour, colour_frame_, stamp);
  }

  void publish(const ros::Publisher& images, const ros::Publisher& infos,
               const sensor_msgs::Image& kept, const std::string& frame, const ros::Time& stamp) {
    const auto info = boost::make_shared<sensor_msgs::CameraInfo>(folder_->info());
    // A message is never changed after publishing: each gets its own stamp, so its own copy.
    const auto image = boost::make_shared<sensor_msgs::Image>(kept);
    info->header.stamp = image->header.stamp = stamp;
    info->header.frame_id = image->header.frame_id = frame;
    infos.publish(info);
    images.publish(image);
  }

  std::string path_;
  std::string depth_frame_ = "camera_depth_optical_frame";
  std::string colour_frame_ = "camera_color_optical_frame";
  std::unique_ptr<DepthFolder> folder_;
  FrameCache<DepthFrame> frames_;
  ros::Publisher depth_, depth_info_, colour_, colour_info_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::DepthFolderPlayer, nodelet::Nodelet)
