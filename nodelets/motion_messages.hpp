#pragma once

#include <pilothouse/ObjectList.h>
#include <ros/time.h>
#include <std_msgs/Header.h>

#include <string>
#include <vector>

#include "core/motion/obstacle.hpp"

namespace pilothouse {

/// Time as messages have it; zero for what is not above 0 or does not fit.
ros::Time stampOf(double seconds);

// Each call makes a fresh message: what was published is never changed.

/// @param header stamp: of the objects; frame: the robot's base.
ObjectList::Ptr toMessage(const std_msgs::Header& header, const std::string& source,
                          const std::vector<Obstacle>& objects);
/// What all sources see, with the age of each.
ObjectList::Ptr toMessage(const std_msgs::Header& header, const std::string& source,
                          const Surroundings& surroundings);

}  // namespace pilothouse
