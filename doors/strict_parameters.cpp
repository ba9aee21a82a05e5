#include "doors/strict_parameters.hpp"

#include <ros/console.h>

#include <cmath>
#include <sstream>

namespace pilothouse {
namespace {

using XmlRpc::XmlRpcValue;

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

std::string typeName(const XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return "a bool";
    case XmlRpcValue::TypeInt:
      return "an int";
    case XmlRpcValue::TypeDouble:
      return "a double";
    case XmlRpcValue::TypeString:
      return "a string";
    case XmlRpcValue::TypeArray:
      return "a list";
    case XmlRpcValue::TypeStruct:
      return "a struct";
    default:
      return "of another type";
  }
}

/// The value for a human, short: a list or struct from outside may be of any size.
std::string shown(XmlRpcValue value) {
  std::ostringstream text;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      text << (static_cast<bool&>(value) ? "true" : "false");
      break;
    case XmlRpcValue::TypeInt:
      text << static_cast<int&>(value);
      break;
    case XmlRpcValue::TypeDouble:
      text << static_cast<double&>(value);
      break;
    case XmlRpcValue::TypeString:
      text << '"' << static_cast<std::string&>(value).substr(0, 80) << '"';
      break;
    case XmlRpcValue::TypeArray:
    case XmlRpcValue::TypeStruct:
      text << "of " << value.size() << " entries";
      break;
    default:
      text << "unreadable";
  }
  return text.str();
}

template <class T>
std::string rangeText(const char* type, T low, T high) {
  std::ostringstream text;
  text << type;
  const bool any = low <= std::numeric_limits<T>::lowest() && high >= std::numeric_limits<T>::max();
  if (!any) text << " from " << low << " to " << high;
  return text.str();
}

XmlRpcValue snapshot(const ros::NodeHandle& handle) {
  XmlRpcValue values;
  if (!handle.getParam(handle.getNamespace(), values)) return XmlRpcValue();
  return values;
}

}  // namespace

ParameterFault::ParameterFault(const std::vector<std::string>& faults)
    : std::runtime_error(joined(faults)), faults_(faults) {}

StrictParameters::StrictParameters(const ros::NodeHandle& handle)
    : StrictParameters(handle.getNamespace(), snapshot(handle)) {}

StrictParameters::StrictParameters(std::string name_space, XmlRpcValue values)
    : name_space_(std::move(name_space)), values_(std::move(values)) {
  if (values_.valid() && values_.getType() != XmlRpcValue::TypeStruct) {
    addFault("is " + shown(values_) + " (" + typeName(values_) + "), expected named parameters");
    values_ = XmlRpcValue();
  }
}

bool StrictParameters::has(const std::string& key) const {
  return values_.valid() && values_.hasMember(key);
}

void StrictParameters::require(std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (!has(key)) addFault(std::string(key) + " is missing, expected to be set");
  }
}

XmlRpcValue StrictParameters::raw(const std::string& key) {
  accept(key);
  return has(key) ? values_[key] : XmlRpcValue();
}

void StrictParameters::addWrong(const std::string& key, const XmlRpcValue& value,
                                const std::string& expected) {
  addFault(key + " is " + shown(value) + " (" + typeName(value) + "), expected " + expected);
}

void StrictParameters::read(const std::string& key, double& value, double low, double high) {
  XmlRpcValue found = raw(key);
  if (!found.valid()) return;
  double number = std::numeric_limits<double>::quiet_NaN();
  if (found.getType() == XmlRpcValue::TypeDouble) number = static_cast<double&>(found);
  if (found.getType() == XmlRpcValue::TypeInt) number = static_cast<int&>(found);
  if (std::isfinite(number) && number >= low && number <= high) {
    value = number;
  } else {
    addWrong(key, found, rangeText("a number", low, high));
  }
}

void StrictParameters::read(const std::string& key, int& value, int low, int high) {
  XmlRpcValue found = raw(key);
  if (!found.valid()) return;
  const bool is_int = found.getType() == XmlRpcValue::TypeInt;
  if (is_int && static_cast<int&>(found) >= low && static_cast<int&>(found) <= high) {
    value = static_cast<int&>(found);
  } else {
    addWrong(key, found, rangeText("an int", low, high));
  }
}

void StrictParameters::read(const std::string& key, bool& value) {
  XmlRpcValue found = raw(key);
  if (!found.valid()) return;
  if (found.getType() == XmlRpcValue::TypeBoolean) {
    value = static_cast<bool&>(found);
  } else {
    addWrong(key, found, "true or false");
  }
}

void StrictParameters::read(const std::string& key, std::string& value,
                            const std::vector<std::string>& allowed) {
  XmlRpcValue found = raw(key);
  if (!found.valid()) return;
  std::string expected = allowed.empty() ? "a text" : "one of";
  for (const auto& choice : allowed) expected += ' ' + choice;
  if (found.getType() != XmlRpcValue::TypeString) return addWrong(key, found, expected);
  const std::string& text = static_cast<std::string&>(found);
  bool good = allowed.empty() && !text.empty();
  for (const auto& choice : allowed) good = good || text == choice;
  if (!good) return addWrong(key, found, expected);
  value = text;
}

StrictParameters StrictParameters::child(const std::string& key) {
  return StrictParameters(name_space_ + '/' + key, raw(key));
}

StrictParameters StrictParameters::element(const std::string& key, int place) {
  XmlRpcValue list = raw(key);
  return StrictParameters(name_space_ + '/' + key + '[' + std::to_string(place) + ']', list[place]);
}

void StrictParameters::merge(StrictParameters& child) {
  child.collectUnknown();
  faults_.insert(faults_.end(), child.faults_.begin(), child.faults_.end());
}

void StrictParameters::collectUnknown() {
  if (!values_.valid()) return;
  std::string expected;
  for (const auto& key : known_) expected += ' ' + key;
  for (auto& entry : values_) {
    if (known_.count(entry.first) > 0) continue;
    addFault(entry.first + " is not a parameter here (value " + shown(entry.second) +
             "), expected only:" + expected);
  }
}

void StrictParameters::finish() {
  collectUnknown();
  if (faults_.empty()) return;
  for (const auto& fault : faults_) {
    if (!quiet_) ROS_FATAL("Refusing to start: parameter %s", fault.c_str());
  }
  throw ParameterFault(faults_);
}

}  // namespace pilothouse
