#include "gui/model/floor_wish.hpp"

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/service.h>

namespace pilothouse::gui {

void setFloor(ConsoleState& state, const std::string& method, bool calibrate) {
  dynamic_reconfigure::Reconfigure call;
  call.request.config.strs.resize(1);
  call.request.config.strs[0].name = "method";
  call.request.config.strs[0].value = method;
  call.request.config.bools.resize(1);
  call.request.config.bools[0].name = "calibrate_mounting";
  call.request.config.bools[0].value = calibrate;
  const auto told = [&state](const std::string& fault) {
    state.floor_settings.update([&](FloorSettings& settings) { settings.fault = fault; });
  };
  if (!ros::isStarted()) return told("no connection to the robot");
  const std::string service = ros::names::resolve("floor/set_parameters");
  if (!ros::service::exists(service, false)) return told("no service " + service);
  if (!ros::service::call(service, call)) return told(service + " refused the change");
  told({});  // the nodelet announces what it now uses
}

}  // namespace pilothouse::gui
