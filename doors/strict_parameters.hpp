#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <initializer_list>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace pilothouse {

/// Parameters that a node cannot start with. what() lists every fault, one line each.
class ParameterFault : public std::runtime_error {
 public:
  explicit ParameterFault(const std::vector<std::string>& faults);
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  std::vector<std::string> faults_;
};

/// Reads a namespace of the parameter server and forgives nothing: a wrong type (an int for a
/// double is right, nothing else is converted), a value out of range, NaN, a missing required key
/// and a key that nobody asked for are faults that name key, value and what was expected.
/// A key that is missing and not required leaves the variable at the default it came with.
/// Read all keys, then call finish().
class StrictParameters {
 public:
  /// One snapshot of everything under the handle's namespace.
  explicit StrictParameters(const ros::NodeHandle& handle);
  /// @param name_space only for messages, e.g. "/floor".
  StrictParameters(std::string name_space, XmlRpc::XmlRpcValue values);

  void require(std::initializer_list<const char*> keys);
  bool has(const std::string& key) const;

  void read(const std::string& key, double& value, double low = -std::numeric_limits<double>::max(),
            double high = std::numeric_limits<double>::max());
  void read(const std::string& key, int& value, int low = std::numeric_limits<int>::min(),
            int high = std::numeric_limits<int>::max());
  void read(const std::string& key, bool& value);
  /// @param allowed empty: any text that is not empty.
  void read(const std::string& key, std::string& value,
            const std::vector<std::string>& allowed = {});
  /// A key for which others answer, or that is read by hand: never unknown.
  void accept(const std::string& key) { known_.insert(key); }
  /// The raw value of a key, marked as known; an invalid value where it is missing.
  XmlRpc::XmlRpcValue raw(const std::string& key);
  /// The struct under a key, to be read by the same rules and then handed to merge().
  StrictParameters child(const std::string& key);
  /// The struct at a place of the list under a key, likewise.
  StrictParameters element(const std::string& key, int place);
  /// Takes over the faults of a child, and what it was not asked for.
  void merge(StrictParameters& child);

  /// A fault found by other means, e.g. by a validate(): "key is value, expected range".
  void addFault(const std::string& text) { faults_.push_back(name_space_ + ": " + text); }
  void addWrong(const std::string& key, const XmlRpc::XmlRpcValue& value,
                const std::string& expected);

  std::size_t faultCount() const { return faults_.size(); }
  /// finish() throws without logging: for programs that report by themselves.
  void quiet() { quiet_ = true; }

  /// @throws ParameterFault after logging each fault as fatal, when there is any.
  void finish();

 private:
  void collectUnknown();

  std::string name_space_;
  XmlRpc::XmlRpcValue values_;
  std::set<std::string> known_;
  std::vector<std::string> faults_;
  bool quiet_ = false;
};

}  // namespace pilothouse
