#include "gui/model/conversion_thread.hpp"

#include <exception>

namespace pilothouse::gui {

ConversionThread::ConversionThread(ConsoleState& state)
    : state_(state), thread_([this] { run(); }) {}

ConversionThread::~ConversionThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  ready_.notify_one();
  thread_.join();
}

void ConversionThread::wake() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    pending_ = true;
  }
  ready_.notify_one();
}

template <class Message, class Picture, class Convert>
void ConversionThread::convert(Mailbox<Message>& box, Feed<Picture>& feed, Convert&& function) {
  const Arrival<Message> arrival = box.take();
  if (!arrival.message) return;
  try {
    feed.deliver(function(*arrival.message), arrival.at, arrival.latency);
  } catch (const std::exception& error) {  // out of memory: this picture is lost, the next may fit
    feed.deliver(Converted<Picture>::refused(error.what()), arrival.at, arrival.latency);
  }
}

void ConversionThread::convertCamera() {
  const auto info_now = info.get();
  convert(depth, state_.depth, [&](const sensor_msgs::Image& image) {
    return depth_converter_.fromImage(image, info_now.get());
  });
  const Arrival<sensor_msgs::PointCloud2> arrival = cloud.take();
  if (!arrival.message) return;
  Mailbox<sensor_msgs::PointCloud2> again;
  if (cloud_as_depth) {
    again.put(arrival);
    convert(again, state_.depth, [&](const auto& c) { return depth_converter_.fromCloud(c); });
  }
  if (cloud_as_colour) {
    again.put(arrival);
    convert(again, state_.colour, [](const auto& c) { return colourFromCloud(c); });
  }
}

void ConversionThread::run() {
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      ready_.wait(lock, [&] { return pending_ || stopping_; });
      if (stopping_) return;
      pending_ = false;
    }
    convertCamera();
    convert(colour, state_.colour, [](const auto& image) { return colourFromImage(image); });
    convert(coded, state_.colour, [](const auto& image) { return colourFromCompressed(image); });
    convert(floor, state_.floor, [](const auto& grid) { return floorFromMessage(grid); });
    convert(objects, state_.objects, [](const auto& list) { return objectsFromMessage(list); });
    convert(standing, state_.place.standing,
            [](const auto& list) { return objectsFromMessage(list); });
  }
}

}  // namespace pilothouse::gui
