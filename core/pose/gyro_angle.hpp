#pragma once

#include <deque>
#include <optional>

namespace pilothouse {

/// How far the robot turned by its gyroscope. The constant error is learnt while the wheels stand.
class GyroAngle {
 public:
  /// @param rate about the vertical axis [rad/s]. @return false when refused: not finite, or not
  /// newer than the newest.
  bool add(double stamp, double rate);
  /// [rad], without the constant error; nothing where the readings do not reach over the time.
  std::optional<double> turned(double from, double to) const;
  /// The wheels stood still over the time.
  void stood(double from, double to);
  double bias() const { return bias_; }
  void clear() { readings_.clear(); }

 private:
  struct Reading {
    double stamp, rate;
    double angle;  ///< since the first, with the constant error
  };
  std::optional<double> angleAt(double stamp) const;

  std::deque<Reading> readings_;
  double bias_ = 0.0;    ///< [rad/s]
  double learnt_ = 0.0;  ///< time that it was learnt from [s]
};

}  // namespace pilothouse
