#include "nodelets/motion_messages.hpp"

#include <boost/make_shared.hpp>
#include <limits>

namespace pilothouse {
namespace {

Object toMessage(const Obstacle& obstacle) {
  Object object;
  object.position.x = obstacle.position.x();
  object.position.y = obstacle.position.y();
  object.position.z = obstacle.height;
  object.size = obstacle.size;
  object.kind = static_cast<std::uint8_t>(obstacle.kind);
  object.relevance = static_cast<std::uint8_t>(obstacle.relevance);
  object.source = obstacle.source;
  object.remembered = obstacle.remembered;
  return object;
}

}  // namespace

ros::Time stampOf(double seconds) {
  constexpr double kEnd = 4294967295.0;  // of the 32 bits
  return seconds > 0.0 && seconds < kEnd ? ros::Time(seconds) : ros::Time();
}

ObjectList::Ptr toMessage(const std_msgs::Header& header, const std::string& source,
                          const std::vector<Obstacle>& objects) {
  auto message = boost::make_shared<ObjectList>();
  message->header = header;
  message->source = source;
  message->objects.reserve(objects.size());
  for (const auto& obstacle : objects) message->objects.push_back(toMessage(obstacle));
  return message;
}

ObjectList::Ptr toMessage(const std_msgs::Header& header, const std::string& source,
                          const Surroundings& surroundings) {
  ObjectList::Ptr message = toMessage(header, source, surroundings.objects);
  for (const auto& from : surroundings.sources) {
    ObjectSource entry;
    entry.name = from.name;
    entry.age = std::numeric_limits<float>::infinity();
    if (from.stamp >= 0.0) {
      entry.stamp = stampOf(from.stamp);
      entry.age = static_cast<float>(surroundings.stamp - from.stamp);
    }
    message->sources.push_back(std::move(entry));
  }
  return message;
}

}  // namespace pilothouse
