#pragma once

#include <deque>
#include <optional>

namespace pilothouse {

/// How far the robot turned by its gyroscope. Its constant error is learnt while the wheels stand,
/// and, far more slowly, from how the wheels turn the robot while it drives.
class GyroAngle {
 public:
  /// @param rate about the vertical axis [rad/s]. @return false when refused: not finite, or not
  /// newer than the newest.
  bool add(double stamp, double rate);
  /// [rad], without the constant error; nothing where the readings do not reach over the time.
  std::optional<double> turned(double from, double to) const;
  /// The wheels stood still over the time.
  void stood(double from, double to);
  /// The wheels say that the robot turned so far over the time. @param variance of that [rad^2]
  void rolled(double from, double to, double turned, double variance);
  double bias() const { return bias_; }
  double biasVariance() const { return bias_variance_; }  ///< [rad^2/s^2]
  void clear() { readings_.clear(); }

 private:
  struct Reading {
    double stamp, rate;
    double angle;  ///< since the first, with the constant error
  };
  std::optional<double> angleAt(double stamp) const;
  void learn(double error, double time, double variance);

  std::deque<Reading> readings_;
  double bias_ = 0.0;                   ///< [rad/s]
  double bias_variance_ = 0.02 * 0.02;  ///< [rad^2/s^2]
};

}  // namespace pilothouse
